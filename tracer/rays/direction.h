// SPDX-License-Identifier: Apache-2.0
// This file holds directions in 48 bits: two 24-bit octahedral coordinates (Meyer et al. 2010), resolution
// 1.2e-7 rad. Every ray takes its direction through this code when it is made. A ray sent to another rank is
// thus bit for bit the ray kept here. The axes are exact.
#pragma once

#include <cstdint>

#include "scene/geometry/vec.h"

namespace vitrail {

struct DirectionCode {
  // They are two numbers of three bytes, least significant first: bytes, since records hold them unaligned.
  std::uint8_t byte[6]{};
  bool operator==(const DirectionCode&) const = default;

  static DirectionCode of(std::uint32_t a, std::uint32_t b) {
    const auto at = [](std::uint32_t n, int shift) { return static_cast<std::uint8_t>(n >> shift); };
    return {{at(a, 0), at(a, 8), at(a, 16), at(b, 0), at(b, 8), at(b, 16)}};
  }
  std::uint32_t first() const { return number(0); }
  std::uint32_t second() const { return number(3); }

 private:
  std::uint32_t number(int i) const {
    return byte[i] | static_cast<std::uint32_t>(byte[i + 1]) << 8 |
           static_cast<std::uint32_t>(byte[i + 2]) << 16;
  }
};

// Folds a point of the octahedron's lower half to its place in the square, beyond the edges of the upper
// half, and back.
inline void fold_if(bool lower, double& x, double& y) {
  const double folded_x = 1 - std::abs(y), folded_y = 1 - std::abs(x);
  if (!lower) return;
  x = x < 0 ? -folded_x : folded_x;
  y = y < 0 ? -folded_y : folded_y;
}

// `d` is finite and not zero, of any length.
inline DirectionCode encode_direction(Vector3d d) {
  const double norm = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
  const double inverse = 1 / norm;
  double x = d.x * inverse, y = d.y * inverse;
  fold_if(d.z < 0, x, y);
  const auto quantise = [](double v) {
    return static_cast<std::uint32_t>(
        static_cast<std::int32_t>(std::clamp((v + 1) * 8388607.0, 0.0, 16777214.0) + 0.5));
  };
  return DirectionCode::of(quantise(x), quantise(y));
}

// Returns a unit vector, rounded to float.
inline Vector3f decode_direction(DirectionCode code) {
  // It is exact at the axes: 8388607 times its rounded inverse is 1.
  const auto coordinate = [](std::uint32_t n) {
    return (static_cast<std::int32_t>(n) - 8388607) * (1 / 8388607.0);
  };
  double x = coordinate(code.first()), y = coordinate(code.second());
  const double z = 1 - std::abs(x) - std::abs(y);
  fold_if(z < 0, x, y);
  const Vector3d d{x, y, z};  // at least 1/√3 long
  return cast<float>(d * (1 / std::sqrt(dot(d, d))));
}

// It is the orientation of a face, either side: two 10-bit octahedral coordinates, to 0.24°.
struct FaceCode {
  std::uint32_t bits = 0;
  static constexpr int length = 20;  // in bits
};

inline FaceCode encode_face(Vector3d normal) {
  const DirectionCode code = encode_direction(normal.z < 0 ? -normal : normal);
  return {(code.first() >> 14) << 10 | code.second() >> 14};
}

// Returns the normal, of unit length, of either side.
inline Vector3d decode_face(FaceCode code) {
  const DirectionCode centre =
      DirectionCode::of((code.bits >> 10) << 14 | 1 << 13, (code.bits & 0x3ff) << 14 | 1 << 13);
  return cast<double>(decode_direction(centre));
}

// Returns whether a face is parallel to the one encoded, to 0.5°. A wedge of that angle in glass spreads the
// visible spectrum by less than 1e-4 rad.
inline bool is_parallel(FaceCode code, Vector3d normal) {
  return length(cross(decode_face(code), normal)) < 0.0045;
}

}  // namespace vitrail
