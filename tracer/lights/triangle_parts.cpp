// SPDX-License-Identifier: Apache-2.0
#include "tracer/lights/triangle_parts.h"

#include <algorithm>
#include <cmath>

namespace vitrail {

TriangleParts::Place uniform_place(float u, float v) {
  double b1 = static_cast<double>(u) / 2, b2 = static_cast<double>(v) / 2;
  const double offset = b2 - b1;
  b1 -= std::min(offset, 0.0);
  b2 += std::max(offset, 0.0);
  return {b1, b2, 1};
}

std::optional<TriangleParts> TriangleParts::of(std::span<const Shine> parts) {
  constexpr double alike = 0.1;  // of all parts that may shine, whatever was found of them
  constexpr double worth_it = 4;
  double total = 0, shining = 0, greatest = 0;
  for (const Shine& part : parts) {
    total += part.mean;
    shining += part.most > 0;
    greatest = std::max(greatest, part.mean);
  }
  if (!(greatest * static_cast<double>(parts.size()) > worth_it * total) || !std::isfinite(total))
    return std::nullopt;
  TriangleParts result;
  result.side_ = static_cast<int>(std::lround(std::sqrt(static_cast<double>(parts.size()))));
  result.cumulative_.push_back(0);
  for (const Shine& part : parts)
    result.cumulative_.push_back(result.cumulative_.back() + (1 - alike) * part.mean / total +
                                 (part.most > 0 ? alike / shining : 0));
  for (double& sum : result.cumulative_) sum /= result.cumulative_.back();
  return result;
}

TriangleParts::Place TriangleParts::choose(double choice, float u, float v) const {
  auto part =
      static_cast<std::size_t>(std::ranges::upper_bound(cumulative_, choice) - cumulative_.begin() - 1);
  part = std::min(part, cumulative_.size() - 2);
  while (part > 0 && !(share(part) > 0)) --part;  // by rounding, behind the last
  // Rows before row i hold side² − (side − i)² parts.
  const auto k = static_cast<int>(part);
  const int i = side_ - static_cast<int>(std::ceil(std::sqrt(side_ * side_ - k)));
  const int in_row = k - (side_ * side_ - (side_ - i) * (side_ - i));
  const Place within = uniform_place(u, v);
  const bool between = in_row % 2 == 1;
  const double x = between ? 1 - within.b1 : within.b1, y = between ? 1 - within.b2 : within.b2;
  return {(i + x) / side_, (in_row / 2 + y) / side_, share(part) * side_ * side_};
}

double TriangleParts::density(double b1, double b2) const {
  const double x = std::clamp(b1, 0.0, 1.0) * side_, y = std::clamp(b2, 0.0, 1.0) * side_;
  const int i = std::min(static_cast<int>(x), side_ - 1), j = std::min(static_cast<int>(y), side_ - 1 - i);
  const bool between = i + j + 1 < side_ && (x - i) + (y - j) > 1;
  const int part = side_ * side_ - (side_ - i) * (side_ - i) + 2 * j + (between ? 1 : 0);
  return share(static_cast<std::size_t>(part)) * side_ * side_;
}

}  // namespace vitrail
