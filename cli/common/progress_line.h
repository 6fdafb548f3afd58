// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

namespace vitrail {

// "43 % what  12 s left" on standard error, ten times a second at most; nothing where it is not visible.
class ProgressLine {
 public:
  explicit ProgressLine(bool visible);
  void show(double fraction, const char* what);
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  bool visible_;
  Clock::time_point start_, shown_;
};

}  // namespace vitrail
