// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "scene/geometry/portable_math.h"
#include "scene/models/pattern_noise.h"
#include "scene/models/pattern_shapes.h"

namespace vitrail {

namespace {

// The nearest point is at most √3 away. So are the next ones, almost always.
constexpr int reach = 2;

double distance(Vector3d d, double metric) {
  if (metric == 2) return length(d);
  if (metric == 1) return std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
  const auto power = [&](double x) { return portable_pow(std::abs(x), metric); };
  return portable_pow(power(d.x) + power(d.y) + power(d.z), 1 / metric);
}

// With the offset as a step along a fourth axis. NaN, as POV-Ray's is: what a step back along an odd metric
// leaves may be less than nothing, and along one that is not whole it has no length.
double displaced(double distance, double metric, double offset) {
  if (offset == 0) return distance;
  if (metric == 1) return distance + offset;
  if (metric == 2) return std::hypot(distance, offset);
  const bool whole = metric == std::floor(metric), even = std::fmod(metric, 2) == 0;
  if (offset < 0 && !whole) return std::numeric_limits<double>::quiet_NaN();
  const double step = portable_pow(std::abs(offset), metric);
  const double sum = portable_pow(distance, metric) + (offset < 0 && !even ? -step : step);
  return sum < 0 ? std::numeric_limits<double>::quiet_NaN() : portable_pow(sum, 1 / metric);
}

struct Nearest {
  std::array<double, 3> distance{std::numeric_limits<double>::infinity(),
                                 std::numeric_limits<double>::infinity(),
                                 std::numeric_limits<double>::infinity()};
  Point3d point;  // the nearest

  void add(double d, Point3d p) {
    if (d < distance[0]) point = p;
    for (double& kept : distance)
      if (d < kept) std::swap(d, kept);
  }
};

}  // namespace

double crackle(const PatternTexture& t, Point3d p) {
  const PatternCrackle& c = t.crackle;
  constexpr double greatest = 0x1p52;
  if (!(std::abs(p.x) < greatest && std::abs(p.y) < greatest && std::abs(p.z) < greatest)) return 0;
  const auto metric = static_cast<double>(c.metric);
  const auto cell = [](double x) { return static_cast<std::int64_t>(std::floor(x)); };
  const std::int64_t x = cell(p.x), y = cell(p.y), z = cell(p.z);
  // How far the cells at that step along an axis are, at least.
  const auto gap = [](double at, std::int64_t from, int step) {
    const double within = at - static_cast<double>(from);
    return step > 0 ? step - within : step < 0 ? within - step - 1 : 0;
  };
  Nearest nearest;
  for (int ring = 0; ring <= reach; ++ring)
    for (int i = -ring; i <= ring; ++i)
      for (int j = -ring; j <= ring; ++j)
        for (int k = -ring; k <= ring; ++k) {
          if (std::max({std::abs(i), std::abs(j), std::abs(k)}) != ring) continue;
          if (std::max({gap(p.x, x, i), gap(p.y, y, j), gap(p.z, z, k)}) > nearest.distance[2]) continue;
          const auto n = numbers_of_cell(x + i, y + j, z + k);
          const Point3d q{static_cast<double>(x + i) + n[0], static_cast<double>(y + j) + n[1],
                          static_cast<double>(z + k) + n[2]};
          nearest.add(distance(q - p, metric), q);
        }
  if (c.solid) return pattern_noise(nearest.point, t.noise);
  std::array<double, 3> d = nearest.distance;
  for (double& distance : d) distance = displaced(distance, metric, static_cast<double>(c.offset));
  const double sum = c.form.x * d[0] + c.form.y * d[1] + c.form.z * d[2];
  return sum > 0 ? std::min(sum, 1.0) : 0;  // NaN is 0
}

}  // namespace vitrail
