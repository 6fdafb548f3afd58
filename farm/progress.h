// SPDX-License-Identifier: Apache-2.0
// What a user sees while a picture is rendered: a bar on a terminal, a line a minute, JSON, or nothing.
#pragma once

#include <chrono>

#include "bundle/manifest.h"
#include "farm/options.h"
#include "farm/stats.h"
#include "farm/transport.h"

namespace vitrail {

class Progress {
 public:
  // Of work items of which `items_before` were done by earlier runs. Silent on other ranks than 0.
  struct Work {
    std::uint64_t items = 0, items_before = 0;
    std::uint32_t samples = 0;  // a pixel
  };
  Progress(const RenderOptions& options, int rank, const Work& work);
  // Called as often as one likes; prints at its own pace.
  void show(const RoundSums& sums);
  void finish();

 private:
  void print(const RoundSums& sums, double elapsed_s);
  double remaining_s(double done, double elapsed_s) const;

  ProgressMode mode_;
  double time_limit_s_;  // 0: none
  double samples_, items_, done_before_;
  std::chrono::steady_clock::time_point start_, last_;
  bool line_open_ = false;
};

// Before the first ray and after the last, on rank 0.
void print_start(const RenderOptions& options, const Manifest& manifest, int ranks, int threads);
void print_end(const RenderOptions& options, const RenderStats& stats, std::uint64_t pixels);

}  // namespace vitrail
