// SPDX-License-Identifier: Apache-2.0
#include "farm/signals.h"

#include <atomic>
#include <csignal>

namespace vitrail {

namespace {

std::atomic<bool> stop_flag = false, checkpoint_flag = false;
static_assert(std::atomic<bool>::is_always_lock_free);

void on_signal(int number) { (number == SIGUSR1 ? checkpoint_flag : stop_flag) = true; }

}  // namespace

void catch_signals() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  for (int number : {SIGTERM, SIGINT, SIGUSR1}) ::sigaction(number, &action, nullptr);
}

bool stop_signalled() { return stop_flag; }
bool take_checkpoint_signal() { return checkpoint_flag.exchange(false); }

}  // namespace vitrail
