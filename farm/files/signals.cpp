// SPDX-License-Identifier: Apache-2.0
#include "farm/files/signals.h"

#include <unistd.h>

#include <atomic>
#include <csignal>

namespace vitrail {

namespace {

std::atomic<int> stop_number = 0;
std::atomic<bool> checkpoint_flag = false;
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

void on_signal(int number) {
  int none = 0;
  if (number == SIGUSR1)
    checkpoint_flag = true;
  else
    stop_number.compare_exchange_strong(none, number);
}

// A mapped file that became shorter, or a disk that fails under it. Nothing can be waited for in here: mpirun
// ends the other ranks.
void on_bus_error(int) {
  constexpr char words[] = "vitrail: a mapped file of the bundle became shorter, or its disk failed\n";
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, words, sizeof words - 1);
  constexpr int exit_machine = 4;
  ::_exit(exit_machine);
}

}  // namespace

void catch_signals() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  for (int number : {SIGTERM, SIGINT, SIGUSR1}) ::sigaction(number, &action, nullptr);
  action.sa_handler = on_bus_error;
  ::sigaction(SIGBUS, &action, nullptr);
  // A reader of messages that goes away, or a limit to the size of files, does not end the work: what cannot
  // be written says so.
  action.sa_handler = SIG_IGN;
  for (int number : {SIGPIPE, SIGXFSZ}) ::sigaction(number, &action, nullptr);
}

int stop_signal() { return stop_number; }
void ask_to_stop() { on_signal(SIGTERM); }
bool take_checkpoint_signal() { return checkpoint_flag.exchange(false); }

}  // namespace vitrail
