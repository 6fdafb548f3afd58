// SPDX-License-Identifier: Apache-2.0
// Means of a film's sums, and how far they are off.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>

#include "film/film.h"
#include "film/film_planes.h"

namespace vitrail {

double Film::value(std::size_t plane, std::uint32_t pixel) const {
  return power_of_two(exponent_) * static_cast<double>(value_of(reading(sums_[plane * pixels() + pixel])));
}

XYZ Film::mean(std::uint32_t pixel) const {
  const double n = weight(pixel);
  if (!(n > 0)) return {};
  const double each = settings_.imaging_ratio / n;
  WideSum y;
  for (std::size_t g = 0; g < sample_groups; ++g) y += reading(sums_[(y_planes + g) * pixels() + pixel]);
  return {each * value(x_plane, pixel), each * (power_of_two(exponent_) * static_cast<double>(value_of(y))),
          each * value(z_plane, pixel)};
}

XYZ Film::mean_of_group(std::uint32_t pixel, std::size_t group) const {
  const double n = weight(pixel);
  if (!(n > 0)) return {};
  const double each = settings_.imaging_ratio / n;
  const std::size_t plane = first_group() + planes_a_group * group;
  return {each * value(plane, pixel), each * value(plane + 1, pixel), each * value(plane + 2, pixel)};
}

double Film::clamped_share() const {
  if (!(key_.clamp > 0)) return 0;
  WideSum all = reading(sums_.back());
  const double taken = static_cast<double>(value_of(all));
  const auto y = std::span(sums_).subspan(y_planes * pixels(), std::size_t{sample_groups} * pixels());
  for (const WideSum& sum : y) all += reading(sum);
  return taken == 0 ? 0 : taken / static_cast<double>(value_of(all));
}

double Film::mean_of_bin(std::uint32_t pixel, std::size_t bin) const {
  const double n = weight(pixel);
  return n > 0 ? settings_.imaging_ratio / n * value(bin_planes + bin, pixel) : 0;
}

double Film::weight(std::size_t group, std::uint32_t pixel) const {
  if (!key_.splats) return reading(counts_[group * pixels() + pixel]);
  return static_cast<double>(value_of(reading(sums_[(first_weights() + group) * pixels() + pixel])));
}

double Film::weight(std::uint32_t pixel) const {
  double sum = 0;
  for (std::size_t g = 0; g < sample_groups; ++g) sum += weight(g, pixel);
  return sum;
}

// With Y_g the sum of the n_g samples of group g, n = n₀ + n₁, the groups being independent with the means
// n_g μ and the variances v_g, d = Y₀/n₀ − Y₁/n₁ has E[d²] = v₀/n₀² + v₁/n₁². So d² n₀n₁/n² has the mean (v₀
// n₁/n₀ + v₁ n₀/n₁)/n²: of n₀ = n₁ that is (v₀ + v₁)/n² = Var[ȳ] whatever the variances, and else where these
// are as the numbers of samples.
double Film::variance_of_mean(std::uint32_t pixel) const {
  static_assert(sample_groups == 2);
  if (key_.one_sequence) return 0;
  const double n0 = weight(0, pixel), n1 = weight(1, pixel), n = n0 + n1;
  if (!(n0 > 0) || !(n1 > 0)) return 0;
  const double d = settings_.imaging_ratio * (value(y_planes, pixel) / n0 - value(y_planes + 1, pixel) / n1);
  return d * d * (n0 / n) * (n1 / n);
}

// The mean is a ratio of sums over k batches, m = ΣY/Σn: Var[m] = k/(k − 1)·Σ(Y_b − m·n_b)²/(Σn)² (Cochran,
// "Sampling Techniques", 1977, §2.11).
double Film::shared_error() const {
  if (key_.photons.photons == 0) return 0;
  double light = 0, count = 0, squares = 0, batches = 0;
  const auto sum = [&](std::size_t i) {
    return static_cast<double>(value_of(reading(sums_[first_batch() + i])));
  };
  for (std::size_t b = 0; b < photon_batches; ++b) {
    light += sum(b), count += sum(photon_batches + b);
    batches += sum(photon_batches + b) > 0;
  }
  if (batches < 2 || !(light > 0)) return 0;
  for (std::size_t b = 0; b < photon_batches; ++b) {
    const double d = sum(b) / light - sum(photon_batches + b) / count;
    squares += d * d;
  }
  return std::sqrt(batches / (batches - 1) * squares);
}

std::uint64_t Film::samples(std::uint32_t pixel) const {
  std::uint64_t sum = 0;
  for (std::size_t g = 0; g < sample_groups; ++g) sum += reading(counts_[g * pixels() + pixel]);
  return sum;
}

std::uint64_t Film::samples() const {
  std::uint64_t sum = 0;
  in_parts(std::span(counts_), scratch_.get(), [&](std::span<const std::uint32_t> part) {
    sum = std::accumulate(part.begin(), part.end(), sum);
  });
  return sum;
}

}  // namespace vitrail
