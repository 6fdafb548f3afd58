// SPDX-License-Identifier: Apache-2.0
// The share of light that is scattered, against the mean of independent samples and of closed forms.
#include "tracer/surfaces/albedo.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tracer/sampling/sampler.h"

namespace vitrail::albedo_test {
namespace {

Vector3d direction(double cosine) { return {std::sqrt(1 - cosine * cosine), 0, cosine}; }

double mean_albedo(const Bsdf& bsdf, Vector3d out, int times) {
  double sum = 0;
  for (int i = 0; i < times; ++i)
    sum +=
        static_cast<double>(albedo(bsdf, out, stream_seed({7, 0, static_cast<std::uint32_t>(i)}, 1, 2))[0]);
  return sum / times;
}

double mean_of_weights(const Bsdf& bsdf, Vector3d out, int times) {
  double sum = 0;
  RandomStream random(11);
  for (int i = 0; i < times; ++i) {
    const auto lobe = static_cast<float>(random.next());
    const Point2f u{static_cast<float>(random.next()), static_cast<float>(random.next())};
    if (const auto s = sample(bsdf, out, std::min(lobe, 0x1.fffffep-1f),
                              {std::min(u.x, 0x1.fffffep-1f), std::min(u.y, 0x1.fffffep-1f)}))
      sum += static_cast<double>(s->weight[0]);
  }
  return sum / times;
}

const Microfacets rough = make_microfacets(0.3, 0.3, Roughness::Distribution::ggx, Masking::separable);

const Microfacets narrow = make_microfacets(0.03, 0.03, Roughness::Distribution::ggx, Masking::separable);

// Of those that do not refract.
TEST(Albedo, IsTheMeanOfSamples) {
  ConductorBsdf metal;
  metal.eta = filled(0.2f), metal.k = filled(3), metal.factor = filled(0.9f), metal.microfacets = rough;
  PrincipledBsdf plastic;
  plastic.base_color = filled(0.6f), plastic.clearcoat = 0.5, plastic.sheen = 0.5;
  for (const Bsdf& bsdf :
       {Bsdf{LambertBsdf{filled(0.4f)}}, Bsdf{OrenNayarBsdf{filled(0.7f), 0.5}}, Bsdf{metal}, Bsdf{plastic},
        Bsdf{DiffuseTransmissionBsdf{filled(0.3f), filled(0.2f)}}})
    for (const double cosine : {0.95, 0.3})
      EXPECT_NEAR(mean_albedo(bsdf, direction(cosine), 4000),
                  mean_of_weights(bsdf, direction(cosine), 200000), 4e-3)
          << bsdf.index() << " " << cosine;
}

// No 1/η² of radiance is in it. (Facets lose what they scatter twice: little where they are narrow.)
TEST(Albedo, OfGlassIsThePowerFromEitherSide) {
  DielectricBsdf smooth{1.5, {}, filled(1), filled(1)}, glass{1.5, narrow, filled(1), filled(1)};
  PrincipledBsdf principled;
  principled.base_color = filled(1), principled.spec_trans = 1, principled.roughness = 0.2;
  for (const double cosine : {0.95, 0.5, -0.95, -0.5}) {
    EXPECT_NEAR(mean_albedo(smooth, direction(cosine), 100), 1, 1e-6) << cosine;
    EXPECT_NEAR(mean_albedo(glass, direction(cosine), 1000), 1, 0.02) << cosine;
    EXPECT_NEAR(mean_albedo(principled, direction(cosine), 1000), 0.98, 0.06) << cosine;
  }
  smooth.transmittance_factor = {};
  EXPECT_NEAR(mean_albedo(smooth, {0, 0, 1}, 100), 0.04, 1e-6);
  EXPECT_NEAR(mean_albedo(smooth, direction(-0.5), 100), 1, 1e-6) << "total reflection";
  // Matched indices: light goes straight on.
  EXPECT_NEAR(mean_albedo(DielectricBsdf{1, rough, filled(1), filled(0.8f)}, direction(0.7), 10), 0.8, 1e-6);
}

TEST(Albedo, IsExactWhereItIsKnown) {
  EXPECT_EQ(albedo(LambertBsdf{filled(0.5f)}, direction(0.3), 1), filled(0.5f));
  EXPECT_EQ(albedo(DiffuseTransmissionBsdf{filled(0.5f), filled(0.25f)}, direction(0.3), 1), filled(0.75f));
}

}  // namespace
}  // namespace vitrail::albedo_test
