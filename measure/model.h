// SPDX-License-Identifier: Apache-2.0
// What a setting would reach with other samples, and which one to take.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace vitrail {

// How a render of the scene behaves: noise falls as samples^−slope, and time is start + samples · each.
struct ScalingLaw {
  double slope = 1;
  double start_s = 0;
};

// Of a setting, at `spp` samples a pixel.
struct Tradeoff {
  double noise = 0, bias = 0;  // relMSE; bias ≥ 0
  int spp = 1;
  double sample_s = 0;  // CPU seconds of one sample of every pixel
  int least_spp = 1;    // of fewer it is not known
  double slope = 0;     // its own, where it was measured at several counts; 0: the law's
};

double predicted_error(const Tradeoff& t, const ScalingLaw& law, double spp);
double predicted_cpu_s(const Tradeoff& t, const ScalingLaw& law, double spp);
// The processor seconds of a sample of every pixel, of a render that traced for so long. No core traces one
// of a pixel in less than 20 ns: where the measured start is longer than a render, on a busy machine, a
// sample would cost nothing, and any number of them would be affordable.
double sample_time_s(double tracing_s, double spp, std::size_t pixels);
// The least samples that reach an error; empty where the bias alone is greater.
std::optional<double> samples_for_error(const Tradeoff& t, const ScalingLaw& law, double error);
// The most samples that fit; empty where not even one does.
std::optional<double> samples_within(const Tradeoff& t, const ScalingLaw& law, double cpu_s);

struct Goal {
  std::optional<double> error, cpu_s;  // one of them
};
struct Prediction {
  std::size_t index = 0;  // of the tradeoff
  int spp = 0;
  double error = 0, cpu_s = 0;
};
// For an error: the cheapest that reaches it. For a time: the least error within it. Empty where none does.
std::optional<Prediction> best(std::span<const Tradeoff> tradeoffs, const ScalingLaw& law, const Goal& goal);

// A guess at a setting that takes choices of several axes, of those that take one of them each: noise and
// time multiply; of the biases the greatest, less than which they are only where they cancel. It is
// optimistic, so that the search that measures what looks best does not pass it by.
Tradeoff combined(const Tradeoff& base, std::span<const Tradeoff> changes, const ScalingLaw& law);

// The slope of log noise over log samples by least squares, within what such curves are: [0.7, 1.6]; 1 for
// fewer than two counts. Points whose noise is not positive are left out.
double fitted_slope(std::span<const double> spp, std::span<const double> noise);

// Which of (cost, error) no other beats in both.
std::vector<bool> pareto_front(std::span<const double> cost, std::span<const double> error);

}  // namespace vitrail
