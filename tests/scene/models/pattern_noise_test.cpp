// SPDX-License-Identifier: Apache-2.0
// Noise against numbers that povray 3.7 wrote; tests/importers/povray/povray_noise_test.cpp asks povray for
// more of them.
#include "scene/models/pattern_noise.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "scene/models/pattern.h"

namespace vitrail::pattern_noise_test {
namespace {

using Kind = PatternTexture::Kind;
using enum NoiseGenerator;

constexpr std::array<Point3d, 3> points{{{1.25, -3.5, 0.75}, {-7.1, 2.2, 5.9}, {103.4, -58.3, 17.6}}};
using Values = std::array<double, points.size()>;

void expect_values(const std::function<double(Point3d)>& value, const Values& expected) {
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_NEAR(value(points[i]), expected[i], 1e-11) << i;
}

TEST(PatternNoise, IsPovrays) {
  const auto by = [](NoiseGenerator generator) {
    return [=](Point3d p) { return pattern_noise(p, generator); };
  };
  expect_values(by(original), {0.696472037964, 0.449828421447, 0.581200480458});
  expect_values(by(corrected), {0.611777033348, 0.490957222332, 0.555310590024});
  const auto component = [](int axis) { return [=](Point3d p) { return vector_noise(p)[axis]; }; };
  expect_values(component(0), {0.196472037964, -0.050171578553, 0.081200480458});
  expect_values(component(1), {-0.205540789551, 0.410014951360, -0.131699997703});
  expect_values(component(2), {0.179681295776, 0.293954949703, 0.010258976945});
  expect_values(
      [](Point3d p) {
        return vector_turbulence(p, {4, double{2.2f}, double{0.4f}}).x;
      },
      {0.136369437904, 0.056479878780, 0.083900934780});
}

TEST(PatternNoise, SumsOfOctavesArePovrays) {
  const auto ridged = [](double generator) {
    return [=](Point3d p) {
      return ridged_multifractal(std::array{p.x, p.y, p.z, .5, 2.1, 5., .9, 1.7, generator}.data());
    };
  };
  expect_values(ridged(1), {0.378826624328, 0.727972895174, 0.545505593502});
  expect_values(ridged(2), {1.028886234330, 1.311483978888, 0.872864910286});
  const auto hetero = [](double t, double generator) {
    return [=](Point3d p) {
      return hetero_multifractal(std::array{p.x, p.y, p.z, .5, 2.1, 5., .9, t, generator}.data());
    };
  };
  expect_values(hetero(1, 1), {4.321616371722, 3.166427057643, 3.182267824896});
  expect_values(hetero(2.5, 2), {17.189967382107, 7.748350020076, 9.361771652232});
}

TEST(PatternNoise, PatternsArePovrays) {
  const auto expect = [](Kind kind, NoiseGenerator generator, float turbulence, const Values& expected) {
    PatternTexture t;
    t.kind = kind, t.noise = generator, t.arms = 3;
    t.turbulence.amount = Vector3d{1, 1, 1} * static_cast<double>(turbulence);
    SCOPED_TRACE(static_cast<int>(kind));
    const double tolerance = turbulence > 0 ? 1e-7 : 1e-11;  // of numbers of four bytes
    for (std::size_t i = 0; i < points.size(); ++i)
      EXPECT_NEAR(pattern_value(t, points[i]), expected[i], tolerance) << i;
  };
  expect(Kind::dents, corrected, 0, {0.228970486799, 0.118339835046, 0.171241044122});
  expect(Kind::granite, corrected, 0, {0.505483810520, 0.420111810840, 0.833152650938});
  expect(Kind::granite, original, 0, {0.534780325000, 0.370343621623, 0.831820571486});
  expect(Kind::wrinkles, corrected, 0, {0.630511929463, 0.648368203187, 0.551313356940});
  expect(Kind::wrinkles, original, 0, {0.601544217322, 0.619770267718, 0.526297486687});
  expect(Kind::agate, corrected, 0, {0.734399977879, 0.938001792700, 0.004043296829});
  expect(Kind::agate, original, 0, {0.892610026388, 0.806707391338, 0.038450236162});
  expect(Kind::ripples, corrected, 0, {0.565558347694, 0.546679004988, 0.387313114101});
  expect(Kind::waves, corrected, 0, {0.271049516955, 0.367692416950, 0.746142730216});
  expect(Kind::crackle, corrected, 0, {0.078521795536, 0.128059629438, 0.090302100750});
  expect(Kind::cells, corrected, 0, {0.258064699359, 0.916107534897, 0.657530541765});
}

TEST(PatternNoise, IsContinuousAndFinite) {
  for (int i = 0; i < 200; ++i) {
    const double y = i * 0.618034, z = i * 0.7548777;
    const auto at = [&](double x) { return pattern_noise({i - 100 + x, y, z}); };
    EXPECT_NEAR(at(-1e-7), at(1e-7), 1e-6);
    EXPECT_NEAR((at(0) - at(-1e-5)) / 1e-5, (at(1e-5) - at(0)) / 1e-5, 1e-3);
  }
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double x : {std::nan(""), infinity, -infinity, 0x1p52, -0x1p52, 1e300}) {
    EXPECT_EQ(pattern_noise({x, 0, 0}), 0) << x;
    EXPECT_EQ(vector_noise({0, 0, x}), (Vector3d{0, 0, 0})) << x;
  }
  EXPECT_EQ(pattern_noise({-0.0, -3, 1e-320}), pattern_noise({0, -3, 0}));
  EXPECT_NEAR(pattern_noise({0.25 + 4096, 0.5 - 8192, 0}), pattern_noise({0.25, 0.5, 0}), 1e-12);
}

}  // namespace
}  // namespace vitrail::pattern_noise_test
