// SPDX-License-Identifier: Apache-2.0
// All ranks take these steps together or not at all.
#pragma once

#include <functional>
#include <stdexcept>

#include "farm/transport/transport.h"

namespace vitrail {

// This rank did nothing wrong, but the job ends because another one failed, and said why.
struct OtherRankFailed : std::runtime_error {
  explicit OtherRankFailed(bool bad_input_there)
      : std::runtime_error("another rank failed"), bad_input(bad_input_there) {}
  bool bad_input;
};

// Runs a step that may take longer than others have patience, in a thread of its own where there are other
// ranks: the transport's words are heard meanwhile. It must not use the transport.
void beside(Transport& transport, const std::function<void()>& step);

// Waits for the round that this rank has joined.
Round wait_for_round(Transport& transport);

// Runs `step` on every rank, beside the transport, and waits for all. If it failed anywhere, the ranks where
// it did throw what happened, the others OtherRankFailed.
void agree(Transport& transport, const std::function<void()>& step);

// Does the same with a step of rank 0 alone, which may take as long as it likes, as other programs do.
void agree_on_root(Transport& transport, const std::function<void()>& step);

// Returns how many times all ranks have failed together, by what one of them threw. Code that catches that
// can go on with another step where the number has grown: the ranks are in step.
std::uint64_t agreed_failures();

// Throws `own` where it is set, OtherRankFailed elsewhere.
[[noreturn]] void leave(const std::exception_ptr& own, const RoundSums& sums);

// Returns whether it is an Error: exit status 3 rather than 4.
bool is_bad_input(const std::exception_ptr& failure);

}  // namespace vitrail
