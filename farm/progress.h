// SPDX-License-Identifier: Apache-2.0
// What a user sees while a picture is rendered: a bar on a terminal, one JSON line an interval, or nothing.
#pragma once

#include <chrono>

#include "farm/options.h"
#include "farm/transport.h"

namespace vitrail {

class Progress {
 public:
  // `items` in all, of which `items_before` were done by earlier runs.
  Progress(ProgressMode mode, std::uint64_t items, std::uint64_t items_before);
  // Called as often as one likes; prints at its own pace, to standard error.
  void show(const RoundSums& sums);
  void finish();

 private:
  void print(const RoundSums& sums, double elapsed_s);
  ProgressMode mode_;
  double items_, items_before_;
  std::chrono::steady_clock::time_point start_, last_;
  bool line_open_ = false;
};

}  // namespace vitrail
