// SPDX-License-Identifier: Apache-2.0
#include "farm/transport/agreement.h"

#include <chrono>
#include <future>
#include <thread>

#include "farm/transport/doing.h"
#include "scene/system/diagnostics.h"
#include "scene/system/underway.h"

namespace vitrail {

void beside(Transport& transport, const std::function<void()>& step) {
  using namespace std::chrono_literals;
  if (transport.size() == 1) return step();
  std::future<void> working = std::async(std::launch::async, step);
  while (working.wait_for(1ms) != std::future_status::ready) transport.goes_on();
  working.get();
}

Round wait_for_round(Transport& transport) {
  std::optional<Round> round;
  while (!(round = transport.finish_round())) {
    transport.goes_on();
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  }
  return *round;
}

void agree(Transport& transport, const std::function<void()>& step) {
  std::exception_ptr failure;
  try {
    // A step that stands still is seen. What is only beside may wait for another program.
    beside(transport, [&] {
      const Underway underway(doing());
      step();
    });
  } catch (...) {
    failure = std::current_exception();
  }
  RoundSums mine;
  if (failure) (is_bad_input(failure) ? mine.bad_input : mine.machine_failure) = 1;
  transport.start_round(mine, {});
  const RoundSums sums = wait_for_round(transport).sums;
  if (sums.bad_input + sums.machine_failure > 0) leave(failure, sums);
}

void agree_on_root(Transport& transport, const std::function<void()>& step) {
  std::exception_ptr failure;
  try {
    if (transport.rank() == 0) beside(transport, step);
  } catch (...) {
    failure = std::current_exception();
  }
  agree(transport, [&] {
    if (failure) std::rethrow_exception(failure);
  });
}

namespace {

std::uint64_t failures = 0;  // of the thread that has the transport

}  // namespace

std::uint64_t agreed_failures() { return failures; }

void leave(const std::exception_ptr& own, const RoundSums& sums) {
  ++failures;
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
