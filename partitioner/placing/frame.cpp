// SPDX-License-Identifier: Apache-2.0
#include "partitioner/placing/frame.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <type_traits>
#include <utility>

namespace vitrail {

double greatest(Vector3d v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

namespace {

double distance(const Viewpoint& eye, Point3d p) {
  const Vector3d way = p - eye.at;
  return eye.along ? length(way - *eye.along * dot(way, *eye.along)) : length(way);
}

// The least value that half of the weight is not above.
double middle(const std::vector<double>& values, const std::vector<double>& weights) {
  std::vector<std::uint32_t> order(values.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::sort(order, {}, [&](std::uint32_t i) { return std::pair(values[i], i); });
  double left = std::accumulate(weights.begin(), weights.end(), 0.0) / 2;
  for (const std::uint32_t i : order)
    if ((left -= weights[i]) <= 0) return values[i];
  return values[order.back()];
}

Point3d middle(const std::vector<FramePart>& parts, const std::vector<double>& weights) {
  Point3d p;
  std::vector<double> values(parts.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::ranges::transform(parts, values.begin(), [&](const FramePart& part) { return part.centre[axis]; });
    p[axis] = middle(values, weights);
  }
  return p;
}

// Of the weight, what is too far from there.
double far_share(const std::vector<FramePart>& parts, const std::vector<double>& weights, Point3d from) {
  double all = 0, far = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    all += weights[i];
    if (greatest(parts[i].centre - from) > near_radii * parts[i].radius) far += weights[i];
  }
  return all > 0 ? far / all : 0;
}

}  // namespace

Viewpoint viewpoint_of(const Camera& camera) {
  return std::visit(
      [](const auto& c) {
        Viewpoint eye{transform_point(c.camera_to_world, {0, 0, 0}), {}};
        if constexpr (std::is_same_v<std::decay_t<decltype(c)>, OrthographicCamera>)
          eye.along = normalize(transform_vector(c.camera_to_world, {0, 0, 1}));
        return eye;
      },
      camera);
}

Point3d origin_of(const std::vector<FramePart>& parts, const Bounds3d& box,
                  const std::optional<Viewpoint>& eye) {
  constexpr double few = 1.0 / 16;
  std::vector<double> weights;
  for (const FramePart& p : parts) {
    const double seen = eye && p.radius > 0 ? p.radius / (p.radius + distance(*eye, p.centre)) : 1;
    weights.push_back(p.radius > 0 ? p.triangles * seen * seen : 0);
  }
  const Point3d centre = center(box);
  const double far = far_share(parts, weights, centre);
  if (!(far > few)) return centre;
  const Point3d chosen = middle(parts, weights);
  return far_share(parts, weights, chosen) < far ? chosen : centre;
}

FramePart whole_of(const std::vector<FramePart>& parts) {
  FramePart whole;
  if (parts.empty()) return whole;
  std::vector<double> weights, distances;
  for (const FramePart& p : parts) weights.push_back(p.triangles);
  whole.centre = middle(parts, weights);
  for (const FramePart& p : parts) distances.push_back(greatest(p.centre - whole.centre) + p.radius);
  whole.radius = middle(distances, weights);
  whole.triangles = std::accumulate(weights.begin(), weights.end(), 0.0);
  return whole;
}

}  // namespace vitrail
