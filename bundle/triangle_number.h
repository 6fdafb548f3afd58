// SPDX-License-Identifier: Apache-2.0
// The ids of a scene's triangles are counted in 64 bits, those of all instances with them. Rays, hits and
// domain files have the number of a triangle: its id modulo a prime just below 2³². A scene of fewer
// triangles has the ids themselves.
//
// In a larger scene several triangles have one number. It is the same wherever the scene is cut, so that
// films do not depend on the cuts. It decides which triangle a ray starts on and does not hit again, and
// which of two triangles at the same distance counts. The first skips one hit in 2³² wrongly. No two of the
// scene's own triangles have one number, nor two of an object's own, nor two that emit.
#pragma once

#include <cstdint>

namespace vitrail {

// It is the most triangles that a scene has, with all instances.
inline constexpr std::uint64_t most_triangles = std::uint64_t{1} << 62;

// It is a prime, so that copies of an object of any size get numbers that differ.
inline constexpr std::uint32_t triangle_numbers = 4294967291u;

constexpr std::uint32_t triangle_number(std::uint64_t id) {
  return static_cast<std::uint32_t>(id % triangle_numbers);
}

// Returns the number of triangle `number` of an object whose triangle 0 has the number `first`.
[[gnu::always_inline]] constexpr std::uint32_t number_from(std::uint32_t first, std::uint32_t number) {
  const std::uint32_t left = triangle_numbers - first;
  return number < left ? first + number : number - left;
}

}  // namespace vitrail
