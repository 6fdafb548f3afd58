// SPDX-License-Identifier: Apache-2.0
// Values of layers are estimates: what follows holds in the mean over walks, whose number a law chooses.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "scene/geometry/pi.h"
#include "tests/laws/scattering/bsdf_laws.h"
#include "tracer/bsdf/layered.h"
#include "tracer/bsdf/local.h"

namespace vitrail::layered_laws_test {
namespace {

using laws::subject;

constexpr int long_walk = 1000;

Vector3d direction(double theta_deg, double phi_deg) {
  const double t = theta_deg * pi / 180, p = phi_deg * pi / 180;
  return {std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t)};
}

Microfacets rough(double alpha) { return make_microfacets(alpha, alpha); }

LayerVolume volume(double thickness, float albedo = 0, double g = 0, int depth = long_walk) {
  return {.thickness = thickness, .g = g, .albedo = filled(albedo), .max_depth = depth};
}

CoatedConductorBsdf copper(double coating, double metal, LayerVolume v) {
  return {.eta = filled(.6f),
          .k = filled(2.6f),
          .conductor = rough(metal),
          .interface = rough(coating),
          .volume = v};
}

// f·cosθ of a Lambertian base under a smooth interface: T(out)·T(in)·A(out)·A(in)·ρ/(π·η²·(1 − ρ·r)), A the
// transmittance of the coating along the refracted directions, r = 2·∫ F(μ)·A(μ)²·μ dμ inside.
double smoothly_coated(double rho, double eta, double thickness, Vector3d out, Vector3d in) {
  const auto through = [&](double outside) {
    const double inside = std::sqrt(1 - (1 - outside * outside) / (eta * eta));
    return (1 - fresnel_dielectric(outside, eta)) * std::exp(-thickness / inside);
  };
  double r = 0;
  constexpr int steps = 20000;
  for (int i = 0; i < steps; ++i) {
    const double mu = (i + .5) / steps;
    r += 2 * fresnel_dielectric(mu, 1 / eta) * std::exp(-2 * thickness / mu) * mu / steps;
  }
  return through(out.z) * through(in.z) * rho * in.z / (pi * eta * eta * (1 - rho * r));
}

TEST(Layered, SmoothCoatOverDiffuseIsItsClosedForm) {
  for (const double eta : {1.0, 1.3, 1.5, 2.0})
    for (const double thickness : {0.0, 0.01, 0.5})
      for (const auto& [out, in] : {std::pair{direction(0, 0), direction(30, 20)},
                                    std::pair{direction(60, 10), direction(75, 200)}}) {
        CoatedDiffuseBsdf b{.reflectance = {{.8f, .2f, 1, 0}}, .eta = eta, .volume = volume(thickness)};
        b.volume.samples = 20000;
        const SampledSpectrum found = eval(b, out, in).value;
        for (const int i : {0, 1, 2}) {
          const auto rho = static_cast<double>(b.reflectance[i]);
          const double expected = smoothly_coated(rho, eta, thickness, out, in);
          EXPECT_NEAR(static_cast<double>(found[i]), expected, .015 * expected)
              << "eta " << eta << ", thickness " << thickness << ", reflectance " << rho;
        }
      }
}

// What a walk gathers, in cells of directions: by sampling, and by values at random directions.
struct Cells {
  static constexpr int rings = 4, sectors = 6;
  std::array<double, rings * sectors> sum{}, squares{};
  int count = 0;
  void add(Vector3d in, double value) {
    const int ring = std::min(rings - 1, static_cast<int>(in.z * in.z * rings));
    const double turn = (std::atan2(in.y, in.x) + pi) / (2 * pi);
    const auto i =
        static_cast<std::size_t>(ring * sectors + std::min(sectors - 1, static_cast<int>(turn * sectors)));
    sum[i] += value;
    squares[i] += value * value;
  }
  double mean(std::size_t i) const { return sum[i] / count; }
  double variance(std::size_t i) const { return (squares[i] / count - mean(i) * mean(i)) / count; }
};

template <class Model>
void expect_samples_follow_values(const Model& model, const std::string& name) {
  for (const Vector3d out : {direction(10, 40), direction(50, 100), direction(80, 250)}) {
    SCOPED_TRACE(fmt::format("{}, cosθ = {:.3f}", name, out.z));
    std::mt19937 random(7);
    const auto u = [&] { return static_cast<float>(random() >> 8) * 0x1p-24f; };
    Cells sampled, valued;
    sampled.count = valued.count = 20000;
    for (int i = 0; i < sampled.count; ++i) {
      const float u_lobe = u(), ux = u(), uy = u();
      if (const auto s = sample(model, out, u_lobe, {ux, uy}); s && !s->specular)
        sampled.add(s->in, static_cast<double>(s->weight[0]));
      const float vx = u(), vy = u();
      const Vector3d in = sample_cosine_hemisphere(vx, vy);
      if (in.z > 0) valued.add(in, static_cast<double>(eval(model, out, in).value[0]) * pi / in.z);
    }
    for (std::size_t i = 0; i < sampled.sum.size(); ++i)
      EXPECT_NEAR(sampled.mean(i), valued.mean(i),
                  4.5 * std::sqrt(sampled.variance(i) + valued.variance(i)) + 1e-4)
          << "cell " << i;
  }
}

TEST(Layered, SamplesFollowValues) {
  const SampledSpectrum white = filled(.9f);
  expect_samples_follow_values(CoatedDiffuseBsdf{.reflectance = white, .volume = volume(.01)},
                               "smooth, diffuse");
  expect_samples_follow_values(
      CoatedDiffuseBsdf{.reflectance = white, .interface = rough(.4), .volume = volume(.2)},
      "rough, diffuse");
  expect_samples_follow_values(
      CoatedDiffuseBsdf{.reflectance = white, .interface = rough(.5), .volume = volume(.8, .9f, .6)},
      "rough, cloudy, diffuse");
  expect_samples_follow_values(
      CoatedDiffuseBsdf{.reflectance = filled(.5f), .eta = 1.8, .volume = volume(.8, .9f, -.5, 10)},
      "smooth, cloudy, diffuse");
  expect_samples_follow_values(copper(0, .4, volume(.01)), "smooth, rough metal");
  expect_samples_follow_values(copper(.4, 0, volume(.01)), "rough, smooth metal");
  expect_samples_follow_values(copper(.3, .4, volume(.1, .8f)), "rough, cloudy, rough metal");
}

template <class Model>
void expect_reciprocal(Model model, double tolerance, const std::string& name) {
  model.volume.samples = 60000;
  const Vector3d a = direction(20, 30), b = direction(65, 170);
  const double there = static_cast<double>(eval(model, a, b).value[0]) / b.z,
               back = static_cast<double>(eval(model, b, a).value[0]) / a.z;
  EXPECT_NEAR(there, back, tolerance * back) << name;
}

TEST(Layered, Reciprocal) {
  expect_reciprocal(CoatedDiffuseBsdf{.reflectance = filled(.8f), .volume = volume(.1)}, .01, "smooth");
  expect_reciprocal(
      CoatedDiffuseBsdf{.reflectance = filled(.8f), .interface = rough(.4), .volume = volume(.1, .7f)}, .02,
      "rough");
  expect_reciprocal(copper(.3, .4, volume(.3, .7f)), .02, "metal");
}

// pbrt-v4's weights of the ways out do not add up to 1.
TEST(Layered, UnbalancedIsBrighter) {
  CoatedDiffuseBsdf b{.reflectance = filled(.5f), .interface = rough(.1), .volume = volume(.01)};
  b.volume.samples = 100000;
  const Vector3d out = direction(60, 0), in = direction(70, 100);
  const auto balanced = static_cast<double>(eval(b, out, in).value[0]);
  b.volume.balanced = false;
  EXPECT_NEAR(static_cast<double>(eval(b, out, in).value[0]), 1.07 * balanced, .02 * balanced);
}

TEST(Layered, ConservesEnergyAndWhiteIsWhite) {
  for (const Vector3d out : laws::incidences()) {
    SCOPED_TRACE(out.z);
    const auto albedo = [&](const auto& model) { return laws::albedo(subject(model), out).mean; };
    EXPECT_NEAR(albedo(CoatedDiffuseBsdf{.reflectance = filled(1), .volume = volume(0)}), 1, .01);
    EXPECT_NEAR(albedo(CoatedDiffuseBsdf{.reflectance = filled(1), .volume = volume(1, 1)}), 1, .015);
    EXPECT_LE(
        albedo(CoatedDiffuseBsdf{.reflectance = filled(1), .interface = rough(.5), .volume = volume(0)}),
        1.01);
    EXPECT_LE(albedo(copper(.3, .3, volume(.5, 1))), 1.01);
  }
}

// Near 1 of what is not a delta.
TEST(Layered, PdfIsNearlyNormalised) {
  const auto expect_normalised = [](const auto& model, const std::string& name) {
    for (const Vector3d out : {direction(5, 40), direction(50, 100), direction(80, 250)}) {
      const auto a = laws::albedo(subject(model), out, 4000);
      std::mt19937 random(11);
      const auto u = [&] { return static_cast<float>(random() >> 8) * 0x1p-24f; };
      double sum = 0;
      constexpr int count = 40000;
      for (int i = 0; i < count; ++i) {
        const auto z = static_cast<double>(u());
        const double turn_deg = 360 * static_cast<double>(u());
        sum += pdf(model, out, direction(std::acos(z) * 180 / pi, turn_deg)) * 2 * pi / count;
      }
      EXPECT_NEAR(sum, 1 - a.specular, .12) << name << ", cosθ = " << out.z;
    }
  };
  expect_normalised(CoatedDiffuseBsdf{.reflectance = filled(.8f), .volume = volume(.01)}, "smooth, diffuse");
  expect_normalised(
      CoatedDiffuseBsdf{.reflectance = filled(.8f), .interface = rough(.4), .volume = volume(.01)},
      "rough, diffuse");
  expect_normalised(copper(0, .3, volume(.01)), "smooth, rough metal");
  expect_normalised(copper(.3, .3, volume(.01)), "rough, rough metal");
  expect_normalised(copper(.3, 0, volume(.01)), "rough, smooth metal");
}

TEST(Layered, FiniteAtExtremes) {
  for (const float albedo : {0.0f, 1.0f})
    for (const double alpha : {0.0, 1e-4, 1.0})
      for (const double thickness : {0.0, 100.0})
        for (const double eta : {0.5, 1.0, 1.0000001, 4.0}) {
          const std::string name =
              fmt::format("albedo {}, α {}, thickness {}, eta {}", albedo, alpha, thickness, eta);
          const LayerVolume v = volume(thickness, albedo, 1, 100);
          laws::expect_finite_at_extremes(
              subject(CoatedDiffuseBsdf{
                  .reflectance = filled(1), .eta = eta, .interface = rough(alpha), .volume = v}),
              name);
          CoatedConductorBsdf metal = copper(alpha, 1 - alpha, v);
          metal.interface_eta = eta;
          laws::expect_finite_at_extremes(subject(metal), name);
        }
}

// The same directions give the same walk.
TEST(Layered, ValuesAreFunctionsOfTheDirections) {
  const CoatedConductorBsdf b = copper(.3, .4, volume(.3, .7f));
  const Vector3d out = direction(20, 30), in = direction(65, 170);
  EXPECT_EQ(eval(b, out, in).value, eval(b, out, in).value);
  EXPECT_EQ(eval(b, out, in).pdf, pdf(b, out, in));
  const auto s = sample(b, out, .7f, {.3f, .6f});
  ASSERT_TRUE(s);
  EXPECT_EQ(s->pdf, pdf(b, out, s->in));
}

}  // namespace
}  // namespace vitrail::layered_laws_test
