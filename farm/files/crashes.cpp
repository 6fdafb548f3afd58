// SPDX-License-Identifier: Apache-2.0
#include "farm/files/crashes.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string_view>

#include "bundle/watched_files.h"

namespace vitrail {

namespace {

std::array<struct sigaction, NSIG> before_crash;  // what each signal did before

void write_words(std::string_view words) {
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, words.data(), words.size());
}

// The file that is mapped there, as /proc/self/maps has it; "" where none is. `line` is for its words.
std::string_view mapped_at(const void* address, std::span<char> line) {
  const auto wanted = reinterpret_cast<std::uintptr_t>(address);
  const int maps = ::open("/proc/self/maps", O_RDONLY | O_CLOEXEC);
  std::string_view found;
  std::size_t length = 0;
  for (char c; maps >= 0 && ::read(maps, &c, 1) == 1;) {
    if (c != '\n') {
      if (length + 1 < line.size()) line[length++] = c;
      continue;
    }
    line[length] = 0;
    char* end = nullptr;
    const std::uintptr_t first = std::strtoull(line.data(), &end, 16),
                         last = std::strtoull(end + 1, &end, 16);
    const std::string_view words(line.data(), length);
    if (first <= wanted && wanted < last && words.find('/') != std::string_view::npos)
      found = words.substr(words.find('/'));
    if (first > wanted || !found.empty()) break;
    length = 0;
  }
  if (maps >= 0) ::close(maps);
  return found;
}

// What is verified once may change while it is mapped: what follows is any crash, where a file became shorter
// SIGBUS, as where its disk fails. Nothing can be waited for in here: mpirun ends the other ranks.
void on_crash(int number, siginfo_t* info, void*) {
  constexpr int exit_bad_input = 3, exit_machine = 4;
  if (const char* file = changed_file()) {
    write_words("vitrail: "), write_words(file), write_words(": "), write_words(file_changed),
        write_words("\n");
    ::_exit(exit_bad_input);
  }
  if (number == SIGBUS && info->si_code > 0) {
    std::array<char, 4096 + 128> line;
    const std::string_view file = mapped_at(info->si_addr, line);
    write_words("vitrail: cannot read "), write_words(file.empty() ? "a mapped file" : file);
    write_words(": its disk failed, or it became shorter\n");
    ::_exit(exit_machine);
  }
  ::sigaction(number, &before_crash[static_cast<std::size_t>(number)], nullptr);
  ::raise(number);
}

}  // namespace

void catch_crashes() {
  struct sigaction action {};
  action.sa_sigaction = on_crash;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK;
  for (const int number : {SIGBUS, SIGSEGV, SIGFPE, SIGILL, SIGABRT}) {
    struct sigaction before {};
    ::sigaction(number, &action, &before);
    if (before.sa_sigaction != on_crash) before_crash[static_cast<std::size_t>(number)] = before;
  }
}

}  // namespace vitrail
