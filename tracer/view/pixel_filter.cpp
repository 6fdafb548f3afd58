// SPDX-License-Identifier: Apache-2.0
#include "tracer/view/pixel_filter.h"

#include <algorithm>
#include <cmath>

#include "scene/geometry/portable_math.h"

namespace vitrail {

namespace {

// The filter along one axis at distance x from its centre, not normalised.
double value(const TriangleFilter&, double radius, double x) { return std::max(0.0, radius - std::abs(x)); }
double value(const GaussianFilter& f, double radius, double x) {
  const auto gauss = [&](double d) {
    return portable_exp(std::max(-700.0, -d * d / (2 * f.sigma * f.sigma)));
  };
  return std::max(0.0, gauss(x) - gauss(radius));
}

// Mitchell and Netravali 1988, eq. 8, with x stretched so that it ends at the radius.
double value(const MitchellFilter& f, double radius, double x) {
  const double b = f.b, c = f.c, t = 2 * std::abs(x) / radius;
  const double inner = ((12 - 9 * b - 6 * c) * t + (-18 + 12 * b + 6 * c)) * t * t + (6 - 2 * b);
  const double outer =
      (((-b - 6 * c) * t + (6 * b + 30 * c)) * t + (-12 * b - 48 * c)) * t + (8 * b + 24 * c);
  return t < 1 ? inner : t < 2 ? outer : 0.0;
}

double sinc(double x) { return std::abs(x) < 1e-5 ? 1 : sin_pi(x) / (pi * x); }
double value(const SincFilter& f, double, double x) {
  return std::abs(x) < f.tau ? sinc(x) * sinc(x / f.tau) : 0;
}

}  // namespace

void FilterSampler::Axis::tabulate(auto&& f) {
  cumulative.assign(resolution + 1, 0);
  std::vector<bool> below(resolution, false);
  double sum = 0, total = 0;
  for (std::size_t i = 0; i < resolution; ++i) {
    const double v = f((static_cast<double>(i) + 0.5) * (2 * radius / resolution) - radius);
    below[i] = v < 0;
    sum += v;
    total += std::abs(v);
    cumulative[i + 1] = total;
  }
  if (!(sum > 0)) return cumulative.clear();  // no filter at all: a box
  for (double& c : cumulative) c /= total;
  guide = GuideTable(cumulative, 2 * resolution);
  if (std::find(below.begin(), below.end(), true) == below.end()) return;
  total_weight = total / sum;
  negative = std::move(below);
}

FilterSampler::FilterSampler(const Filter& filter, bool splats) : splats_(splats) {
  std::visit(
      [&](const auto& f) {
        x_.radius = f.radius_x;
        y_.radius = f.radius_y;
        if constexpr (!std::is_same_v<std::decay_t<decltype(f)>, BoxFilter>)
          for (Axis* axis : {&x_, &y_}) axis->tabulate([&](double x) { return value(f, axis->radius, x); });
      },
      filter);
}

FilterSample FilterSampler::Axis::sample(double u) const {
  if (cumulative.empty()) return {{(2 * u - 1) * radius, 0}, 1};
  const std::size_t bin = guide.bin(cumulative, u);
  const double width = cumulative[bin + 1] - cumulative[bin];
  const double within = width > 0 ? std::clamp((u - cumulative[bin]) / width, 0.0, 1.0) : 0.5;
  const double offset = (static_cast<double>(bin) + within) * (2 * radius / resolution) - radius;
  return {{offset, 0}, !negative.empty() && negative[bin] ? -total_weight : total_weight};
}

double FilterSampler::Axis::value(double x) const {
  if (!(-radius <= x && x < radius)) return 0;
  const double bin_width = 2 * radius / resolution;
  if (cumulative.empty()) return 1 / (2 * radius);
  const auto bin = std::min(static_cast<std::size_t>((x + radius) / bin_width), resolution - 1);
  const double share = (cumulative[bin + 1] - cumulative[bin]) * total_weight / bin_width;
  return !negative.empty() && negative[bin] ? -share : share;
}

Footprint FilterSampler::footprint(float u, float v) const {
  const double x = static_cast<double>(u) - 0.5, y = static_cast<double>(v) - 0.5;
  const auto first = [](double at, double radius) { return static_cast<int>(std::floor(at - radius)) + 1; };
  const auto pixels = [&](double at, double radius) {
    return std::min(static_cast<int>(std::floor(at + radius)) + 1 - first(at, radius), most_splat_pixels);
  };
  Footprint print{first(x, x_.radius), first(y, y_.radius), pixels(x, x_.radius), pixels(y, y_.radius), {}};
  std::size_t next = 0;
  for (int j = 0; j < print.high; ++j) {
    const double row = std::ldexp(y_.value(y - (print.y + j)), weight_bits);
    for (int i = 0; i < print.wide; ++i)
      print.weights[next++] = static_cast<std::int32_t>(std::lround(row * x_.value(x - (print.x + i))));
  }
  return print;
}

Neighbours FilterSampler::Axis::neighbours() const {
  constexpr int steps = 8 * static_cast<int>(resolution);
  const double step = 2 * radius / steps;
  std::vector<double> correlations;
  for (int apart = 0; apart < 2 * radius; ++apart) {
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
      const double x = (i + 0.5) * step - radius;
      sum += value(x) * value(x + apart) * step;
    }
    correlations.push_back(sum);
  }
  return along_axis(correlations);
}

Neighbours FilterSampler::neighbours() const {
  if (!splats_) return {};
  return product(x_.neighbours(), y_.neighbours());
}

std::optional<Point2d> FilterSampler::even_radius() const {
  if (splats_) return Point2d{0.5, 0.5};
  if (!x_.cumulative.empty() || !y_.cumulative.empty()) return std::nullopt;
  return Point2d{x_.radius, y_.radius};
}

FilterSample FilterSampler::sample(float u, float v) const {
  if (splats_) return {{static_cast<double>(u) - 0.5, static_cast<double>(v) - 0.5}, 1};
  const FilterSample x = x_.sample(static_cast<double>(u)), y = y_.sample(static_cast<double>(v));
  return {{x.offset.x, y.offset.x}, x.weight * y.weight};
}

}  // namespace vitrail
