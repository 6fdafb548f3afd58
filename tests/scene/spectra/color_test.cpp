// SPDX-License-Identifier: Apache-2.0
#include "scene/spectra/color.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/spectra/named_spectra.h"
#include "scene/system/diagnostics.h"

namespace vitrail::color_test {
namespace {

TEST(CieTables, ObserverIntegratesToTheConstant) {
  double x = 0, y = 0, z = 0;
  for (const auto& cmf : cie_1931()) x += cmf[0], y += cmf[1], z += cmf[2];
  EXPECT_NEAR(y, cie_y_integral_nm, 1e-4);
  EXPECT_NEAR(x, 106.865469, 1e-3);  // the equal-energy illuminant is white: ∫x̄ ≈ ∫ȳ ≈ ∫z̄
  EXPECT_NEAR(z, 106.892251, 1e-3);
}

TEST(CieTables, ObserverPeaksAt555) { EXPECT_EQ(cie_1931()[555 - 360][1], 1.0f); }

TEST(CieTables, D65HasLuminanceOneAndItsChromaticity) {
  const XYZ w = to_xyz(*named_spectrum("stdillum-D65"));
  EXPECT_NEAR(w.y, 1, 1e-6);
  EXPECT_NEAR(w.x / (w.x + w.y + w.z), 0.31272, 2e-5);  // CIE 15, table T.3
  EXPECT_NEAR(w.y / (w.x + w.y + w.z), 0.32903, 2e-5);
}

TEST(CieTables, IlluminantAHasItsChromaticity) {
  const XYZ a = to_xyz(*named_spectrum("stdillum-A"));
  EXPECT_NEAR(a.y, 1, 1e-6);
  EXPECT_NEAR(a.x / (a.x + a.y + a.z), 0.44758, 2e-5);
  EXPECT_NEAR(a.y / (a.x + a.y + a.z), 0.40745, 2e-5);
}

TEST(Srgb, MatrixIsThatOfTheStandardToItsRoundedWhite) {
  const XYZ r = srgb_to_xyz({1, 0, 0}), g = srgb_to_xyz({0, 1, 0}), b = srgb_to_xyz({0, 0, 1});
  EXPECT_NEAR(r.x, 0.4124, 3e-4);  // IEC 61966-2-1
  EXPECT_NEAR(r.y, 0.2126, 3e-4);
  EXPECT_NEAR(g.y, 0.7152, 3e-4);
  EXPECT_NEAR(b.y, 0.0722, 3e-4);
  EXPECT_NEAR(b.z, 0.9505, 3e-4);
}

TEST(Srgb, MatricesAreInverse) {
  for (const RGB c : {RGB{1, 0, 0}, RGB{0.2, 0.5, 0.9}, RGB{-3, 70, 1e-6}}) {
    const RGB back = xyz_to_srgb(srgb_to_xyz(c));
    EXPECT_NEAR(back.r, c.r, 1e-13);
    EXPECT_NEAR(back.g, c.g, 1e-13);
    EXPECT_NEAR(back.b, c.b, 1e-13);
  }
}

TEST(ColorSpaces, WhiteStaysWhite) {
  for (const char* space : {"srgb", "rec2020", "dci-p3", "aces2065-1"}) {
    const RGB white = to_srgb({1, 1, 1}, space);
    EXPECT_NEAR(white.r, 1, 1e-12) << space;
    EXPECT_NEAR(white.g, 1, 1e-12) << space;
    EXPECT_NEAR(white.b, 1, 1e-12) << space;
  }
}

TEST(ColorSpaces, Rec2020RedIsOutsideOfSrgb) {
  const RGB red = to_srgb({1, 0, 0}, "rec2020");  // BT.2087: 1.6605, −0.1246, −0.0182
  EXPECT_NEAR(red.r, 1.6605, 1e-3);
  EXPECT_NEAR(red.g, -0.1246, 1e-3);
  EXPECT_NEAR(red.b, -0.0182, 1e-3);
}

TEST(ColorSpaces, UnknownNamesAreErrors) { EXPECT_THROW(to_srgb({1, 1, 1}, "adobe"), Error); }

TEST(SrgbTransfer, KnownValuesAndInverse) {
  EXPECT_NEAR(srgb_decode(128.0 / 255), 0.21586, 1e-5);
  EXPECT_EQ(srgb_encode(0), 0);
  EXPECT_NEAR(srgb_encode(1), 1, 1e-15);
  for (double v = 0; v <= 1; v += 1.0 / 255) EXPECT_NEAR(srgb_encode(srgb_decode(v)), v, 2e-8);
}

}  // namespace
}  // namespace vitrail::color_test
