// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/read/noise.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "importers/povray/read/whole.h"

namespace vitrail::pov {

namespace {

// The finaliser of MurmurHash3 (Appleby 2011) over the corner's place.
std::uint32_t hash(std::int64_t x, std::int64_t y, std::int64_t z) {
  auto h = static_cast<std::uint32_t>(x * 73856093 ^ y * 19349663 ^ z * 83492791);
  h ^= h >> 16, h *= 0x85ebca6bu, h ^= h >> 13, h *= 0xc2b2ae35u, h ^= h >> 16;
  return h;
}

// One of the twelve directions to the middles of a cube's edges.
double gradient(std::uint32_t h, double x, double y, double z) {
  const std::uint32_t k = h % 12;
  const double a = k < 8 ? x : y, b = k < 4 ? y : z;
  return (k & 1 ? -a : a) + (k & 2 ? -b : b);
}

double fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }

}  // namespace

double noise(double x, double y, double z) {
  constexpr double far = 1e9;
  const double fx = std::floor(std::clamp(x, -far, far)), fy = std::floor(std::clamp(y, -far, far)),
               fz = std::floor(std::clamp(z, -far, far));
  const std::int64_t ix = whole(fx), iy = whole(fy), iz = whole(fz);
  x -= fx, y -= fy, z -= fz;
  const double u = fade(x), v = fade(y), w = fade(z);
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const int i = corner & 1, j = corner >> 1 & 1, k = corner >> 2;
    const double weight = (i ? u : 1 - u) * (j ? v : 1 - v) * (k ? w : 1 - w);
    sum += weight * gradient(hash(ix + i, iy + j, iz + k), x - i, y - j, z - k);
  }
  return std::clamp(0.5 + 0.5 * sum, 0.0, 1.0);
}

}  // namespace vitrail::pov
