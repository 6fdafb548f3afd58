// SPDX-License-Identifier: Apache-2.0
// This is the polarisation of light between smooth faces of glass. A face reflects light whose field is
// across the plane of incidence (s) otherwise than light whose field is in it (p). Faces that share that
// plane keep the two apart: one pane of index 1.5 lets 1.4 % more of the light at 60° through than it would
// if every face met unpolarised light, two let 6.5 % more through.
//
// Paths and photons carry the sum of s and p, and beside it Stokes' Q/I = (s − p)/(s + p). Both are linear in
// what faces do, so Q/I may be rounded by chance and the mean stays that of s and p apart. One Q/I stands for
// four wavelengths. Where the plane of incidence turns by φ, Q becomes Q cos 2φ (Born & Wolf, §1.4.2); the
// rest (U) is dropped, as is all polarisation by anything but smooth dielectric faces.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "scene/geometry/vec.h"

namespace vitrail {

// It holds Q/I in steps of 1/31.
struct Polarization {
  std::int8_t code = 0;  // −31 (p alone) to 31 (s alone); 0: unpolarised

  static constexpr int steps = 31;
  double value() const { return code / static_cast<double>(steps); }
  // Returns q rounded up or down, so that the mean over u in [0,1) is q; q in [−1,1].
  static Polarization rounded(double q, float u) {
    const double step = std::floor(q * steps + static_cast<double>(u));
    return {static_cast<std::int8_t>(std::clamp<double>(step, -steps, steps))};
  }
  // Returns the code in 6 bits, two's complement; `of` takes anything above them.
  std::uint32_t bits() const { return static_cast<std::uint32_t>(code) & 0x3f; }
  static Polarization of(std::uint32_t bits) {
    return {static_cast<std::int8_t>(static_cast<int>((bits & 0x3f) ^ 0x20) - 0x20)};
  }
};

// Returns Q/I as a face of normal n sees it of light that goes along d and came by a face of normal `before`:
// the planes of incidence hold d and either normal. All are of unit length.
inline double seen_by_face(Polarization polarization, Vector3d before, Vector3d d, Vector3d n) {
  const Vector3d s = cross(before, d), t = cross(n, d);
  const double lengths = dot(s, s) * dot(t, t);
  if (!(lengths > 0)) return 0;  // along the normal s and p are alike
  const double cosine = dot(s, t);
  return polarization.value() * std::clamp(2 * cosine * cosine / lengths - 1, -1.0, 1.0);
}

}  // namespace vitrail
