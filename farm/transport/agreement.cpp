// SPDX-License-Identifier: Apache-2.0
#include "farm/transport/agreement.h"

#include "scene/system/diagnostics.h"

#include <chrono>
#include <thread>

namespace vitrail {

void agree(Transport& transport, const std::function<void()>& step) {
  std::exception_ptr failure;
  try {
    step();
  } catch (...) {
    failure = std::current_exception();
  }
  RoundSums mine;
  if (failure) (is_bad_input(failure) ? mine.bad_input : mine.machine_failure) = 1;
  transport.start_round(mine, {});
  std::optional<Round> round;
  while (!(round = transport.finish_round())) {
    if (transport.while_waiting) transport.while_waiting();
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  }
  const RoundSums& sums = round->sums;
  if (sums.bad_input + sums.machine_failure > 0) leave(failure, sums);
}

void leave(std::exception_ptr own, const RoundSums& sums) {
  if (own) std::rethrow_exception(own);
  throw OtherRankFailed(sums.bad_input > 0);
}

bool is_bad_input(const std::exception_ptr& failure) {
  try {
    std::rethrow_exception(failure);
  } catch (const Error&) {
    return true;
  } catch (...) {
    return false;
  }
}

}  // namespace vitrail
