// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/conductor.h"

#include <gtest/gtest.h>

#include "tests/laws/scattering/bsdf_laws.h"
#include "tests/laws/scattering/rough_cases.h"
#include "tracer/bsdf/fresnel.h"

namespace vitrail::conductor_laws_test {
namespace {

using laws::subject;

const ConductorBsdf mirror_surface{.perfect = true};

ConductorBsdf rough(const Microfacets& mf) { return {.microfacets = mf, .perfect = true}; }

TEST(ConductorLaws, PerfectFacetsObeyThem) {
  for (const Microfacets& mf : laws::rough_cases()) {
    laws::expect_laws(subject(rough(mf)), laws::name_of(mf), {.samples = 6000});
    laws::expect_finite_at_extremes(subject(rough(mf)), laws::name_of(mf));
  }
}

TEST(ConductorLaws, MetalsObeyThem) {
  for (const auto& [eta, k] : {std::pair{filled(0.2f), filled(3.9f)},
                               {filled(1.0000001f), filled(1e-6f)},
                               {filled(4), filled(100)}}) {
    const ConductorBsdf metal{make_microfacets(0.1, 0.3), eta, k, {{1, 0.5f, 0, 0.25f}}};
    laws::expect_laws(subject(metal), fmt::format("metal {} + {}i", eta[0], k[0]));
    laws::expect_finite_at_extremes(subject(metal), "metal");
  }
}

TEST(ConductorLaws, AMirrorReflectsByFresnel) {
  for (Vector3d out : laws::incidences()) {
    const auto all = sample(mirror_surface, out, 0.5f, {0.3f, 0.7f});
    ASSERT_TRUE(all && all->specular);
    EXPECT_EQ(all->weight, filled(1));
    EXPECT_EQ(all->in, (Vector3d{-out.x, -out.y, out.z}));
    EXPECT_EQ(eval(mirror_surface, out, all->in).value, filled(0));
    const ConductorBsdf copper{.eta = filled(0.25f), .k = filled(3.5f), .factor = filled(0.5f)};
    EXPECT_NEAR(sample(copper, out, 0.5f, {0.3f, 0.7f})->weight[1], 0.5 * fresnel_conductor(out.z, 0.25, 3.5),
                1e-6);
  }
}

// All but what facets scatter more than once: next to nothing is lost where they are flat.
TEST(ConductorLaws, WhiteFurnaceOfFlatFacets) {
  for (const auto distribution : {Roughness::Distribution::ggx, Roughness::Distribution::beckmann})
    for (Vector3d out : laws::incidences())
      for (const auto& [alpha, least] : {std::pair{1e-3, 0.9995}, {1e-2, 0.998}, {0.1, 0.96}})
        if (out.z > 0.1 + alpha) {
          EXPECT_GT(laws::albedo(subject(rough(make_microfacets(alpha, alpha, distribution))), out).mean,
                    least)
              << alpha << " " << out.z;
        }
}

// GGX of width 1 from straight above: D = 1/π, so the light goes to 2θ of a cosine-weighted θ and is seen by
// G₁ = 2c/(1 + c), c = cos 2θ: ∫ c/(1 + c) dc = 1 − ln 2. The same for both kinds of masking, as G₁(out) = 1.
TEST(ConductorLaws, AlbedoInClosedForm) {
  for (const Masking masking : {Masking::correlated, Masking::separable}) {
    const auto a = laws::albedo(subject(rough(make_microfacets(1, 1, Roughness::Distribution::ggx, masking))),
                                {0, 0, 1});
    EXPECT_NEAR(a.mean, 1 - std::log(2.0), 5e-4);
    EXPECT_NEAR(a.lost, 0.5, 1e-3);
  }
}

// Narrow facets send light where a mirror does.
TEST(ConductorLaws, NarrowFacetsAreAMirror) {
  for (Vector3d out : laws::incidences()) {
    if (out.z < 0.1) continue;
    for (const auto distribution : {Roughness::Distribution::ggx, Roughness::Distribution::beckmann}) {
      const auto s = sample(rough(make_microfacets(1e-6, 1e-6, distribution)), out, 0.5f, {0.3f, 0.6f});
      ASSERT_TRUE(s);
      EXPECT_LT(length(s->in - Vector3d{-out.x, -out.y, out.z}), 1e-3);
    }
  }
}

}  // namespace
}  // namespace vitrail::conductor_laws_test
