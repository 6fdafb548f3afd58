// SPDX-License-Identifier: Apache-2.0
// Fresnel and Snell at the ends of their ranges, against MPFR; and as rendered.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <boost/multiprecision/mpfr.hpp>
#include <cmath>

#include "scene/geometry/portable_math.h"
#include "tests/extremes/measure.h"
#include "tracer/bsdf/fresnel.h"
#include "tracer/bsdf/local.h"

namespace vitrail::test::interfaces_test {
namespace {

using Precise = boost::multiprecision::mpfr_float_100;

constexpr float slightly_more = 1 + 1e-7f;  // 1 + 2⁻²³, the float next to 1

Precise squared(const Precise& x) { return x * x; }

// R(θ) by its textbook form, with 100 digits.
Precise reflectance(double cosine, double eta) {
  const Precise c = cosine, e = eta, sine2 = (1 - c * c) / (e * e);
  if (sine2 >= 1) return 1;
  const Precise t = sqrt(1 - sine2);
  return (squared((c - e * t) / (c + e * t)) + squared((e * c - t) / (e * c + t))) / 2;
}

double radians(double degrees) { return degrees * pi / 180; }

TEST(Fresnel, OfAnyIndexAtAnyAngle) {
  for (const double eta : {double{slightly_more}, 1 / double{slightly_more}, 1.5, 1 / 1.5, 1e4, 1e-4}) {
    double worst = 0;
    for (const double degrees : {0.0, 1e-4, 0.1, 30.0, 41.8, 45.0, 60.0, 80.0, 89.0, 89.9, 89.99, 89.9999}) {
      const double cosine = std::cos(radians(degrees));
      const Precise expected = reflectance(cosine, eta);
      const double error = static_cast<double>(abs(fresnel_dielectric(cosine, eta) / expected - 1));
      worst = std::max(worst, error);
    }
    expect_absolute(fmt::format("reflectance at an index of {:.8g}, 0 to 89.9999°, relative", eta), 0, worst,
                    1e-8);
  }
}

TEST(Fresnel, OfMetalsAtGrazingIncidence) {
  double worst = 0;
  for (const auto& [eta, k] :
       {std::array{0.05, 4.0}, std::array{1.0, 1e-7}, std::array{1e-3, 1e3}, std::array{1e4, 1e4}})
    for (const double degrees : {0.0, 30.0, 60.0, 89.0, 89.9999}) {
      const Precise c = std::cos(radians(degrees)), n = eta, kk = k, s2 = 1 - c * c;
      const Precise real = n * n - kk * kk - s2, imaginary = 2 * n * kk;
      const Precise modulus = sqrt(real * real + imaginary * imaginary), a = sqrt((modulus + real) / 2);
      const Precise s = (modulus + c * c - 2 * a * c) / (modulus + c * c + 2 * a * c);
      const Precise p =
          s * (modulus * c * c + s2 * s2 - 2 * a * c * s2) / (modulus * c * c + s2 * s2 + 2 * a * c * s2);
      const Precise expected = (s + p) / 2;
      const double error = fresnel_conductor(static_cast<double>(c), eta, k) - static_cast<double>(expected);
      worst = std::max(worst, std::abs(error));
    }
  expect_absolute("reflectance of metals, 0 to 89.9999°, absolute", 0, worst, 1e-7);
}

TEST(Snell, OfAnyIndexAtAnyAngle) {
  for (const double eta : {double{slightly_more}, 1.5, 1 / 1.5, 1e4}) {
    double worst = 0;
    for (const double degrees : {0.0, 1e-4, 30.0, 41.8, 60.0, 89.0, 89.9999}) {
      const Vector3d out{std::sin(radians(degrees)), 0, std::cos(radians(degrees))};
      const Precise sine = Precise(out.x) / eta;
      Vector3d refracted;
      if (sine >= 1) {
        EXPECT_FALSE(refract(out, {0, 0, 1}, eta, refracted));
        continue;
      }
      ASSERT_TRUE(refract(out, {0, 0, 1}, eta, refracted)) << eta << " at " << degrees;
      const Precise angle = atan2(Precise(-refracted.x), Precise(-refracted.z)) - asin(sine);
      worst = std::max(worst, static_cast<double>(abs(angle)));
    }
    expect_absolute(fmt::format("angle of refraction into an index of {:.8g}, rad", eta), 0, worst, 1e-8);
  }
}

// A smooth face above black: of a sky of 1 it shows what it reflects.
Scene face_over_black(double degrees, float eta, double half_width) {
  Scene scene;
  add_shape(scene, add_quads(scene, {square_at(0, 10)}), Material{DielectricMaterial{ConstantSpectrum{eta}}});
  add_shape(scene, add_quads(scene, {square_at(-1, 1e4f)}), matte(0));
  // So that the centre of the scene is the origin, where floats are finest.
  add_shape(scene, add_quads(scene, {{{{9e3f, 9e3f, 1}, {1e4f, 9e3f, 1}, {1e4f, 1e4f, 1}, {9e3f, 1e4f, 1}}}}),
            matte(0));
  add_sky(scene, 1);
  const double tilt = radians(degrees);
  set_orthographic(scene, Point3d{5 * std::sin(tilt), 0, 5 * std::cos(tilt)}, {0, 0, 0}, {0, 1, 0},
                   half_width, 64);
  scene.settings.max_depth = 3;
  return scene;
}

// Directions have a resolution of 1.2·10⁻⁷ rad: of the cosine at 89.9999°, a fifteenth.
TEST(Grazing, AFaceReflects) {
  for (const double degrees : {60.0, 85.0, 89.0, 89.9, 89.99, 89.999, 89.9999}) {
    const auto expected = static_cast<double>(reflectance(std::cos(radians(degrees)), 1.5));
    const Measured b = measure(face_over_black(degrees, 1.5f, 1e-7), 64);
    const double slope = 6.7;  // −dR/dcosθ at grazing incidence, n = 1.5
    expect_absolute(fmt::format("reflection of glass at {:g}°", degrees), expected, b.mean,
                    slope * 1.2e-7 + 1e-6, std::sqrt(expected * (1 - expected) / (64.0 * 64 * 64)));
  }
}

TEST(Grazing, SunOnMatteGround) {
  for (const double degrees : {89.0, 89.9, 89.99, 89.999, 89.9999}) {
    Scene scene;
    add_shape(scene, add_quads(scene, {square_at(0, 10)}), matte(0.5f));
    const double tilt = radians(degrees);
    add_sun(scene, {std::sin(tilt), 0, -std::cos(tilt)}, 1e6);
    set_camera(scene, {0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 0.02, 16, 16);
    const double expected = 0.5 / pi * 1e6 * std::cos(tilt);
    expect_relative(fmt::format("sun at {:g}° on the ground", degrees), expected, measure(scene, 16).mean,
                    2e-5);
  }
}

// Matte ground looks alike from everywhere.
TEST(Grazing, MatteGroundSeenEdgeOn) {
  for (const double degrees : {89.0, 89.99, 89.9999}) {
    Scene scene;
    add_shape(scene, add_quads(scene, {square_at(0, 10)}), matte(0.5f));
    add_sun(scene, normalize(Vector3d{0.3, 0.1, -1}), 1);
    const double tilt = radians(degrees);
    set_orthographic(scene, Point3d{5 * std::sin(tilt), 0, 5 * std::cos(tilt)}, {0, 0, 0}, {0, 1, 0}, 1e-7,
                     16);
    scene.settings.max_depth = 1;
    const double expected = 0.5 / pi / std::sqrt(1.1);
    expect_relative(fmt::format("matte ground seen at {:g}°", degrees), expected, measure(scene, 16).mean,
                    2e-5);
  }
}

TEST(Index, AFaceOfTenThousandReflectsAlmostAll) {
  const auto expected = static_cast<double>(reflectance(1, 1e4));
  const Measured b = measure(face_over_black(0, 1e4f, 0.01), 64);
  expect_absolute("reflection of a face of index 10⁴", expected, b.mean, 1e-5, b.standard_error);
}

// White objects cannot be seen under a white sky. Of an index of 10⁴ light that got in leaves after 2500
// reflections on the average.
TEST(Index, ObjectsVanishUnderAUniformSky) {
  struct Case {
    const char* what;
    float eta, alpha;
    double limit;
  };
  for (const Case& c : {Case{"smooth, index 1 + 10⁻⁷", slightly_more, 0, 1e-5},
                        Case{"rough .1, index 1 + 10⁻⁷", slightly_more, 0.1f, 1e-5},
                        Case{"smooth, index 1", 1, 0, 1e-5}, Case{"smooth, index 10⁴", 1e4f, 0, 1e-3}}) {
    Scene scene;
    DielectricMaterial glass{ConstantSpectrum{c.eta}};
    glass.roughness.alpha_u = glass.roughness.alpha_v = c.alpha;
    add_shape(scene, add_quads(scene, box_faces({-0.5f, -0.5f, -0.5f}, {0.5f, 0.5f, 0.5f})), Material{glass});
    add_sky(scene, 1);
    set_camera(scene, {1.3, 1.7, -2}, {0, 0, 0}, {0, 1, 0}, 0.5, 16, 16);
    scene.settings.max_depth = 100;
    const Measured b = measure(scene, 256);
    expect_relative(fmt::format("a box under a sky of 1: {}", c.what), 1, b.mean, c.limit, b.standard_error);
  }
}

}  // namespace
}  // namespace vitrail::test::interfaces_test
