// SPDX-License-Identifier: Apache-2.0
#include "cli/common/run_program.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <thread>

#include "cli/common/main_guard.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

std::filesystem::path program_folder() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path();
}

int run_program(const std::string& name, const std::vector<std::string>& arguments, bool (*stopped)(),
                const std::filesystem::path& standard_output) {
  std::string program = (program_folder() / name).string();
  std::vector<std::string> words = arguments;
  std::vector<char*> argv{program.data()};
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  if (!standard_output.empty())
    ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, standard_output.c_str(),
                                       O_WRONLY | O_CREAT | O_TRUNC, 0666);
  pid_t child = 0;
  const int error = ::posix_spawn(&child, program.c_str(), &actions, nullptr, argv.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (error != 0) {
    if (error == ENOENT)
      throw MachineError(
          fmt::format("{} is missing: the programs of vitrail work together, and have to lie in one "
                      "folder",
                      program));
    throw MachineError("cannot run " + program + ": " + std::strerror(error));
  }
  int status = 0;
  while (stopped && ::waitpid(child, &status, WNOHANG) == 0) {
    if (stopped()) {
      ::kill(child, SIGTERM);
      break;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && (WEXITSTATUS(status) == exit_done || WEXITSTATUS(status) == exit_differs))
    return WEXITSTATUS(status);
  if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGINT || WTERMSIG(status) == SIGTERM))
    throw Interrupted(WTERMSIG(status), name + " was interrupted");
  if (WIFEXITED(status) && (WEXITSTATUS(status) == exit_usage || WEXITSTATUS(status) == exit_bad_input))
    throw RefusalAlreadySaid(name, WEXITSTATUS(status));
  if (WIFEXITED(status)) throw FailureAlreadySaid(name, WEXITSTATUS(status));
  throw MachineError(fmt::format("{} was ended by signal {}", name, WTERMSIG(status)));
}

ForeignEnd run_foreign(const std::vector<std::string>& words, const std::filesystem::path& standard_output,
                       const std::filesystem::path& standard_error) {
  std::vector<std::string> own = words;
  std::vector<char*> argv;
  for (std::string& word : own) argv.push_back(word.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  const auto send = [&](int descriptor, const std::filesystem::path& file) {
    ::posix_spawn_file_actions_addopen(&actions, descriptor, file.c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                       0666);
  };
  send(STDOUT_FILENO, standard_output), send(STDERR_FILENO, standard_error);
  pid_t child = 0;
  const int error = ::posix_spawnp(&child, argv.front(), &actions, nullptr, argv.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (error == ENOENT) return {};
  if (error != 0) throw MachineError("cannot run " + words.front() + ": " + std::strerror(error));
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGINT || WTERMSIG(status) == SIGTERM))
    throw Interrupted(WTERMSIG(status), words.front() + " was interrupted");
  return {true, WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status)};
}

}  // namespace vitrail
