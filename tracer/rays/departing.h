// SPDX-License-Identifier: Apache-2.0
// These functions say where rays that leave a surface start, and what seeds their random numbers.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "tracer/rays/direction.h"
#include "tracer/sampling/sampler.h"

namespace vitrail {

// Moves a hit along the normal, to the side of `direction`. It moves it by more than rounding to float can
// move it back, or part the surface from a copy of it (`rounding` is Interaction's). So the point keeps from
// the neighbours of the triangle that it leaves. Rounding also moves it aside, behind neighbours that are not
// quite in one plane. `doubles` allows for the largest triangles of the scene, which lie where doubles place
// them.
inline Point3f offset_origin(Point3d p, Vector3d normal, double rounding, double doubles,
                             Vector3d direction) {
  const double aside = 1e-9 * std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  const double distance = 3 * rounding + aside + doubles;
  const double side = dot(direction, normal) >= 0 ? 1 : -1;
  return cast<float>(p + normal * (side * distance));
}
// Returns `doubles` by Manifest::scale.
inline double rounding_of_doubles(float scale) { return 0x1p-46 * static_cast<double>(scale); }

// Returns the same wherever the ray is traced. `seed` is the sample_seed.
inline std::uint64_t hash_of_ray(std::uint64_t seed, Point3f origin, DirectionCode direction) {
  const auto bits = [](float x) { return std::uint64_t{std::bit_cast<std::uint32_t>(x)}; };
  return stream_seed(seed, bits(origin.x) << 32 | bits(origin.y),
                     bits(origin.z) << 32 ^ std::uint64_t{direction.first()} << 24 ^ direction.second());
}

// It says what random numbers of a ray are for; those of different use are independent.
enum class RayRandom : std::uint64_t {
  flight,
  choice,
  scattering,
  light,
  layers,
  throughput,
  distance,
  coverage
};
// Returns what the seed of such numbers adds to the hash of the ray.
inline constexpr std::uint64_t stream_factor = 0xd1342543de82ef95u;
inline std::uint64_t stream_offset(std::uint32_t depth, RayRandom use) {
  return (std::uint64_t{depth} << 3 | static_cast<std::uint64_t>(use)) * stream_factor;
}

}  // namespace vitrail
