// SPDX-License-Identifier: Apache-2.0
// Progress shows a user how far a picture is while it is rendered: a bar on a terminal, a line a minute,
// JSON, or nothing.
#pragma once

#include <chrono>
#include <nlohmann/json_fwd.hpp>

#include "bundle/manifest.h"
#include "farm/plan/options.h"
#include "farm/plan/rounds.h"
#include "farm/run/stats.h"
#include "farm/transport/transport.h"
#include "film/film.h"
#include "scene/system/progress_line.h"

namespace vitrail {

class Progress {
 public:
  // `film` has the samples of earlier runs. `samples` counts those a pixel, on the average, that the render
  // is expected to take. It is silent on other ranks than 0.
  Progress(const RenderOptions& options, int rank, const Film& film, double samples);
  void expect(double samples) { samples_ = samples; }
  // It is called as often as one likes, and prints at its own pace.
  void show(const Round& round);
  void finish();
  double samples_left(const RoundSums& sums) const;  // of all pixels together
  double until_limit_s() const;                      // infinite without a limit

 private:
  void print(const Round& round, double elapsed_s);
  double remaining_s(double done, double elapsed_s) const;

  ProgressMode mode_;
  double time_limit_s_;  // 0: none
  double pixels_, samples_, samples_before_;
  std::chrono::steady_clock::time_point start_, limit_start_, last_;
  ProgressLine line_;
};

// They print on rank 0, before the first ray, and once all is written. The second prints a render's last
// line, which names the picture, or the film where that is the output.
void print_start(const RenderOptions& options, const Manifest& manifest, const Goal& goal, int ranks,
                 int threads);
void print_end(const RenderOptions& options, const RenderStats& stats);
// Prints a line of --progress json.
void print_event(const nlohmann::ordered_json& event);
// Says so where more than a hundredth of the sunlight in glass met faces that are not parallel, which only
// photons pass.
void print_wedges(const RenderOptions& options, const TraceCounters& traced);

}  // namespace vitrail
