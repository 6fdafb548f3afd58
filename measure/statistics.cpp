// SPDX-License-Identifier: Apache-2.0
#include "measure/statistics.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "compare/color_difference.h"
#include "compare/flip.h"
#include "compare/metrics.h"
#include "compare/ztest.h"

namespace vitrail {

namespace {

// The t that |T| exceeds in 5 % of cases.
double t_quantile(int degrees_of_freedom) {
  double low = 1, high = 20;
  for (int i = 0; i < 50; ++i) {
    const double t = (low + high) / 2;
    (two_sided_p(t, degrees_of_freedom) > 0.05 ? low : high) = t;
  }
  return (low + high) / 2;
}

double sum_over(const Image& image, const std::function<double(std::size_t)>& term) {
  double sum = 0;
  for (std::size_t i = 0; i < image.values.size(); ++i)
    if (const double v = term(i); std::isfinite(v)) sum += v;
  return sum / static_cast<double>(image.values.size());
}

// Mean of (a − u)(b − v)/(r² + 0.01) over all channels; u and v are pictures of the seeds of a and b.
double product_of_changes(const Image& a, const Image& u, const Image& b, const Image& v,
                          const Reference& r) {
  return sum_over(a, [&](std::size_t i) {
    const double mean = static_cast<double>(r.mean.values[i]);
    return (static_cast<double>(a.values[i]) - static_cast<double>(u.values[i])) *
           (static_cast<double>(b.values[i]) - static_cast<double>(v.values[i])) / (mean * mean + 0.01);
  });
}

// Mean of (a − r₁)(b − r₂)/(r² + 0.01) over all channels.
double product(const Image& a, const Image& b, const Reference& r) {
  return sum_over(a, [&](std::size_t i) {
    const double x = static_cast<double>(a.values[i]), y = static_cast<double>(b.values[i]),
                 first = static_cast<double>(r.first.values[i]),
                 second = static_cast<double>(r.second.values[i]),
                 mean = static_cast<double>(r.mean.values[i]);
    return 0.5 * ((x - first) * (y - second) + (y - first) * (x - second)) / (mean * mean + 0.01);
  });
}

}  // namespace

Estimate mean_of(std::span<const double> values) {
  const auto n = static_cast<double>(values.size());
  double sum = 0, squares = 0;
  for (const double v : values) sum += v;
  for (const double v : values) squares += (v - sum / n) * (v - sum / n);
  if (n < 2) return {sum / n, std::numeric_limits<double>::infinity()};
  return {sum / n, t_quantile(static_cast<int>(n) - 1) * std::sqrt(squares / (n - 1) / n)};
}

double expected_bias(const Estimate& estimate) {
  constexpr double half_widths = 1.96;  // in standard errors
  const double error = estimate.half_width / half_widths;
  if (!(error > 0) || std::isinf(error)) return std::max(0.0, estimate.value);
  const double z = estimate.value / error, beyond = 0.5 * std::erfc(-z * std::numbers::sqrt2 / 2);
  constexpr double far_below = -5;  // no such estimate is to be believed; by the tail's series
  if (z < far_below) return -error * z / (z * z + 2);
  return estimate.value + error * std::exp(-z * z / 2) / (std::sqrt(2 * std::numbers::pi) * beyond);
}

Image mean_picture(std::span<const Image> pictures) {
  Image mean = black_image(pictures[0].width, pictures[0].height, 3);
  for (std::size_t i = 0; i < mean.values.size(); ++i) {
    double sum = 0;
    for (const Image& picture : pictures) sum += static_cast<double>(picture.values[i]);
    mean.values[i] = static_cast<float>(sum / static_cast<double>(pictures.size()));
  }
  return mean;
}

Reference make_reference(Image first, Image second) {
  require_same_size(first, second);
  Reference r{std::move(first), std::move(second), {}};
  const Image both[] = {r.first, r.second};
  r.mean = mean_picture(both);
  r.white = bright_luminance(r.mean);
  r.mean_luminance = mean_luminance(r.mean);
  r.relmse = sum_over(r.mean, [&](std::size_t i) {
    const double d = static_cast<double>(r.first.values[i]) - static_cast<double>(r.second.values[i]),
                 m = static_cast<double>(r.mean.values[i]);
    return 0.25 * d * d / (m * m + 0.01);
  });
  return r;
}

namespace {

// bias² without its noise is the mean of `product(i, j)` over pairs of different pictures.
struct Bias {
  Estimate estimate;
  std::vector<double> values;  // the jackknife's pseudo-values, of which it is the mean
};

// By the jackknife (Tukey 1958): what leaving out one picture changes.
template <class Product>
Bias bias_of_pairs(std::size_t n, Product product) {
  std::vector<double> others(n), values(n);
  double pairs = 0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double p = product(i, j);
      pairs += p, others[i] += p, others[j] += p;
    }
  const auto count = static_cast<double>(n);
  const double all = pairs / (count * (count - 1) / 2);
  for (std::size_t i = 0; i < n; ++i) {
    const double left = n > 2 ? (pairs - others[i]) / ((count - 1) * (count - 2) / 2) : all;
    values[i] = count * all - (count - 1) * left;
  }
  return {mean_of(values), values};
}

}  // namespace

ErrorStatistics error_statistics(std::span<const Image> pictures, const Reference& r,
                                 std::span<const Image> unbiased) {
  const std::size_t n = pictures.size();
  std::vector<double> own(n), luminance(n), flip(n), delta_e(n), noise(n);
  for (std::size_t i = 0; i < n; ++i) {
    own[i] = product(pictures[i], pictures[i], r);
    luminance[i] = mean_ratios(pictures[i], r.mean).luminance -
                   (unbiased.empty() ? 1 : mean_ratios(unbiased[i], r.mean).luminance);
    flip[i] = mean_of_valid(hdr_flip(pictures[i], r.mean));
    delta_e[i] = mean_of_valid(ciede2000_map(pictures[i], r.mean, r.white));
  }
  Bias bias =
      bias_of_pairs(n, [&](std::size_t i, std::size_t j) { return product(pictures[i], pictures[j], r); });
  if (!unbiased.empty()) {
    Bias beside = bias_of_pairs(n, [&](std::size_t i, std::size_t j) {
      return product_of_changes(pictures[i], unbiased[i], pictures[j], unbiased[j], r);
    });
    if (beside.estimate.half_width < bias.estimate.half_width) bias = std::move(beside);
  }
  for (std::size_t i = 0; i < n; ++i) noise[i] = own[i] - bias.values[i];
  ErrorStatistics s;
  s.relmse = mean_of(own);
  s.bias = bias.estimate;
  s.noise = mean_of(noise);
  s.luminance = mean_of(luminance);
  s.flip = mean_of(flip);
  s.delta_e = mean_of(delta_e);
  s.flip_of_mean = mean_of_valid(hdr_flip(mean_picture(pictures), r.mean));
  return s;
}

}  // namespace vitrail
