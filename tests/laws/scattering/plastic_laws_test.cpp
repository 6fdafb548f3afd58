// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/plastic.h"

#include <gtest/gtest.h>

#include "tests/laws/scattering/bsdf_laws.h"
#include "tests/laws/scattering/rough_cases.h"
#include "tracer/bsdf/fresnel.h"
#include "tracer/bsdf/local.h"

namespace vitrail::plastic_laws_test {
namespace {

using laws::albedo;
using laws::subject;

PlasticBsdf plastic(const SampledSpectrum& diffuse, double eta, bool nonlinear) {
  return {.diffuse_reflectance = diffuse,
          .eta = eta,
          .internal_reflectance = fresnel_diffuse(1 / eta),
          .nonlinear = nonlinear};
}

TEST(PlasticLaws, SmoothPlasticObeysThem) {
  for (double eta : {1.49, 4.0, 1.0000001, 1 / 1.5})
    for (bool nonlinear : {false, true})
      for (float rho : {0.0f, 0.5f, 1.0f}) {
        const auto s = subject(plastic({{rho, rho / 2, 0, rho}}, eta, nonlinear));
        laws::expect_laws(s, fmt::format("η = {}, ρ = {}", eta, rho));
        laws::expect_finite_at_extremes(s, "plastic");
      }
}

// A white base under a smooth coat returns everything: what the coat keeps inside comes out in the end.
TEST(PlasticLaws, WhiteFurnace) {
  for (double eta : {1.49, 2.4, 4.0})
    for (bool nonlinear : {false, true})
      for (Vector3d out : laws::incidences()) {
        const auto a = albedo(subject(plastic(filled(1), eta, nonlinear)), out, 40000);
        EXPECT_NEAR(a.mean, 1, 3e-4 + 4 * a.standard_error) << eta << " " << out.z;
      }
}

TEST(PlasticLaws, ABlackBaseLeavesTheCoat) {
  for (Vector3d out : laws::incidences())
    EXPECT_NEAR(albedo(subject(plastic(filled(0), 1.5, false)), out).mean, fresnel_dielectric(out.z, 1.5),
                1e-6);
}

TEST(PlasticLaws, NonlinearDarkensColours) {
  const Vector3d up{0, 0, 1}, in = normalize(Vector3d{0.3, 0.4, 1});
  const float linear = eval(plastic(filled(0.5f), 1.49, false), up, in).value[0];
  const float nonlinear = eval(plastic(filled(0.5f), 1.49, true), up, in).value[0];
  const double r = fresnel_diffuse(1 / 1.49);
  EXPECT_NEAR(static_cast<double>(nonlinear / linear), (1 - r) / (1 - 0.5 * r), 1e-6);
}

TEST(PlasticLaws, RoughPlasticObeysThem) {
  Masking masking = Masking::separable;
  for (const auto distribution : {Roughness::Distribution::ggx, Roughness::Distribution::beckmann})
    for (double eta : {1.49, 4.0})
      for (double alpha : {1e-3, 1e-2, 0.1, 0.3, 1.0}) {
        masking = masking == Masking::correlated ? Masking::separable : Masking::correlated;
        const Microfacets coat = make_microfacets(alpha, alpha, distribution, masking);
        const auto tables = make_rough_plastic_tables(eta, coat);
        for (bool nonlinear : {false, true}) {
          if (nonlinear != (alpha < 0.2)) continue;
          const RoughPlasticBsdf bsdf{.diffuse_reflectance = {{1, 0.5f, 0, 1}},
                                      .eta = eta,
                                      .microfacets = coat,
                                      .tables = &tables,
                                      .nonlinear = nonlinear};
          const std::string name = fmt::format("η = {}, {}", eta, laws::name_of(bsdf.microfacets));
          laws::expect_laws(subject(bsdf), name, {.samples = 4000});
          laws::expect_finite_at_extremes(subject(bsdf), name);
        }
      }
}

// The tables of a flat coat are Fresnel's laws.
TEST(PlasticLaws, TablesOfAFlatCoat) {
  for (const auto distribution : {Roughness::Distribution::ggx, Roughness::Distribution::beckmann}) {
    const auto tables = make_rough_plastic_tables(1.5, make_microfacets(1e-4, 1e-4, distribution));
    for (int i = 1; i < RoughPlasticTables::count; ++i)
      EXPECT_NEAR(static_cast<double>(tables.external_transmittance[static_cast<std::size_t>(i)]),
                  1 - fresnel_dielectric(i / 63.0, 1.5), 1e-3)
          << i;
    EXPECT_NEAR(tables.internal_reflectance, fresnel_diffuse(1 / 1.5), 0.02) << "64 cosines are coarse";
  }
}

}  // namespace
}  // namespace vitrail::plastic_laws_test
