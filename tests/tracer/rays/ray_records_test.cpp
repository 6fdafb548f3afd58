// SPDX-License-Identifier: Apache-2.0
#include "tracer/rays/ray_records.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "scene/geometry/portable_math.h"
#include "scene/spectra/rgb_to_spectrum.h"
#include "tracer/bsdf/local.h"
#include "tracer/rays/connection_code.h"
#include "tracer/sampling/wavelengths.h"
#include "tracer/transport/scatterer.h"

namespace vitrail::ray_records_test {
namespace {

TEST(Direction, SurvivesItsCode) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  double worst = 0;
  for (int i = 0; i < 100000; ++i) {
    const Vector3d d = normalize(Vector3d{normal(random), normal(random), normal(random)});
    const Vector3f back = decode_direction(encode_direction(d));
    worst = std::max(worst, length(cast<double>(back) - d));
    EXPECT_NEAR(length(cast<double>(back)), 1, 2e-7);
  }
  EXPECT_LT(worst, 3e-7);
}

TEST(Direction, AxesAreExact) {
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0}) {
      Vector3d d;
      d[axis] = sign;
      EXPECT_EQ(decode_direction(encode_direction(d)), cast<float>(d));
    }
}

TEST(Face, IsParallelToItselfOnly) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 20000; ++i) {
    const Vector3d n = normalize(Vector3d{normal(random), normal(random), normal(random)});
    const FaceCode code = encode_face(n);
    EXPECT_LT(code.bits, 1u << 20);
    EXPECT_TRUE(is_parallel(code, n));
    EXPECT_TRUE(is_parallel(code, -n));
    const Vector3d turned = normalize(n + Frame(n).tangent * 0.01);
    EXPECT_FALSE(is_parallel(code, turned));
  }
}

TEST(Records, PdfAndRadianceRoundWithoutBias) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> exponent(-20, 20);
  double radiance_sum = 0, pdf_sum = 0;
  constexpr int n = 100000;
  for (int i = 0; i < n; ++i) {
    const float value = std::exp2(exponent(random));
    std::uint8_t packed[3];
    pack_radiance(value, packed);
    const double radiance = unpack_radiance(packed) / static_cast<double>(value) - 1;
    const double pdf = pdf_value(pdf_code(value)) / static_cast<double>(value) - 1;
    EXPECT_LE(std::abs(radiance), 0x1p-17);
    EXPECT_LE(std::abs(pdf), 0x1p-8);
    radiance_sum += radiance / n;
    pdf_sum += pdf / n;
  }
  EXPECT_LT(std::abs(radiance_sum), 1e-7);
  EXPECT_LT(std::abs(pdf_sum), 1e-4);
  std::uint8_t zero[3];
  pack_radiance(0, zero);
  EXPECT_EQ(unpack_radiance(zero), 0);
  EXPECT_EQ(pdf_value(pdf_code(0)), 0);
}

TEST(Connections, RoundTheirDoubtsUpAndTheirEndsDown) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> exponent(-40, 20);
  for (int i = 0; i < 20000; ++i) {
    const double x = std::exp2(exponent(random));
    FaceDoubt doubt;
    doubt.cross(x), doubt.cross(x / 3);
    EXPECT_GE(doubt.allowed_rad(), 2 * std::min(x, 0x1p-4));
    EXPECT_LE(doubt.allowed_rad(), 2 * std::max(2 * x, 0x1p-18));
    EXPECT_LT(doubt.code, 16u);
    const RefractedAim refracted = RefractedAim::of(RefractedAim{0xabcd, doubt}.bits());
    EXPECT_EQ(refracted.light, 0xbcdu);
    EXPECT_EQ(refracted.doubt.code, doubt.code);
    const StraightAim straight = StraightAim::of(StraightAim{x}.bits());
    EXPECT_GE(straight.slope, std::min(x, 0x1p11));
    EXPECT_LE(straight.slope, std::max(2 * x, 0x1p-3));
    EXPECT_LT(end_code(x), std::uint64_t{1} << end_code_length);
    EXPECT_LE(end_value(end_code(x)), x);
    EXPECT_GE(end_value(end_code(x)), x * (1 - 0x1p-28));
    EXPECT_EQ(end_code(end_value(end_code(x))), end_code(x));
  }
  EXPECT_EQ(FaceDoubt{}.allowed_rad(), 0);
  EXPECT_EQ(StraightAim::of(StraightAim{0x1p3}.bits()).slope, 0x1p3);
  for (const double none : {0.0, -1.0, 1e-60, std::nan("")}) EXPECT_EQ(end_value(end_code(none)), 0);
  EXPECT_NEAR(end_value(end_code(1e30)) / 1e30, 1, 0x1p-28);
  const double endless = std::numeric_limits<double>::infinity();
  EXPECT_EQ(end_value(end_code(endless)), endless);
  EXPECT_LT(end_value(end_code(0x1.ffffp127)), endless);
}

