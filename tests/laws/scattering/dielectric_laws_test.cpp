// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/dielectric.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/laws/scattering/bsdf_laws.h"
#include "tests/laws/scattering/rough_cases.h"
#include "tests/support/polarised.h"
#include "tracer/bsdf/local.h"

namespace vitrail::dielectric_laws_test {
namespace {

using laws::albedo;
using laws::subject;

laws::Subject two_sided(const DielectricBsdf& bsdf) { return subject(bsdf, true, bsdf.eta); }

Vector3d below(Vector3d v) { return {v.x, v.y, -v.z}; }

void expect_all(const DielectricBsdf& bsdf, const laws::Tolerances& tolerances = {}) {
  const std::string name = fmt::format("η = {}, {}", bsdf.eta, laws::name_of(bsdf.microfacets));
  laws::expect_laws(two_sided(bsdf), name, tolerances);
  laws::expect_finite_at_extremes(two_sided(bsdf), name);
}

TEST(DielectricLaws, RoughGlassObeysThem) {
  for (const Microfacets& mf : laws::rough_cases()) expect_all({1.5, mf}, {.samples = 2500});
}

TEST(DielectricLaws, OtherIndicesObeyThem) {
  for (double eta : {1 / 1.5, 4.0, 0.25, 1.001, 1.0000001})
    for (const auto& [u, v] : {std::pair{1e-3, 1e-3}, {0.2, 0.4}})
      expect_all({eta, make_microfacets(u, v)}, {.samples = 2500});
}

TEST(DielectricLaws, FactorsObeyThem) {
  for (const auto& [r, t] : {std::pair{0.0f, 1.0f}, {1.0f, 0.0f}, {0.5f, 0.25f}, {0.0f, 0.0f}})
    expect_all({1.5, make_microfacets(0.2, 0.1), {{r, r / 2, 0, r}}, {{t, 0, t / 2, t}}}, {.samples = 2500});
}

// A smooth interface: R + T = 1 exactly, each by its own law. What a choice weighs makes up for its
// probability being a number of steps of u.
TEST(DielectricLaws, SmoothGlassSplitsTheLight) {
  for (double eta : {1.5, 1 / 1.5, 4.0, 0.25, 1.0000001, 1.0})
    for (Vector3d above : laws::incidences())
      for (Vector3d out : {above, below(above)}) {
        const DielectricBsdf glass{.eta = eta};
        const double ratio = out.z > 0 ? eta : 1 / eta;
        const double r = fresnel_dielectric(above.z, ratio), chance = attainable(r);
        int reflected = 0;
        constexpr int count = 1000;
        for (int i = 0; i < count; ++i) {
          const auto s = sample(glass, out, (static_cast<float>(i) + 0.5f) / count, {0.5f, 0.5f});
          ASSERT_TRUE(s && s->specular);
          const bool up = s->in.z * out.z > 0;
          reflected += up ? 1 : 0;
          const double weight = up ? r / chance : (1 - r) / (1 - chance) / (ratio * ratio);
          EXPECT_NEAR(s->weight[0], weight, 2e-7 * weight);
          // Snell's law, in the plane of incidence.
          const double bent = up ? 1 : ratio;
          EXPECT_NEAR(s->in.x * bent, -out.x, 1e-9);
          EXPECT_NEAR(s->in.y * bent, -out.y, 1e-9);
        }
        EXPECT_NEAR(reflected, r * count, 1);
        EXPECT_NEAR(albedo(two_sided(glass), out).mean, 1, 1e-6);
      }
}

TEST(DielectricLaws, GlassAtNormalIncidenceReflectsFourPercent) {
  const DielectricBsdf glass{.eta = 1.5};
  EXPECT_GT(sample(glass, {0, 0, 1}, 0.0399999f, {})->in.z, 0);
  EXPECT_LT(sample(glass, {0, 0, 1}, 0.0400001f, {})->in.z, 0);
}

TEST(DielectricLaws, WhiteFurnaceOfFlatFacets) {
  for (double eta : {1.5, 4.0})
    for (Vector3d out : laws::incidences())
      for (const auto& [alpha, least] : {std::pair{1e-3, 0.999}, {1e-2, 0.99}, {0.1, 0.94}})
        if (out.z > 0.1 + alpha) {
          const DielectricBsdf glass{eta, make_microfacets(alpha, alpha)};
          EXPECT_GT(albedo(two_sided(glass), out).mean, least) << alpha << " " << out.z;
          EXPECT_GT(albedo(two_sided(glass), below(out)).mean, least) << alpha << " " << -out.z;
        }
}

TEST(DielectricLaws, MatchedIndicesLetLightThrough) {
  for (double eta : {1.0, 1 + 1e-7, 1 - 1e-7}) {
    const DielectricBsdf nothing{eta, make_microfacets(0.3, 0.3)};
    const auto s = sample(nothing, {0.6, 0, -0.8}, 0.0f, {0.1f, 0.2f});
    ASSERT_TRUE(s && s->specular);
    EXPECT_EQ(s->in, (Vector3d{-0.6, 0, 0.8}));
    EXPECT_EQ(s->weight, filled(1));
  }
}

// The sheet: Σ over the reflections between its faces, R + T²R·Σ R²ᵏ.
TEST(DielectricLaws, ThinSheetSumsItsReflections) {
  const ThinDielectricBsdf sheet{{{1.5f, 1.01f, 4, 1 / 1.5f}}};
  for (Vector3d above : laws::incidences())
    for (Vector3d out : {above, below(above)}) {
      const auto reflected = sample(sheet, out, 0, {}), through = sample(sheet, out, 0.999999f, {});
      ASSERT_TRUE(reflected);
      EXPECT_EQ(reflected->in, (Vector3d{-out.x, -out.y, out.z}));
      for (int i = 0; i < hero_count; ++i) {
        const auto reflected_by = [&](double eta) {
          return test::over_polarisations([&](test::Fresnel f) {
            const double r = f(above.z, eta), t = 1 - r;
            double all = r;
            for (int k = 0; k < 4000; ++k) all += t * t * r * std::pow(r, 2 * k);
            return all;
          });
        };
        const double sum = reflected_by(static_cast<double>(sheet.eta[i]));
        EXPECT_NEAR(straight_transmittance(sheet, above.z)[i], 1 - sum, 1e-4);
        // The chance of each is what its weight divides by.
        const double brightest = static_cast<double>(reflected->weight[2]);
        EXPECT_NEAR(static_cast<double>(reflected->weight[i]) / brightest, sum / reflected_by(4), 1e-3);
      }
      if (through && through->in.z * out.z < 0) {
        EXPECT_EQ(through->in, -out);
      }
      const auto all = albedo(subject(sheet, true), out);
      EXPECT_NEAR(all.mean, 1, 2e-3 + 4 * all.standard_error);
      EXPECT_EQ(all.specular, 1);
    }
  laws::expect_finite_at_extremes(subject(sheet, true), "thin sheet");
}

}  // namespace
}  // namespace vitrail::dielectric_laws_test
