// SPDX-License-Identifier: Apache-2.0
// Noise of four corners side by side against its definition, corner by corner, bit for bit.
#include "scene/models/lattice_noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "scene/models/lattice_noise_lanes.h"

namespace vitrail::lattice_noise_test {
namespace {

// Perlin's: between the eight corners, each with a value and a slope.
double by_corners(Point3d p, std::uint64_t which) {
  if (!(std::abs(p.x) < 0x1p52 && std::abs(p.y) < 0x1p52 && std::abs(p.z) < 0x1p52)) return 0;
  const double x = std::floor(p.x), y = std::floor(p.y), z = std::floor(p.z);
  const double dx = p.x - x, dy = p.y - y, dz = p.z - z;
  const auto corner = [&](int i, int j, int k) {
    const CellNumbers n = numbers_of_cell(static_cast<std::int64_t>(x) + i, static_cast<std::int64_t>(y) + j,
                                          static_cast<std::int64_t>(z) + k, which);
    const double slope = (2 * n.x - 1) * (dx - i) + (2 * n.y - 1) * (dy - j) + (2 * n.z - 1) * (dz - k);
    return 2 * n.w - 1 + 1.5 * slope;
  };
  const auto fade = [](double t) { return t * t * t * (t * (6 * t - 15) + 10); };
  const auto mix = [](double t, double a, double b) { return (1 - t) * a + t * b; };
  const auto along_x = [&](int j, int k) { return mix(fade(dx), corner(0, j, k), corner(1, j, k)); };
  const auto along_y = [&](int k) { return mix(fade(dy), along_x(0, k), along_x(1, k)); };
  return std::clamp(0.239 * mix(fade(dz), along_y(0), along_y(1)), -1.0, 1.0);
}

bool has_bits_of_definition(Point3d p) {
  const auto same = [](double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
  };
  // Of the instruction set of this machine, and of any.
  const Vector3d three = lattice_noises(p), portable = lattice::noises(p);
  for (int which = 0; which < 4; ++which) {
    const auto w = static_cast<std::uint64_t>(which);
    const double expected = by_corners(p, w);
    if (!same(lattice_noise(p, w), expected) || !same(lattice::noise(p, w), expected)) return false;
    if (which == 3) continue;
    if (!same(three[which], expected) || !same(portable[which], expected)) return false;
  }
  return true;
}

TEST(LatticeNoise, HasTheBitsOfItsDefinition) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> near(-50, 50), exponent(-1074, 54);
  const auto any = [&] {
    return std::copysign(std::exp2(exponent(random)), near(random));  // of any magnitude
  };
  for (int i = 0; i < 50'000; ++i) {
    const Point3d p{near(random), near(random), near(random)}, q{any(), any(), any()};
    ASSERT_TRUE(has_bits_of_definition(p)) << p.x << " " << p.y << " " << p.z;
    ASSERT_TRUE(has_bits_of_definition(q)) << q.x << " " << q.y << " " << q.z;
  }
}

TEST(LatticeNoise, HasTheBitsOfItsDefinitionAtExtremes) {
  using Limits = std::numeric_limits<double>;
  constexpr double least = Limits::denorm_min();
  const std::array special = {0.0,
                              -0.0,
                              least,
                              -least,
                              1.0,
                              -1.0,
                              -3.0,
                              1 - 0x1p-53,
                              -0x1p-60,
                              0x1p51 + 0.5,
                              0x1p52 - 0.5,
                              0.5 - 0x1p52,
                              0x1p52,
                              -0x1p52,
                              0x1p63,
                              1e300,
                              Limits::infinity(),
                              -Limits::infinity(),
                              Limits::quiet_NaN()};
  for (const double x : special)
    for (const double y : special)
      for (const double z : special)
        ASSERT_TRUE(has_bits_of_definition({x, y, z})) << x << " " << y << " " << z;
}

}  // namespace
}  // namespace vitrail::lattice_noise_test