// Over the numbers that decide it, the mean is the value, and steps of less than the resolution add up.
TEST(Records, RoundingByChanceHasTheValueAsItsMean) {
  for (const float value : {1.0f, 0.3f, 1.9999f, 1 - 0x1p-20f, 3e-20f, 7e20f}) {
    double throughput = 0, distance = 0;
    for (std::uint32_t random = 0; random < 0x10000; ++random) {
      throughput += static_cast<double>(rounded_by_chance(value, random)) / 0x10000;
      distance += static_cast<double>(rounded_distance(value, random)) / 0x10000;
    }
    const auto exact = static_cast<double>(value);
    EXPECT_NEAR(throughput, exact, 1e-12 * exact);
    EXPECT_NEAR(distance, exact, 1e-12 * exact);
    const float rounded = rounded_distance(value, 0x1234);
    EXPECT_EQ(distance_value(distance_code(rounded)), rounded);
  }
}

TEST(Records, PolarisationSurvivesItsCode) {
  for (int code = -Polarization::steps; code <= Polarization::steps; ++code) {
    const PaneState pane{
        code % 2 == 0, code % 3 == 0, code % 5 == 0, {0xabcde}, {static_cast<std::int8_t>(code)}};
    const PaneState back = PaneState::of(pane.record());
    EXPECT_EQ(back.polarization.code, code);
    EXPECT_EQ(back.within, pane.within);
    EXPECT_EQ(back.parts, pane.parts);
    EXPECT_EQ(back.owes, pane.owes);
    EXPECT_EQ(back.face.bits, 0xabcdeu);
    EXPECT_EQ(back.is_known(), pane.within || code != 0);
  }
}

// Rounded by chance its mean is what it was; where the plane of incidence turns, it turns twice as far.
TEST(Polarization, RoundsAndTurns) {
  for (const double q : {-1.0, -0.777, 0.0, 0.01, 0.5, 1.0}) {
    double mean = 0;
    for (int i = 0; i < 1000; ++i)
      mean += Polarization::rounded(q, (static_cast<float>(i) + 0.5f) / 1000).value() / 1000;
    EXPECT_NEAR(mean, q, 1e-4);
  }
  const Vector3d d{0, 0, -1};
  const Polarization s{Polarization::steps};
  for (const double turned : {0.0, 0.3, pi / 4, pi / 2}) {
    const Vector3d before{0.6, 0, 0.8}, n{0.8 * std::cos(turned), 0.8 * std::sin(turned), -0.6};
    EXPECT_NEAR(seen_by_face(s, before, d, n), std::cos(2 * turned), 1e-12);
  }
  EXPECT_EQ(seen_by_face(s, {0, 0, 1}, d, {0.6, 0, 0.8}), 0);
}

TEST(Records, ThroughputSurvivesItsCode) {
  for (std::uint32_t random = 0; random < 0x400; ++random) {
    SampledSpectrum s{{1, 0.3f + static_cast<float>(random), 0, 3e-20f}};
    if (random % 2) s = {{3e38f, 1e-38f, 0.999999f, 7e-3f}};
    for (float& x : s.v) x = rounded_by_chance(x, random);
    std::uint8_t packed[11];
    pack_throughput(s, packed);
    EXPECT_EQ(unpack_throughput(packed), s);
  }
}

// Of the 2²⁴ numbers u, just as many lie below the probability as it says.
TEST(Attainable, IsTheShareOfNumbersBelow) {
  for (const double p : {1e-300, 1e-15, 3e-8, 1.7e-7, 1e-3, 0.3, 0.9999999, 1 - 1e-12}) {
    const double attained = attainable(p);
    std::uint32_t below = 0;
    for (std::uint32_t k = 0; k < 1u << 24; ++k) below += static_cast<double>(k) * 0x1p-24 < attained;
    EXPECT_EQ(below, attained * 0x1p24);
    EXPECT_GT(below, 0u);
    EXPECT_LT(below, 1u << 24);
    EXPECT_NEAR(attained, p, 0x1p-24);
  }
  EXPECT_EQ(attainable(0), 0);
  EXPECT_EQ(attainable(1), 1);
  EXPECT_EQ(attainable(1e30), 1);
}

