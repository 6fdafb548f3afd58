// SPDX-License-Identifier: Apache-2.0
// Light under surfaces: the half space against Chandrasekhar's solution, and its inverse.
#include "scene/models/subsurface_media.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/models/measured_media.h"
#include "scene/spectra/rgb_to_spectrum.h"

namespace vitrail::subsurface_test {
namespace {

double albedo(const ExtinctionAlbedo& medium, double lambda_nm = 550) {
  return evaluate(std::get<Spectrum>(medium.albedo), lambda_nm);
}
Spectrum grey(double value) { return ConstantSpectrum{static_cast<float>(value)}; }

// Isotropic scattering without a boundary: 1 − 2√(1 − ω)·∫ H(μ)μ dμ ("Radiative Transfer", 1950, § 38).
double by_h_function(double albedo) {
  constexpr std::size_t count = 400;
  std::vector<double> h(count, 1.0);
  const auto mu = [](std::size_t i) { return (static_cast<double>(i) + 0.5) / count; };
  for (int step = 0; step < 200; ++step) {
    std::vector<double> next(count);
    for (std::size_t i = 0; i < count; ++i) {
      double sum = 0;
      for (std::size_t j = 0; j < count; ++j) sum += mu(j) * h[j] / (mu(i) + mu(j)) / count;
      next[i] = (h[i] + 1 / (std::sqrt(1 - albedo) + albedo / 2 * sum)) / 2;
    }
    h = next;
  }
  double moment = 0;
  for (std::size_t i = 0; i < count; ++i) moment += mu(i) * h[i] / count;
  return 1 - 2 * std::sqrt(1 - albedo) * moment;
}

TEST(DiffuseReflectance, IsChandrasekhars) {
  for (const double a : {0.1, 0.5, 0.9, 0.99})
    EXPECT_NEAR(diffuse_reflectance(a, 0, 1), by_h_function(a), 1e-5) << a;
}

// A boundary sends some of the light back inside, where some is lost; nothing is lost at albedo 1.
TEST(DiffuseReflectance, KnowsItsBoundaryAndItsLimits) {
  EXPECT_EQ(diffuse_reflectance(1, 0.3, 1.4), 1);
  EXPECT_NEAR(diffuse_reflectance(1 - 1e-9, 0.3, 1.4), 1, 1e-3);
  EXPECT_EQ(diffuse_reflectance(0, 0, 1.4), 0);
  double last = diffuse_reflectance(0.95, 0, 1);
  for (const double eta : {1.1, 1.3, 1.5, 2.0}) {
    const double r = diffuse_reflectance(0.95, 0, eta);
    EXPECT_LT(r, last) << eta;
    last = r;
  }
}

// Light that hardly turns scatters as if less often: of media alike by the similarity of van de Hulst,
// (1 − α)/(1 − αg), reflectances agree to some per cent.
TEST(DiffuseReflectance, KnowsSimilarMedia) {
  const double s2 = 0.05;
  const double even = diffuse_reflectance(1 - s2, 0, 1.33);
  for (const double g : {-0.5, 0.5, 0.8, 0.95})
    EXPECT_NEAR(diffuse_reflectance((1 - s2) / (1 - g * s2), g, 1.33), even, 0.025) << g;
}

TEST(EffectiveCoefficients, LeadToTheReflectance) {
  for (const double g : {0.0, 0.6})
    for (const double reflectance : {0.02, 0.3, 0.75, 0.97}) {
      const double a = albedo(effective_coefficients(grey(reflectance), grey(2), g, 1.4));
      EXPECT_NEAR(diffuse_reflectance(a, g, 1.4), reflectance, 5e-5) << g << ", " << reflectance;
    }
  const ExtinctionAlbedo white = effective_coefficients(grey(1), grey(2), 0, 1.4),
                         black = effective_coefficients(grey(0), grey(0), 0, 1.4);
  EXPECT_EQ(albedo(white), 1);
  EXPECT_EQ(albedo(black), 0);
  EXPECT_EQ(std::get<Spectrum>(white.sigma_t), grey(0.5));
  EXPECT_TRUE(std::isfinite(evaluate(std::get<Spectrum>(black.sigma_t), 550)));
}

TEST(EffectiveCoefficients, OfAColourAreOfEachWavelength) {
  const Spectrum skin = reflectance_from_rgb({0.8, 0.4, 0.2});
  const ExtinctionAlbedo medium = effective_coefficients(skin, grey(1), 0, 1.33);
  for (const double lambda : {450.0, 650.0})
    EXPECT_NEAR(diffuse_reflectance(albedo(medium, lambda), 0, 1.33), evaluate(skin, lambda), 5e-5);
}

TEST(MeasuredMedia, AreKnownByName) {
  EXPECT_EQ(measured_media().size(), 47u);
  for (const std::string& name : measured_media()) EXPECT_TRUE(measured_medium(name)) << name;
  EXPECT_FALSE(measured_medium("skin1"));
  EXPECT_EQ(measured_medium_eta("Marble"), 1.5);
  EXPECT_EQ(measured_medium_eta("Espresso"), 1.33);
}

TEST(Interiors, OfMeasuredMediaAreTheirs) {
  SubsurfaceMaterial m;
  m.interior = SubsurfaceMaterial::Named{"Marble"};
  m.g = 0.5f;
  const Medium marble = interior_of(m).value();
  EXPECT_EQ(marble.coefficients, (decltype(Medium::coefficients){measured_medium("Marble").value()}));
  EXPECT_EQ(marble.g, 0);
}

TEST(Interiors, OfMeanFreePathsAreScaled) {
  SubsurfaceMaterial m;
  m.interior = SubsurfaceMaterial::Effective{grey(0.5f), grey(1)};
  m.scale = 4;
  EXPECT_EQ(interior_of(m).value().scale, 0.25f);
}

TEST(Interiors, OfTexturesAndUnknownNamesAreNotKnown) {
  SubsurfaceMaterial m;
  m.interior = SubsurfaceMaterial::Named{"Nothing"};
  EXPECT_FALSE(interior_of(m));
  m.interior = SubsurfaceMaterial::Coefficients{Id<Texture>{0}, grey(1)};
  EXPECT_FALSE(interior_of(m));
}

}  // namespace
}  // namespace vitrail::subsurface_test
