// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/slab.h"

#include <gtest/gtest.h>

#include "scene/geometry/portable_math.h"
#include "tests/laws/scattering/bsdf_laws.h"

namespace vitrail::slab_laws_test {
namespace {

using laws::subject;

SlabBsdf slab(float depth, float albedo, double g = 0) { return {filled(depth), filled(albedo), g}; }

TEST(SlabLaws, SlabsObeyThem) {
  const laws::Tolerances t{.reciprocal = false, .samples = 5000};
  for (const auto& [depth, g] : {std::pair{0.01f, 0.0}, {1.0f, 0.7}, {20.0f, -0.5}})
    laws::expect_laws(subject(slab(depth, 0.9f, g), true), "slab", t);
  laws::expect_laws(subject(SlabBsdf{{{0.1f, 1, 3, 0}}, {{1, 0.5f, 0.9f, 0}}}, true), "coloured slab", t);
  for (const float depth : {0.0f, 1e-6f, 1.0f, 1e6f})
    laws::expect_finite_at_extremes(subject(slab(depth, 1), true), "slab");
}

// The equations of slab.h as they stand there, where they are well conditioned.
TEST(SlabLaws, FollowsItsEquations) {
  const double tau = 0.7;
  for (const double c : {0.9, 0.4, 0.1})
    for (const double d : {0.8, 0.5, 0.12}) {
      const Vector3d out{safe_sqrt(1 - c * c), 0, c}, above{0, safe_sqrt(1 - d * d), d},
          below{above.x, above.y, -d};
      const double p = 0.6 / (4 * pi);
      const SlabBsdf b = slab(0.7f, 0.6f);
      EXPECT_NEAR(eval(b, out, above).value[1], p * c * d / (c + d) * (1 - std::exp(-tau * (1 / c + 1 / d))),
                  1e-7);
      EXPECT_NEAR(eval(b, out, below).value[1],
                  p * c * d / (c - d) * (std::exp(-tau / c) - std::exp(-tau / d)), 1e-7);
    }
}

// Where the two cosines are the same: ϖ p τ e^(−τ/c).
TEST(SlabLaws, StraightAcrossIsTheLimit) {
  const SlabBsdf b = slab(2, 1, 0);
  const Vector3d out{0.6, 0, 0.8};
  EXPECT_NEAR(eval(b, out, {0.6, 0, -0.8}).value[0], 2 / (4 * pi) * std::exp(-2.5), 1e-7);
  EXPECT_NEAR(straight_transmittance(b, 0.8)[0], std::exp(-2.5), 1e-7);
}

// An infinite slab that absorbs nothing returns, of light seen along c, ∫ c c'/(c + c') dc'/2 = c/2·(1 − c
// ln(1 + 1/c)).
TEST(SlabLaws, AlbedoOfADeepSlab) {
  for (const double c : {1.0, 0.5, 0.1})
    EXPECT_NEAR(laws::albedo(subject(slab(1e6f, 1), true), {safe_sqrt(1 - c * c), 0, c}).mean,
                c / 2 * (1 - c * std::log1p(1 / c)), 5e-4);
}

}  // namespace
}  // namespace vitrail::slab_laws_test
