// SPDX-License-Identifier: Apache-2.0
// These rays connect to lights.
#pragma once

#include <bit>
#include <cstdint>
#include <limits>

#include "tracer/lights/light_sampler.h"
#include "tracer/rays/direction.h"
#include "tracer/rays/ray.h"

namespace vitrail {

// It says where a ray starts.
struct Departure {
  Point3d p;       // what it leaves
  Point3f origin;  // beside it
  std::uint32_t exclude = no_triangle;
  std::uint8_t inside = 0;  // state of Interiors
};

// It is a connection's ray: its coded direction, and its end in lengths of that direction; ∞ where its light
// is.
struct Aimed {
  DirectionCode direction;
  Vector3f rounded = decode_direction(direction);
  double end = std::numeric_limits<double>::infinity();
  double cosine = 1;  // of its direction to the surface's normal there; of StraightAim's slope
};

// Aims from where the ray departs, beside the point that the light was sampled for. The ray ends at the
// light, where it meets the sampled surface, or the plane of a sampled triangle. It goes by its rounded
// direction, so it does not end quite at the sampled point. An error of the direction counts there by the
// inverse cosine.
Aimed aim(const Departure& from, const LightSample& light);

// Returns a float that is not above x ≥ 0.
inline float float_below(double x) {
  const auto nearest = static_cast<float>(x);
  if (!(static_cast<double>(nearest) > x)) return nearest;
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(nearest) - 1);
}

}  // namespace vitrail
