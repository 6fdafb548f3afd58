// SPDX-License-Identifier: Apache-2.0
// This file makes the whole measurement of a scene: which renders, what they show, what to take.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "measure/axes.h"
#include "measure/model.h"
#include "measure/runs.h"
#include "measure/statistics.h"

namespace vitrail {

// MeasureOptions say what to measure, and for how long.
struct MeasureOptions {
  std::filesystem::path scene, folder;
  std::vector<std::string> axes;   // empty: all
  int width = 256;                 // of the measured pictures, in pixels
  int seeds = 6;                   // pictures of each setting
  std::uint64_t first_seed = 1;    // of them
  double budget_s = 300;           // wall time that all may take, roughly
  bool every_combination = false;  // of the axes that change the picture, not only the promising ones
  int spp = 0, reference_spp = 0;  // of a picture, and of a half of the reference; 0: what the budget allows
  Farm farm;
  double most_bias = 0.01;        // of the picture's mean light, of what is recommended
  std::optional<double> error;    // relMSE to recommend for
  std::optional<double> seconds;  // wall time of the whole picture of the scene's size to recommend for
};

// A FarmTime is about start_s + samples · sample_s for the whole picture on a cluster; 0: not planned.
struct FarmTime {
  double start_s = 0, sample_s = 0;
  // They return whether it was planned, and the seconds of so many samples.
  bool is_known() const { return sample_s > 0; }
  double operator()(double samples) const { return start_s + samples * sample_s; }
};

// A MeasuredSetting is one setting and what its pictures show.
struct MeasuredSetting {
  Setting setting;
  std::string name;
  Effect effect = Effect::nothing;
  int least_spp = 1;
  bool again = false;  // was measured before, with fewer samples
  FarmTime farm;
  std::string failure;     // why there is no picture; empty: there is
  bool identical = false;  // its pictures are those of the scene's own setting, bit for bit
  int spp = 0;
  ErrorStatistics error;
  double sample_s = 0;                     // CPU seconds of one sample of every pixel: the median of its runs
  double cpu_s = 0, wall_s = 0, rays = 0;  // of one picture, mean
  double peak_memory_bytes = 0, bundle_bytes = 0;
  Image first, mean;  // a picture, and the mean of all

  // Returns error and time, as they are weighed against others.
  Tradeoff tradeoff() const;
  std::ptrdiff_t changes() const;  // of the scene's own
};

// A Recommendation says which setting to take for a goal.
struct Recommendation {
  std::string goal;   // in words
  MeasureGoal asked;  // for the whole picture
  bool found = false;
  bool bound_counts = false;  // a setting was left out whose bias is, or may be, beyond the most
  double most_bias = 0;       // MeasureOptions::most_bias
  std::string name;
  std::vector<std::string> render, partition;
  int spp = 0;
  double error = 0, error_within = 0;  // of the whole picture; half the width of its interval
  int rendered_spp = 0;                // where it was measured: `spp` unless that would take too long
  double cpu_s = 0, wall_s = 0;        // predicted, of the whole picture
  double bias = 0;                     // of the error
  double bias_within = 0;              // half the width of its interval
  double farm_s = 0;                   // on the cluster; 0: not known
  Estimate luminance;                  // off, as ErrorStatistics
};

// A Measurement holds all that was measured.
struct Measurement {
  std::vector<Axis> axes;
  Reference reference;
  int reference_spp = 0;  // of each half
  // They begin with the scene's own, then one change each, then what the search for a recommendation tried.
  std::vector<MeasuredSetting> settings;
  std::vector<MeasuredSetting> samples;  // the scene's own at other counts, ascending
  ScalingLaw law;
  double most_bias = 0.01;  // as the options have it
  int scene_spp = 1;        // samples that the scene asks for
  double full_size = 1;     // pixels of the whole picture over those measured
  Farm farm;
  double parallelism = 1;  // CPU seconds a second
  std::vector<Recommendation> recommendations;
};

// MeasureNews tells what happens on the way: a line to say, and how far the measurement is.
struct MeasureNews {
  std::function<void(const std::string&)> say;
  std::function<void(double fraction, const char* what)> progress;
};

// Renders with each setting, again and again, until all is known or the time is up. `execute` starts a
// program. Throws what rendering the reference throws.
Measurement measure(const MeasureOptions& options, const Execute& execute, const MeasureNews& news);

}  // namespace vitrail
