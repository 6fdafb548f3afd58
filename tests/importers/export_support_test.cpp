// SPDX-License-Identifier: Apache-2.0
// What writers of all formats share: what they say, and the colours of what their format has not.
#include <gmock/gmock.h>

#include "importers/writing/conversion_notes.h"
#include "importers/writing/export_colors.h"

namespace vitrail::export_support_test {
namespace {

TEST(ConversionNotes, SayEachMessageOncePerPlaceAndKind) {
  Scene scene;
  scene.files = {"a.pbrt"};
  ConversionNotes notes(scene);
  Origin first, second;
  first.line = 1, second.line = 2;
  for (int i = 0; i < 2; ++i) {
    notes.dropped("a lens", first, RecordKind::camera);
    notes.dropped("a lens", second, RecordKind::camera);
    notes.dropped("a lens", second, RecordKind::film);
    notes.approximated("a lens", second, RecordKind::film);
    notes.approximated("a film", second, RecordKind::film);
  }
  EXPECT_EQ(notes.take().size(), 5u);
}

void expect_near(RGB a, RGB b, double tolerance) {
  EXPECT_NEAR(a.r, b.r, tolerance);
  EXPECT_NEAR(a.g, b.g, tolerance);
  EXPECT_NEAR(a.b, b.b, tolerance);
}

// ((n − 1)² + κ²)/((n + 1)² + κ²)
TEST(ColorsForExport, OfMetalsAreFresnels) {
  const ComplexIndex metal{Spectrum{ConstantSpectrum{0.25f}}, Spectrum{ConstantSpectrum{3}}};
  const double r = (0.75 * 0.75 + 9) / (1.25 * 1.25 + 9);
  expect_near(normal_reflectance_rgb(metal), {r, r, r}, 1e-4);
  expect_near(normal_reflectance_rgb(PerfectReflector{}), {1, 1, 1}, 0);
}

// Held beyond the wavelengths that were measured; of the cosines the last is that of normal incidence.
TEST(ColorsForExport, OfSheetsAreThoseOfTheirNormal) {
  const SheetColors colors =
      colors_at_normal({{500, 600}, {0.5f, 1}, {0.9f, 0.25f, 0.9f, 0.25f}, {0, 0.5f, 0, 0.5f}});
  expect_near(colors.reflected, {0.25, 0.25, 0.25}, 1e-4);
  expect_near(colors.transmitted, {0.5, 0.5, 0.5}, 1e-4);
}

TEST(ColorsForExport, OfPatternsAreTheirMeans) {
  PatternTexture bricks;
  bricks.kind = PatternTexture::Kind::brick;
  bricks.brick.size = {2, 2, 2};
  bricks.brick.mortar = 0.5f;
  bricks.map = {{0, Spectrum{ConstantSpectrum{0.25f}}}, {0, Spectrum{ConstantSpectrum{0.25f}}}};
  expect_near(mean_of_pattern(bricks), {0.25, 0.25, 0.25}, 1e-6);
  bricks.map[1].value = Spectrum{ConstantSpectrum{1}};
  const double shown = 0.75 * 0.75 * 0.75;  // of bricks that end in mortar
  const double mean = shown + (1 - shown) * 0.25;
  expect_near(mean_of_pattern(bricks), {mean, mean, mean}, 0.01);
  PatternTexture ramp;
  ramp.kind = PatternTexture::Kind::marble;
  expect_near(mean_of_pattern(ramp), {0.5, 0.5, 0.5}, 0.01);
}

}  // namespace
}  // namespace vitrail::export_support_test