// Of colours as smooth as those that RGB becomes.
TEST(Wavelengths, FixedOnesGiveTheLuminance) {
  for (const RGB c : {RGB{0.8, 0.2, 0.1}, RGB{0.1, 0.7, 0.2}, RGB{0.1, 0.2, 0.9}, RGB{0.9, 0.8, 0.05}}) {
    const Spectrum color{reflectance_from_rgb(c)};
    double sum = 0;
    for (const SampledWavelengths& w : luminance_wavelengths())
      for (const float x : evaluate(color, w).v) sum += static_cast<double>(x) / 16;
    EXPECT_NEAR(sum, luminance(color), 0.02 * luminance(color));
  }
}

TEST(PortableMath, AgreesWithTheLibrary) {
  for (double x = -pi / 4; x <= pi / 4; x += 1e-3) {
    EXPECT_NEAR(sin_small(x), std::sin(x), 2e-16);
    EXPECT_NEAR(cos_small(x), std::cos(x), 2e-16);
  }
  for (double x = -600; x <= 600; x += 0.37) EXPECT_NEAR(portable_exp(x) / std::exp(x), 1, 2e-14) << x;
}

TEST(Fresnel, KnownValues) {
  EXPECT_NEAR(fresnel_dielectric(1, 1.5), 0.04, 1e-15);
  EXPECT_NEAR(fresnel_dielectric(1, 1 / 1.5), 0.04, 1e-15);
  EXPECT_EQ(fresnel_dielectric(0.1, 1 / 1.5), 1);
  EXPECT_EQ(fresnel_dielectric(0, 1.5), 1);
  EXPECT_EQ(fresnel_dielectric(0, 1), 0);
  // At Brewster's angle only s is reflected: ((n² − 1)/(n² + 1))² / 2.
  EXPECT_NEAR(fresnel_dielectric(std::cos(std::atan(1.5)), 1.5), std::pow((2.25 - 1) / (2.25 + 1), 2) / 2,
              1e-14);
}

TEST(Refract, FollowsSnell) {
  for (const double eta : {1.0000001, 1.5, 4.0, 1 / 1.5})
    for (double angle = 0; angle < 1.57; angle += 0.01) {
      Vector3d refracted;
      if (!refract({std::sin(angle), 0, std::cos(angle)}, {0, 0, 1}, eta, refracted)) {
        EXPECT_GE(std::sin(angle), eta * (1 - 1e-12));
        continue;
      }
      EXPECT_NEAR(length(refracted), 1, 1e-14);
      EXPECT_NEAR(-refracted.x * eta, std::sin(angle), 1e-13);
      EXPECT_LE(refracted.z, 0);
    }
}

TEST(Wavelengths, IntegrateToTheSensorsNormalisation) {
  // The mean over u of the weights is the integral of the observer over ∫ȳ; for a constant spectrum Y is 1.
  XYZ mean;
  constexpr int n = 10000;
  for (int i = 0; i < n; ++i) {
    const SampledWavelengths w = sample_wavelengths((static_cast<float>(i) + 0.5f) / n);
    for (std::size_t k = 0; k < hero_count; ++k) {
      EXPECT_GE(w.lambda_nm[k], lambda_min_nm);
      EXPECT_LE(w.lambda_nm[k], lambda_max_nm);
      EXPECT_GT(w.pdf[k], 0);
    }
    const XYZ sensed = sense(sensor_weights(w), filled(1));
    mean.x += sensed.x / n;
    mean.y += sensed.y / n;
    mean.z += sensed.z / n;
  }
  const XYZ expected = to_xyz(ConstantSpectrum{1});
  EXPECT_NEAR(mean.x, expected.x, 2e-4);
  EXPECT_NEAR(mean.y, 1, 2e-4);
  EXPECT_NEAR(mean.z, expected.z, 2e-4);
}

TEST(Hemisphere, IsCosineWeighted) {
  // Moments of cosθ under pdf cosθ/π: E[cos] = 2/3, E[cos²] = 1/2.
  double first = 0, second = 0, x = 0;
  constexpr int n = 512;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Vector3d d =
          sample_cosine_hemisphere((static_cast<float>(i) + 0.5f) / n, (static_cast<float>(j) + 0.5f) / n);
      EXPECT_NEAR(length(d), 1, 1e-12);
      first += d.z / (n * n);
      second += d.z * d.z / (n * n);
      x += d.x / (n * n);
    }
  EXPECT_NEAR(first, 2.0 / 3, 1e-4);
  EXPECT_NEAR(second, 0.5, 1e-4);
  EXPECT_NEAR(x, 0, 1e-12);
}

}  // namespace
}  // namespace vitrail::ray_records_test
