// SPDX-License-Identifier: Apache-2.0
#include "tracer/transport/aim.h"

#include <algorithm>
#include <cmath>

#include "tracer/quadrics/quadric_hits.h"
#include "tracer/quadrics/quadric_surface.h"
#include "tracer/rays/rounding.h"

namespace vitrail {

namespace {

// Where the ray meets the quadric, nearest to where it ended. Near its limb it may pass by.
void end_on_quadric(const Ray& ray, const EmissiveQuadric& q, Aimed& aimed) {
  const QuadricHits hits =
      quadric_hits(prepare(ray), q.to_bundle, q.quadric.quadric, ray.exclude == q.triangle);
  if (hits.count == 0) return;
  const auto off = [&](int i) { return std::abs(hits.at[i].t - aimed.end); };
  const auto& [t, local] = hits.at[hits.count == 2 && off(1) < off(0) ? 1 : 0];
  const Vector3d direction = cast<double>(ray.direction);
  aimed.end = t * (1 - 1e-12);
  aimed.cosine = dot(direction, placed_quadric_normal(q.quadric, q.to_bundle, local));
}

}  // namespace

Aimed aim(const Departure& from, const LightSample& light) {
  if (std::isinf(light.distance)) return {encode_direction(light.to_light)};
  const Vector3d way = from.p + light.to_light * light.distance - cast<double>(from.origin);
  Aimed aimed{encode_direction(dot(way, way) > 0 ? way : light.to_light)};
  const Vector3d direction = cast<double>(aimed.rounded);
  const double distance = length(way), there = dot(way, direction) / dot(direction, direction);
  aimed.end = there;
  if (light.quadric) {
    end_on_quadric({from.origin, aimed.rounded, from.exclude}, *light.quadric, aimed);
    return aimed;
  }
  const double height = dot(way, light.normal), cosine = dot(direction, light.normal);
  if (!(height * cosine > 0)) {
    aimed.end *= before_point;
    return aimed;
  }
  // So much aside, a neighbour may stand out of the plane by its tilt.
  const double aside = direction_rounding * distance / std::abs(cosine);
  const double plane = (height / cosine) * (1 - 1e-12) - aside * light.tilt_rad / std::abs(cosine);
  aimed.end = std::clamp(plane, 0.5 * there, 2 * there);
  aimed.cosine = cosine;
  return aimed;
}

}  // namespace vitrail
