// SPDX-License-Identifier: Apache-2.0
// A pattern tilts normals where it is the `displacement` of a material, as POV-Ray's `normal {}`. The laws
// are those that POV-Ray's pictures of planes show: which direction each point has, by three lamps.
//
// The new normal is along n + v(p) in the pattern's space, with the unit normal n there. For most kinds v is
// −∇h, with h the number of the texture, a height in units of that space, over steps of 0.02; all of the
// gradient counts, that along n too. `gradient x, 1` of POV-Ray is a height of 2/15 at 1.
//
// Five kinds have a vector of their own in its place, times 15/2 of the number at 1 (the last of the map):
//   bumps     N(p), three noises (pattern_noise.h)
//   dents     N(p)·noise(p)³
//   wrinkles  Σ |N(2ⁱp)|/2ⁱ, i < 10: all of it is pushed to one side
//   ripples   the mean of d·sin 2π(f·r + phase) over ten points; r, d: the distance and direction from it
//   waves     the same of ten wavelengths, the longer the higher
#pragma once

#include "scene/records/pattern_texture.h"

namespace vitrail {

// It is the height that the map of POV-Ray's `normal { PATTERN amount }` has at 1, for an amount of 1.
inline constexpr double bump_height = 2.0 / 15;
inline constexpr double bump_step = 0.02;

// Returns whether the kind has a vector of its own.
bool pushes_by_itself(PatternTexture::Kind kind);
// Returns that vector, for an amount of 1. `p` is in the pattern's space, before tiles and turbulence.
Vector3d push_of_pattern(const PatternTexture& pattern, Point3d p);

// Returns the new normal, in the world and not of unit length, from n in the world and v in the pattern's
// space.
Vector3d tilted_normal(const PatternTexture& pattern, Vector3d n, Vector3d v);

// Returns −∇h by a tetrahedron of points around p; `height(q)` takes points of the pattern's space.
template <class Height>
Vector3d descent_of_height(Point3d p, const Height& height) {
  constexpr double third = 1.0 / 3, along = 0.81649658092772603, across = 0.94280904158206337;
  constexpr double beside = 0.47140452079103168;  // corners of a regular one, as unit vectors
  constexpr Vector3d corners[] = {
      {0, 1, 0}, {across, -third, 0}, {-beside, -third, along}, {-beside, -third, -along}};
  Vector3d sum;
  for (const Vector3d& corner : corners) sum = sum - corner * height(p + corner * bump_step);
  return sum * (0.75 / bump_step);  // as Σ c·cᵀ = 4/3
}

}  // namespace vitrail
