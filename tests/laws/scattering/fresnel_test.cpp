// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/fresnel.h"

#include <gtest/gtest.h>

#include <complex>
#include <numbers>

#include "scene/spectra/named_spectra.h"
#include "tracer/bsdf/local.h"

namespace vitrail::fresnel_test {
namespace {

// Fresnel's equations with complex numbers, as in Born & Wolf §14.2.
double by_complex_numbers(double cosine, std::complex<double> n) {
  const std::complex<double> refracted = std::sqrt(n * n - (1 - cosine * cosine));
  const auto s = (cosine - refracted) / (cosine + refracted);
  const auto p = (n * n * cosine - refracted) / (n * n * cosine + refracted);
  return (std::norm(s) + std::norm(p)) / 2;
}

constexpr double cosines[] = {1, 0.99, 0.7, 0.5, 0.2, 0.01, 1e-4};

TEST(Fresnel, GlassAtNormalIncidence) {
  EXPECT_NEAR(fresnel_dielectric(1, 1.5), 0.04, 1e-15);
  EXPECT_NEAR(fresnel_dielectric(1, 1 / 1.5), 0.04, 1e-15);
  EXPECT_NEAR(fresnel_conductor(1, 1.5, 0), 0.04, 1e-15);
}

TEST(Fresnel, NothingOfThePolarisedPartAtBrewstersAngle) {
  for (double n : {1.5, 1 / 1.5, 1.33, 4.0, 1.0000001}) {
    const double cosine = 1 / std::sqrt(1 + n * n);  // tan θ = n
    const double s = (n * n - 1) / (n * n + 1);      // the other part's amplitude there
    EXPECT_NEAR(fresnel_dielectric(cosine, n), s * s / 2, 1e-15);
    EXPECT_NEAR(fresnel_conductor(cosine, n, 0), s * s / 2, 1e-14);
  }
}

TEST(Fresnel, EverythingAtGrazingIncidence) {
  for (double n : {1.5, 1 / 1.5, 4.0, 1.01}) {
    EXPECT_EQ(fresnel_dielectric(0, n), 1);
    EXPECT_GT(fresnel_dielectric(1e-9, n), 1 - 1e-6);
    for (double k : {0.0, 1.0, 100.0}) EXPECT_GT(fresnel_conductor(1e-9, n, k), 1 - 1e-6);
  }
}

TEST(Fresnel, TotalInternalReflection) {
  const double critical = std::sqrt(1 - 1 / 2.25);
  EXPECT_EQ(fresnel_dielectric(critical - 1e-9, 1 / 1.5), 1);
  EXPECT_LT(fresnel_dielectric(critical + 1e-3, 1 / 1.5), 0.9);
}

TEST(Fresnel, DielectricIsConductorWithoutAbsorption) {
  for (double n : {1.0000001, 1.33, 1.5, 4.0, 100.0})
    for (double cosine : cosines)
      EXPECT_NEAR(fresnel_conductor(cosine, n, 0), fresnel_dielectric(cosine, n), 1e-8) << n << " " << cosine;
}

TEST(Fresnel, ConductorsByComplexNumbers) {
  for (double n : {0.05, 0.2, 1.0, 1.5, 4.0})
    for (double k : {1e-6, 0.1, 2.0, 3.9, 30.0, 100.0})
      for (double cosine : cosines)
        EXPECT_NEAR(fresnel_conductor(cosine, n, k), by_complex_numbers(cosine, {n, k}), 1e-8)
            << n << " + " << k << "i, " << cosine;
}

TEST(Fresnel, CopperAndGold) {
  for (const char* metal : {"Cu", "Au"}) {
    const auto table = [&](const char* part) {
      return resolved(NamedSpectrum{std::string("metal-") + metal + "-" + part});
    };
    for (double nm : {420.0, 500.0, 580.0, 650.0}) {
      const double eta = evaluate(table("eta"), nm), k = evaluate(table("k"), nm);
      // At normal incidence ((n − 1)² + k²)/((n + 1)² + k²).
      const double normal = ((eta - 1) * (eta - 1) + k * k) / ((eta + 1) * (eta + 1) + k * k);
      EXPECT_NEAR(fresnel_conductor(1, eta, k), normal, 1e-12) << metal << " " << nm;
      EXPECT_NEAR(fresnel_conductor(0.3, eta, k), by_complex_numbers(0.3, {eta, k}), 1e-12);
      EXPECT_GT(normal, nm > 600 ? 0.9 : 0.3) << "both metals are red";
      EXPECT_LT(normal, nm < 500 ? 0.6 : 1) << "both metals are red";
    }
  }
}

TEST(Fresnel, ConductorInFrontOfGlass) {
  const SampledSpectrum eta = filled(0.3f), k = filled(3);
  EXPECT_NEAR(fresnel_conductor(0.6, eta, k, 1.5f)[2], fresnel_conductor(0.6, 0.2, 2), 1e-6);
}

TEST(Fresnel, DiffuseReflectance) {
  EXPECT_EQ(fresnel_diffuse(1), 0);
  for (double n : {1.0000001, 1.33, 1.5, 2.4, 4.0}) {
    double sum = 0;
    constexpr int steps = 200000;
    for (int i = 0; i < steps; ++i) sum += fresnel_dielectric((i + 0.5) / steps, n) * 2 * (i + 0.5) / steps;
    EXPECT_NEAR(fresnel_diffuse(n), sum / steps, 1e-6) << n;
    // Stokes: as much light goes in as comes out, for each of n² as many directions inside.
    EXPECT_NEAR(1 - fresnel_diffuse(n), n * n * (1 - fresnel_diffuse(1 / n)), 2e-6) << n;
  }
}

}  // namespace
}  // namespace vitrail::fresnel_test
