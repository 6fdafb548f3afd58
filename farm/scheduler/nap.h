// SPDX-License-Identifier: Apache-2.0
// Nap says how long the thread that moves messages sleeps before it looks again: longer and longer while
// nothing moves. A rank that spins takes the core from one that works.
#pragma once

#include <algorithm>
#include <chrono>

namespace vitrail {

class Nap {
 public:
  using Time = std::chrono::microseconds;
  static constexpr Time shortest{20}, longest{1000};

  void moved() { next_ = shortest; }
  // Returns the next nap, which is then taken.
  Time take() {
    const Time nap = next_;
    next_ = std::min(next_ * 2, longest);
    return nap;
  }

 private:
  Time next_ = shortest;
};

}  // namespace vitrail
