// SPDX-License-Identifier: Apache-2.0
#include "cli/render/supervise.h"

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <optional>
#include <sstream>
#include <thread>

#include "cli/common/main_guard.h"
#include "farm/files/output_lock.h"
#include "scene/system/diagnostics.h"
#include "scene/system/say.h"

namespace vitrail {

namespace {

using namespace std::chrono_literals;

std::atomic<pid_t> child = 0;
std::atomic<bool> stopped = false;
static_assert(std::atomic<pid_t>::is_always_lock_free);

// A terminal's Ctrl-C has reached the child already.
void pass_on(int number, siginfo_t* info, void*) {
  if (number != SIGUSR1) stopped = true;
  if (child > 0 && info->si_code != SI_KERNEL) ::kill(child, number);
}

void pass_signals_on() {
  struct sigaction action {};
  action.sa_sigaction = pass_on;
  action.sa_flags = SA_RESTART | SA_SIGINFO;
  for (const int number : {SIGTERM, SIGINT, SIGUSR1}) ::sigaction(number, &action, nullptr);
}

// The status of waitpid. Of Open MPI 4.1 with PMIx 4.2 one mpirun in twenty-five never ends once a rank
// of its was killed: its end waits for a lock in memory that it has freed.
int status_at_end(pid_t process, const std::filesystem::path& film, double patience_s) {
  using Clock = std::chrono::steady_clock;
  std::optional<Clock::time_point> last_written;
  int status = 0;
  while (::waitpid(process, &status, WNOHANG) == 0) {
    if (is_being_written(film)) {
      last_written = Clock::now();
    } else if (patience_s > 0 && last_written &&
               Clock::now() - *last_written > std::chrono::duration<double>(patience_s)) {
      say("vitrail: the launcher does not end though its render has: it is killed\n");
      ::kill(process, SIGKILL);
      last_written.reset();
    }
    std::this_thread::sleep_for(100ms);
  }
  return status;
}

int run_once(const std::vector<std::string>& command, const std::filesystem::path& film, double patience_s) {
  std::vector<std::string> words = command;
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  // A signal between the fork and the note of whom to pass it on to would reach nobody.
  sigset_t passed, before;
  ::sigemptyset(&passed);
  for (const int number : {SIGTERM, SIGINT, SIGUSR1}) ::sigaddset(&passed, number);
  ::sigprocmask(SIG_BLOCK, &passed, &before);
  const pid_t process = ::fork();
  if (process == 0) {
    for (const int number : {SIGTERM, SIGINT, SIGUSR1}) std::signal(number, SIG_DFL);
    ::sigprocmask(SIG_SETMASK, &before, nullptr);
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    ::execvp(argv[0], argv.data());
    ::_exit(127);
  }
  if (process < 0) ::sigprocmask(SIG_SETMASK, &before, nullptr);
  if (process < 0) throw MachineError("no process can be made");
  child = process;
  ::sigprocmask(SIG_SETMASK, &before, nullptr);
  const int status = status_at_end(process, film, patience_s);
  child = 0;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

bool may_be_better(int status) {
  constexpr int no_such_program = 127;
  constexpr int final[] = {exit_done,       exit_usage,   exit_bad_input,
                           no_such_program, 128 + SIGINT, 128 + SIGTERM};
  return std::ranges::find(final, status) == std::end(final);
}

}  // namespace

int supervise(const std::vector<std::string>& command, const std::filesystem::path& film, int restarts,
              double patience_s) {
  pass_signals_on();
  for (int done = 0;; ++done) {
    const int status = run_once(command, film, patience_s);
    if (stopped || !may_be_better(status) || done == restarts) return status;
    const auto wait = std::min(60, 1 << std::min(done, 6)) * 1s;
    say("vitrail: the render ended with status {}; started again in {} s, {} of {} times\n", status,
        wait / 1s, done + 1, restarts);
    for (auto left = std::chrono::milliseconds(wait); left > 0ms && !stopped; left -= 50ms)
      std::this_thread::sleep_for(50ms);
    if (stopped) return status;
  }
}

std::vector<std::string> supervised_command(int argc, char** argv, const std::string& launcher) {
  std::vector<std::string> words;
  std::istringstream launching(launcher);
  for (std::string word; launching >> word;) words.push_back(word);
  words.push_back(std::filesystem::read_symlink("/proc/self/exe").string());
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const bool own = word == "--restarts" || word == "--launcher";
    if (own)
      ++i;  // and its value
    else if (!word.starts_with("--restarts=") && !word.starts_with("--launcher="))
      words.push_back(word);
  }
  return words;
}

}  // namespace vitrail
