// SPDX-License-Identifier: Apache-2.0
// The model predicts what a setting would reach with other samples, and picks the setting to take.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace vitrail {

// A ScalingLaw is that of a scene: noise falls as samples^−slope, and time is start + samples · each.
struct ScalingLaw {
  double slope = 1;
  double start_s = 0;
};

// A Tradeoff holds what a setting gives and costs at `spp` samples a pixel.
struct Tradeoff {
  double noise = 0, bias = 0;  // relMSE; bias ≥ 0
  int spp = 1;
  double sample_s = 0;  // CPU seconds of one sample of every pixel
  int least_spp = 1;    // of fewer it is not known
  double slope = 0;     // its own, where it was measured at several counts; 0: the law's
};

double predicted_error(const Tradeoff& t, const ScalingLaw& law, double spp);
double predicted_cpu_s(const Tradeoff& t, const ScalingLaw& law, double spp);
// Returns the processor seconds of a sample of every pixel, of a render that traced for so long. No core
// traces one of a pixel in less than 20 ns. On a busy machine the measured start can be longer than a render;
// a sample would then cost nothing, and any number of them would be affordable.
double sample_time_s(double tracing_s, double spp, std::size_t pixels);
// Returns the least samples that reach an error, or nothing where the bias alone is greater.
std::optional<double> samples_for_error(const Tradeoff& t, const ScalingLaw& law, double error);
// Returns the most samples that fit, or nothing where not even one does.
std::optional<double> samples_within(const Tradeoff& t, const ScalingLaw& law, double cpu_s);

struct MeasureGoal {
  std::optional<double> error, cpu_s;  // one of them
};
struct Prediction {
  std::size_t index = 0;  // of the tradeoff
  int spp = 0;
  double error = 0, cpu_s = 0;
};
// Returns the cheapest that reaches an error, or the least error within a time; nothing where none does.
std::optional<Prediction> best(std::span<const Tradeoff> tradeoffs, const ScalingLaw& law,
                               const MeasureGoal& goal);

// Guesses the tradeoff of a setting that takes choices of several axes, from settings that take one of them
// each. Noise and time multiply. The bias is the greatest of theirs; the true one is less only where biases
// cancel. The guess is optimistic, so that the search, which measures what looks best, does not pass it by.
Tradeoff combined(const Tradeoff& base, std::span<const Tradeoff> changes, const ScalingLaw& law);

// Returns the slope of log noise over log samples by least squares, clamped to [0.7, 1.6], the range of such
// curves; 1 for fewer than two counts. Points whose noise is not positive are left out.
double fitted_slope(std::span<const double> spp, std::span<const double> noise);

// Returns which of (cost, error) no other beats in both.
std::vector<bool> pareto_front(std::span<const double> cost, std::span<const double> error);

}  // namespace vitrail
