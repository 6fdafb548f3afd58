// SPDX-License-Identifier: Apache-2.0
#include "measure/model.h"

#include <algorithm>
#include <cmath>

namespace vitrail {

namespace {

double slope_of(const Tradeoff& t, const ScalingLaw& law) { return t.slope > 0 ? t.slope : law.slope; }

}  // namespace

double predicted_error(const Tradeoff& t, const ScalingLaw& law, double spp) {
  return t.bias + t.noise * std::pow(spp / t.spp, -slope_of(t, law));
}

double predicted_cpu_s(const Tradeoff& t, const ScalingLaw& law, double spp) {
  return law.start_s + spp * t.sample_s;
}

double sample_time_s(double tracing_s, double spp, std::size_t pixels) {
  constexpr double fastest_s = 20e-9;
  return std::max(tracing_s / spp, fastest_s * static_cast<double>(pixels));
}

std::optional<double> samples_for_error(const Tradeoff& t, const ScalingLaw& law, double error) {
  if (t.bias >= error) return std::nullopt;
  const double least = t.least_spp;
  if (t.noise <= 0) return least;
  return std::max(least, t.spp * std::pow(t.noise / (error - t.bias), 1 / slope_of(t, law)));
}

std::optional<double> samples_within(const Tradeoff& t, const ScalingLaw& law, double cpu_s) {
  const double spp = t.sample_s > 0 ? (cpu_s - law.start_s) / t.sample_s : 1;
  if (spp < t.least_spp) return std::nullopt;
  return spp;
}

std::optional<Prediction> best(std::span<const Tradeoff> tradeoffs, const ScalingLaw& law,
                               const MeasureGoal& goal) {
  std::optional<Prediction> found;
  for (std::size_t i = 0; i < tradeoffs.size(); ++i) {
    const Tradeoff& t = tradeoffs[i];
    const auto spp =
        goal.error ? samples_for_error(t, law, *goal.error) : samples_within(t, law, *goal.cpu_s);
    if (!spp || *spp > 1e9) continue;
    // What is whole but for rounding stays.
    const double whole = goal.error ? std::ceil(*spp * (1 - 1e-12)) : std::floor(*spp);
    const Prediction p{i, static_cast<int>(whole), predicted_error(t, law, whole),
                       predicted_cpu_s(t, law, whole)};
    if (!found || (goal.error ? p.cpu_s < found->cpu_s : p.error < found->error)) found = p;
  }
  return found;
}

Tradeoff combined(const Tradeoff& base, std::span<const Tradeoff> changes, const ScalingLaw& law) {
  Tradeoff t = base;
  for (const Tradeoff& change : changes) {
    const double own = predicted_error({base.noise, 0, base.spp}, law, change.spp);
    if (own > 0) t.noise *= change.noise / own;
    if (base.sample_s > 0) t.sample_s *= change.sample_s / base.sample_s;
    t.bias = std::max(t.bias, change.bias);
    t.least_spp = std::max(t.least_spp, change.least_spp);
  }
  return t;
}

double fitted_slope(std::span<const double> spp, std::span<const double> noise) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < spp.size(); ++i) {
    if (!(noise[i] > 0)) continue;
    const double u = std::log(spp[i]), v = std::log(noise[i]);
    ++n, x += u, y += v, xx += u * u, xy += u * v;
  }
  const double spread = n * xx - x * x, rounding = 1e-9 * n * xx;
  return n < 2 || spread <= rounding ? 1 : std::clamp(-(n * xy - x * y) / spread, 0.7, 1.6);
}

std::vector<bool> pareto_front(std::span<const double> cost, std::span<const double> error) {
  std::vector<bool> front(cost.size(), true);
  for (std::size_t i = 0; i < cost.size(); ++i)
    for (std::size_t j = 0; j < cost.size() && front[i]; ++j) {
      const bool no_worse = cost[j] <= cost[i] && error[j] <= error[i],
                 better = cost[j] < cost[i] || error[j] < error[i];
      if (no_worse && better) front[i] = false;
    }
  return front;
}

}  // namespace vitrail
