// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/measured.h"

#include <gtest/gtest.h>

namespace vitrail::measured_test {
namespace {

const MeasuredSheet pane{
    {400, 600, 700}, {0, .5f, 1}, {1, .2f, .1f, 1, .4f, .3f, 1, 0, 0}, {0, .6f, .8f, 0, .5f, .6f, 0, 0, 1}};
const SampledWavelengths wavelengths{{400, 450, 600, 800}, {}};

TEST(MeasuredSheet, IsBilinearAndHeldBeyondItsWavelengths) {
  const SheetFractions f = sheet_fractions(pane, wavelengths, .75);
  EXPECT_NEAR(f.reflected[0], .15, 1e-6);
  EXPECT_NEAR(f.reflected[1], .75 * .15 + .25 * .35, 1e-6);
  EXPECT_NEAR(f.reflected[2], .35, 1e-6);
  EXPECT_NEAR(f.reflected[3], 0, 1e-6);
  EXPECT_NEAR(f.transmitted[1], .75 * .7 + .25 * .55, 1e-6);
  EXPECT_NEAR(f.transmitted[3], .5, 1e-6);
  EXPECT_EQ(sheet_fractions(pane, wavelengths, 1).transmitted[3], 1);
  EXPECT_EQ(sheet_fractions(pane, wavelengths, 0).reflected[1], 1);
  EXPECT_EQ(sheet_fractions(pane, {{100, 200, 300, 399}, {}}, 1).reflected[2], .1f);
}

TEST(MeasuredSheet, SamplesMirrorOrGoOnWithTheirFractions) {
  for (const Vector3d out : {Vector3d{.6, 0, .8}, Vector3d{.28, -.96 * .6, -.768}}) {
    const SheetFractions f = sheet_fractions(pane, wavelengths, std::abs(out.z));
    SampledSpectrum reflected{}, transmitted{};
    constexpr int count = 1 << 14;
    for (int i = 0; i < count; ++i) {
      const auto s =
          sample(MeasuredSheetBsdf{&pane, wavelengths}, out, (static_cast<float>(i) + .5f) / count, {});
      ASSERT_TRUE(s && s->specular);
      const bool mirrored = s->in == Vector3d{-out.x, -out.y, out.z};
      ASSERT_TRUE(mirrored || s->in == -out);
      (mirrored ? reflected : transmitted) =
          (mirrored ? reflected : transmitted) + s->weight * (1.0f / count);
    }
    for (int i = 0; i < hero_count; ++i) {
      EXPECT_NEAR(reflected[i], f.reflected[i], 1e-3);
      EXPECT_NEAR(transmitted[i], f.transmitted[i], 1e-3);
    }
  }
}

// Whatever a path carries, a choice does not add to the sum of it.
TEST(MeasuredSheet, ChoosesByWhatThePathCarries) {
  const SampledSpectrum carried{{1, 100, 0.01f, 3}};
  const MeasuredSheetBsdf sheet{&pane, wavelengths, carried};
  const auto total = [](const SampledSpectrum& s) { return s[0] + s[1] + s[2] + s[3]; };
  for (const float u : {0.0f, 0.9999999f}) {
    const auto s = sample(sheet, {.6, 0, .8}, u, {});
    ASSERT_TRUE(s);
    EXPECT_LE(total(carried * s->weight), total(carried) * 1.000001f) << u;
  }
}

TEST(MeasuredSheet, BlackAbsorbs) {
  const MeasuredSheet black{{500}, {1}, {0}, {0}};
  EXPECT_FALSE(sample(MeasuredSheetBsdf{&black, wavelengths}, {0, 0, 1}, .5f, {}));
}

}  // namespace
}  // namespace vitrail::measured_test
