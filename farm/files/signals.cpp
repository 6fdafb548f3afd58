// SPDX-License-Identifier: Apache-2.0
#include "farm/files/signals.h"

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

}  // namespace

void catch_signals() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  for (int number : {SIGTERM, SIGINT}) ::sigaction(number, &action, nullptr);
  catch_checkpoint_signal();
  // A reader of messages that goes away, or a limit to the size of files, does not end the work: what cannot
  // be written says so.
  action.sa_handler = SIG_IGN;
  for (int number : {SIGPIPE, SIGXFSZ}) ::sigaction(number, &action, nullptr);
}

void catch_checkpoint_signal() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  ::sigaction(SIGUSR1, &action, nullptr);
}

int stop_signal() { return stop_number; }
void ask_to_stop() { on_signal(SIGTERM); }
bool take_checkpoint_signal() { return checkpoint_flag.exchange(false); }

}  // namespace vitrail
