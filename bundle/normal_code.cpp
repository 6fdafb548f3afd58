// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "bundle/domain_file.h"

namespace vitrail {

namespace {

constexpr double code_max = 32767;

std::uint32_t quantised(double x) {
  return static_cast<std::uint16_t>(static_cast<std::int16_t>(std::floor(x * code_max + 0.5)));
}

double sign_of(double x) { return x < 0 ? -1 : 1; }

}  // namespace

// n is projected onto the octahedron |x|+|y|+|z| = 1, whose lower half is folded over the upper one.
std::uint32_t encode_normal(Normal3d n) {
  const double sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
  if (!(sum > 0) || !std::isfinite(sum)) return no_normal;
  double x = n.x / sum, y = n.y / sum;
  if (n.z < 0) {
    const double folded = (1 - std::abs(y)) * sign_of(x);
    y = (1 - std::abs(x)) * sign_of(y);
    x = folded;
  }
  return quantised(x) | quantised(y) << 16;
}

Normal3f decode_normal(std::uint32_t code) {
  double x = static_cast<std::int16_t>(code & 0xffff) / code_max;
  double y = static_cast<std::int16_t>(code >> 16) / code_max;
  const double z = 1 - std::abs(x) - std::abs(y);
  if (z < 0) {
    const double unfolded = (1 - std::abs(y)) * sign_of(x);
    y = (1 - std::abs(x)) * sign_of(y);
    x = unfolded;
  }
  const double scale = 1 / std::sqrt(x * x + y * y + z * z);
  return cast<float>(Normal3d{x * scale, y * scale, z * scale});
}

}  // namespace vitrail
