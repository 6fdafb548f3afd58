// SPDX-License-Identifier: Apache-2.0
// Rays that connect to lights.
#pragma once

#include <bit>
#include <cstdint>
#include <limits>

#include "tracer/lights/light_sampler.h"
#include "tracer/rays/direction.h"
#include "tracer/rays/ray.h"

namespace vitrail {

// Where a ray starts.
struct Departure {
  Point3d p;       // what it leaves
  Point3f origin;  // beside it
  std::uint32_t exclude = no_triangle;
  std::uint8_t inside = 0;  // state of Interiors
};

// A connection's ray: coded, and as far as it goes, in lengths of its direction; ∞ where its light is.
struct Aimed {
  DirectionCode direction;
  Vector3f rounded = decode_direction(direction);
  double end = std::numeric_limits<double>::infinity();
  double cosine = 1;  // of its direction to the surface's normal there; of StraightAim's slope
};

// From where it departs, beside the point that the light was sampled for. It ends at the light, where it
// meets the surface that was sampled, of triangles its plane: by its rounded direction, not quite where that
// was. There an error of the direction counts by the inverse cosine.
Aimed aim(const Departure& from, const LightSample& light);

// Not above x ≥ 0.
inline float float_below(double x) {
  const auto nearest = static_cast<float>(x);
  if (!(static_cast<double>(nearest) > x)) return nearest;
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(nearest) - 1);
}

}  // namespace vitrail
