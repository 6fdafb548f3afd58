// SPDX-License-Identifier: Apache-2.0
#include "cli/render/supervise.h"

#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <optional>
#include <sstream>
#include <string>
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

using Clock = std::chrono::steady_clock;

// A process of the render that is stopped: where it is the only one nobody else misses it.
class StoppedWriter {
 public:
  StoppedWriter(const std::filesystem::path& film, double patience_s)
      : film_(film), patience_s_(patience_s) {}

  void kill_where_it_stays_so() {
    const std::optional<pid_t> process = stopped_writer(film_);
    if (!process || process != stopped_) since_ = Clock::now();
    stopped_ = process;
    const std::chrono::duration<double> stands = Clock::now() - since_;
    if (!process || patience_s_ == 0 || stands.count() < 2 * patience_s_) return;
    say("vitrail: process {} of the render is stopped since {:.0f} s: it is killed\n", *process,
        stands.count());
    ::kill(*process, SIGKILL);
  }

 private:
  const std::filesystem::path& film_;
  double patience_s_;
  std::optional<pid_t> stopped_;
  Clock::time_point since_;
};

struct End {
  int status = 0;          // of waitpid, then of the process
  bool had_begun = false;  // the render that it started
};

// Of Open MPI 4.1 with PMIx 4.2 one mpirun in twenty-five never ends once a rank of its was killed: its end
// waits for a lock in memory that it has freed.
End wait_for_end(pid_t process, const std::filesystem::path& film, double patience_s) {
  bool is_missed = false;  // it was written, and is not any more
  Clock::time_point last_written;
  StoppedWriter writer(film, patience_s);
  End end;
  while (::waitpid(process, &end.status, WNOHANG) == 0) {
    writer.kill_where_it_stays_so();
    if (is_being_written(film)) {
      end.had_begun = true;
      is_missed = true;
      last_written = Clock::now();
    } else if (patience_s > 0 && is_missed &&
               Clock::now() - last_written > std::chrono::duration<double>(patience_s)) {
      say("vitrail: the render has ended and its launcher has not: the launcher is killed\n");
      ::kill(process, SIGKILL);
      is_missed = false;
    }
    std::this_thread::sleep_for(100ms);
  }
  return end;
}

End run_once(const std::vector<std::string>& command, const std::filesystem::path& film, double patience_s) {
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
  End end = wait_for_end(process, film, patience_s);
  child = 0;
  end.status = WIFEXITED(end.status) ? WEXITSTATUS(end.status) : 128 + WTERMSIG(end.status);
  return end;
}

// A launcher's own mistake: a render ends with 4, or with what its launcher makes of a signal.
bool is_of_launcher(const End& end) {
  return !end.had_begun && end.status != exit_machine && end.status < 128;
}

bool may_be_better(int status) {
  constexpr int no_such_program = 127;
  constexpr int final[] = {exit_done,       exit_usage,   exit_bad_input,
                           no_such_program, 128 + SIGINT, 128 + SIGTERM};
  return std::ranges::find(final, status) == std::end(final);
}

// Of the file that a render writes step by step; none where it is not there.
std::optional<std::filesystem::file_time_type> last_step(const std::filesystem::path& file) {
  std::error_code missing;
  const auto at = std::filesystem::last_write_time(file, missing);
  return missing ? std::nullopt : std::optional(at);
}

// How a render ended, and how often it did at the same place.
std::string words_of(int status, int ends_there, const char* step) {
  std::string words = fmt::format("the render ended with status {}", status);
  if (status == 128 + SIGKILL) words += " (killed, as by the system where memory ends)";
  if (ends_there > 1) words += fmt::format(", {} times in a row without another {}", ends_there, step);
  return words;
}

}  // namespace

int supervise(const std::vector<std::string>& command, const std::filesystem::path& film, const Steps& steps,
              int restarts, double patience_s) {
  pass_signals_on();
  int mistakes = 0, ends_there = 0;
  for (int done = 0;; ++done) {
    const auto step = last_step(steps.file);
    const End end = run_once(command, film, patience_s);
    const int status = end.status;
    mistakes = is_of_launcher(end) ? mistakes + 1 : 0;
    ends_there = last_step(steps.file) == step ? ends_there + 1 : 1;
    if (mistakes == 2 && !stopped)
      say("vitrail: {} ended with status {} twice, before a render began: it is not started again\n",
          command.front(), status);
    if (mistakes == 2) return status;
    if (stopped || !may_be_better(status)) return status;
    const std::string words = words_of(status, ends_there, steps.name);
    if (done == restarts) {
      say("vitrail: {}: it was started again {} times and is not once more\n", words, restarts);
      return status;
    }
    const auto wait = std::min(60, 1 << std::min(done, 6)) * 1s;
    say("vitrail: {}; started again in {} s, {} of {} times\n", words, wait / 1s, done + 1, restarts);
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
