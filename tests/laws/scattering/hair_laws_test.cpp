// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/hair.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <random>

#include "scene/geometry/portable_math.h"
#include "tests/laws/scattering/bsdf_laws.h"

namespace vitrail::hair_laws_test {
namespace {

using laws::subject;

const SampledSpectrum unequal{{1, 0.5f, 2, 0.1f}};

HairBsdf hair(const SampledSpectrum& sigma_a, double beta_m, double beta_n, double alpha = 2) {
  return make_hair(sigma_a, unequal, 1.55, beta_m, beta_n, alpha);
}

// At an angle θ to the plane across the fibre and an offset h across its width, seen from outside.
Vector3d at(double theta, double h) {
  const double c = std::cos(theta);
  return {std::sin(theta), -h * c, std::sqrt(1 - h * h) * c};
}

TEST(HairLaws, ItObeysThem) {
  const SampledSpectrum coloured{{0.1f, 0.5f, 2, 30}};
  for (const auto& [beta_m, beta_n] : {std::pair{0.1, 0.3}, {0.3, 0.1}, {0.3, 0.3}, {1.0, 1.0}}) {
    const auto s = subject(hair(beta_m == beta_n ? coloured : filled(0), beta_m, beta_n), true);
    SCOPED_TRACE(fmt::format("β_m = {}, β_n = {}", beta_m, beta_n));
    for (Vector3d out : {at(0, -0.6), at(-1.2, 0.97), at(0.5, 0) * -1.0})
      laws::expect_laws(s, out, {.reciprocal = false});
    laws::expect_finite_at_extremes(s, "hair");
  }
}

// What does not absorb sends all light on, from wherever it comes.
TEST(HairLaws, WhiteFurnace) {
  for (double beta_m : {0.05, 0.3, 1.0})
    for (double beta_n : {0.05, 0.3, 1.0})
      for (double theta : {0.0, 0.7, -1.5})
        for (double h : {0.0, 0.5, -0.97}) {
          const auto a = laws::albedo(subject(hair(filled(0), beta_m, beta_n), true), at(theta, h), 200);
          EXPECT_NEAR(a.mean, 1, 1e-5) << beta_m << " " << beta_n << " " << theta << " " << h;
          EXPECT_EQ(a.lost, 0);
        }
}

// ∫ g(in) over the sphere, around the fibre's axis.
double integrated(const std::function<double(Vector3d)>& g, int steps) {
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double theta = ((i + 0.5) / steps - 0.5) * pi, s = std::sin(theta), c = std::cos(theta);
    for (int j = 0; j < steps; ++j) {
      const double phi = (j + 0.5) * 2 * pi / steps;
      sum += c * g({s, c * std::cos(phi), c * std::sin(phi)});
    }
  }
  return sum * 2 * pi * pi / (steps * steps);
}

// The furnace by quadrature of what eval says: Σ A_p = 1, M and N are distributions.
TEST(HairLaws, ItIsNormalised) {
  for (double beta : {0.2, 0.5, 1.0})
    for (double theta : {0.0, 1.0, -1.5}) {
      const HairBsdf bsdf = hair(filled(0), beta, beta);
      const Vector3d out = at(theta, 0.3);
      const auto value = [&](Vector3d in) { return static_cast<double>(eval(bsdf, out, in).value[0]); };
      EXPECT_NEAR(integrated(value, 200), 1, 1e-3) << beta << " " << theta;
      EXPECT_NEAR(integrated([&](Vector3d in) { return pdf(bsdf, out, in); }, 200), 1, 1e-3);
    }
}

// Near the fibre's axis, where lobes are too thin for the cells of expect_laws: moments of what is sampled.
TEST(HairLaws, SamplesAlongTheFibreFollowTheirDensity) {
  constexpr int count = 40000;
  std::mt19937 random(5);
  const auto uniform = [&] { return static_cast<float>(random() >> 8) * 0x1p-24f; };
  const HairBsdf bsdf = hair(filled(0.3f), 0.1, 0.15);
  const Vector3d out = at(1.5, 0.8);
  const std::array<double (*)(Vector3d), 5> moments{
      [](Vector3d v) { return v.x; }, [](Vector3d v) { return v.y; }, [](Vector3d v) { return v.z; },
      [](Vector3d v) { return v.y * v.y; }, [](Vector3d v) { return v.y * v.z; }};
  std::vector<Vector3d> drawn;
  for (int i = 0; i < count; ++i) {
    const float u = uniform(), v = uniform(), w = uniform();
    if (const auto s = sample(bsdf, out, u, {v, w})) drawn.push_back(s->in);
  }
  ASSERT_EQ(drawn.size(), std::size_t{count});
  for (const auto moment : moments) {
    double mean = 0, square = 0;
    for (Vector3d v : drawn) mean += moment(v) / count, square += moment(v) * moment(v) / count;
    const double expected = integrated([&](Vector3d in) { return moment(in) * pdf(bsdf, out, in); }, 300);
    EXPECT_NEAR(mean, expected, 5 * std::sqrt((square - mean * mean) / count) + 1e-5);
  }
}

// Light that goes through unabsorbed and smooth leaves where the refracted ray does.
TEST(HairLaws, LobesAreWhereRaysGo) {
  for (double h : {-0.7, 0.2, 0.8}) {
    const Vector3d out = at(0, h);
    const double gamma = std::asin(h), refracted = std::asin(h / 1.55);
    const auto brightest = [&](const HairBsdf& bsdf, double from, double to) {
      double best = 0, best_phi = 0;
      for (double phi = from; phi < to; phi += 1e-3)
        if (const double v = eval(bsdf, out, {0, std::cos(phi), std::sin(phi)}).pdf; v > best)
          best = v, best_phi = phi;
      return best_phi;
    };
    // Reflected about the normal, which is at φ = π/2; of a black fibre nothing else.
    const HairBsdf black = hair(filled(1000), 0.3, 0.05, 0), clear = hair(filled(0), 0.3, 0.05, 0);
    EXPECT_NEAR(brightest(black, -pi, pi), pi / 2 - gamma, 2e-3) << h;
    // Through: turned by γ − γ_t at both faces.
    const double away = pi / 2 + gamma + pi + 2 * (refracted - gamma);
    EXPECT_NEAR(std::remainder(brightest(clear, -pi, pi) - away, 2 * pi), 0, 2e-3) << h;
  }
}

// Scales tilt what is reflected towards the root by 2α (Marschner et al. 2003).
TEST(HairLaws, ScalesTilt) {
  const HairBsdf tilted = hair(filled(1000), 0.05, 0.3, 5);
  double best = 0, best_theta = 0;
  for (double theta = -1.5; theta < 1.5; theta += 1e-3)
    if (const double v = eval(tilted, at(0.3, 0), at(theta, 0)).pdf; v > best) best = v, best_theta = theta;
  EXPECT_NEAR(best_theta, -0.3 + 2 * 5 * pi / 180, 2e-3);
}

// Of a surface seen from behind what is seen of its mirror image.
TEST(HairLaws, BothSidesAreAlike) {
  const HairBsdf bsdf = hair(filled(0.2f), 0.3, 0.2);
  for (Vector3d out : {at(0.3, 0.5), at(-1, -0.9)})
    for (Vector3d in : {at(0.2, 0.7), at(-0.9, 0.1) * -1.0}) {
      const auto mirrored = [](Vector3d v) { return Vector3d{v.x, v.y, -v.z}; };
      EXPECT_FLOAT_EQ(eval(bsdf, out, in).value[1], eval(bsdf, mirrored(out), mirrored(in)).value[1]);
    }
}

TEST(HairLaws, AbsorptionThatGivesAColourIsDarkerForDarkerColours) {
  const SampledSpectrum s = hair_absorption({{1, 0.5f, 0.1f, 0}}, 0.3);
  EXPECT_EQ(s[0], 0);
  EXPECT_LT(s[1], s[2]);
  EXPECT_LT(s[2], s[3]);
  EXPECT_TRUE(std::isfinite(s[3]));
  EXPECT_NEAR(static_cast<double>(s[1]), std::pow(std::log(0.5) / 5.886, 2), 2e-3);
}

TEST(HairLaws, BesselFunction) {
  for (double x = 0; x < 700; x = x * 1.1 + 0.01)
    EXPECT_NEAR(scaled_bessel_i0(x) / (std::cyl_bessel_i(0.0, x) * std::exp(-x)), 1, 6e-7) << x;
}

}  // namespace
}  // namespace vitrail::hair_laws_test
