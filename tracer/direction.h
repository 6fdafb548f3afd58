// SPDX-License-Identifier: Apache-2.0
// Directions in 48 bits: two 24-bit octahedral coordinates (Meyer et al. 2010), resolution 1.2e-7 rad. Every
// ray takes its direction through this code when it is made, so that a ray sent to another rank is bit for
// bit the ray kept here. The axes are exact.
#pragma once

#include <cstdint>

#include "scene/vec.h"

namespace vitrail {

struct DirectionCode {
  std::uint16_t word[3]{};
  bool operator==(const DirectionCode&) const = default;
};

// `d` finite and not zero; any length.
inline DirectionCode encode_direction(Vector3d d) {
  const double norm = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
  double x = d.x / norm, y = d.y / norm;
  if (d.z < 0) {
    const double folded = (1 - std::abs(y)) * (x < 0 ? -1 : 1);
    y = (1 - std::abs(x)) * (y < 0 ? -1 : 1);
    x = folded;
  }
  const auto quantise = [](double v) {
    return static_cast<std::uint32_t>(std::nearbyint(std::clamp((v + 1) * 8388607.0, 0.0, 16777214.0)));
  };
  const std::uint32_t a = quantise(x), b = quantise(y);
  return {{static_cast<std::uint16_t>(a >> 8), static_cast<std::uint16_t>((a & 0xff) << 8 | b >> 16),
           static_cast<std::uint16_t>(b)}};
}

// Unit vector, rounded to float.
inline Vector3f decode_direction(DirectionCode code) {
  const std::uint32_t a = static_cast<std::uint32_t>(code.word[0]) << 8 | code.word[1] >> 8;
  const std::uint32_t b = (static_cast<std::uint32_t>(code.word[1]) & 0xff) << 16 | code.word[2];
  double x = a / 8388607.0 - 1, y = b / 8388607.0 - 1;
  const double z = 1 - std::abs(x) - std::abs(y);
  if (z < 0) {
    const double folded = (1 - std::abs(y)) * (x < 0 ? -1 : 1);
    y = (1 - std::abs(x)) * (y < 0 ? -1 : 1);
    x = folded;
  }
  return cast<float>(normalize(Vector3d{x, y, z}));
}

// The orientation of a face, either side: two 10-bit octahedral coordinates, to 0.24°.
struct FaceCode {
  std::uint32_t bits = 0;
};

inline FaceCode encode_face(Vector3d normal) {
  const DirectionCode code = encode_direction(normal.z < 0 ? -normal : normal);
  const std::uint32_t a = static_cast<std::uint32_t>(code.word[0]) >> 6;
  const std::uint32_t b = (static_cast<std::uint32_t>(code.word[1]) & 0xff) << 2 | code.word[2] >> 14;
  return {a << 10 | b};
}

// Whether a face is parallel to the one encoded, to 0.5°. A wedge of that angle in glass spreads the visible
// spectrum by less than 1e-4 rad.
inline bool is_parallel(FaceCode code, Vector3d normal) {
  const DirectionCode centre{{static_cast<std::uint16_t>((code.bits >> 10) << 6 | 32),
                              static_cast<std::uint16_t>(code.bits >> 2 & 0xff),
                              static_cast<std::uint16_t>((code.bits & 3) << 14 | 1 << 13)}};
  const Vector3d face = cast<double>(decode_direction(centre));
  return length(cross(face, normal)) < 0.0045;
}

}  // namespace vitrail
