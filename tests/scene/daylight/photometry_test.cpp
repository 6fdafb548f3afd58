// SPDX-License-Identifier: Apache-2.0
#include "scene/daylight/photometry.h"

#include <gtest/gtest.h>

namespace vitrail::photometry_test {
namespace {

TabulatedSpectrum daylight() {
  TabulatedSpectrum d65;
  d65.values.assign(cie_d65().begin(), cie_d65().end());
  return d65;
}

// CIE S 026: of D65, melanopic EDI is the illuminance, and a lumen has 1.3262 mW.
TEST(Photometry, MelanopicEdiOfDaylightIsItsIlluminance) {
  EXPECT_NEAR(melanopic_edi(daylight()) / photometric(luminance(Spectrum{daylight()})), 1, 1e-6);
  double power = 0;  // W of 1 lx
  for (std::size_t i = 0; i < melanopic().size(); ++i)
    power += static_cast<double>(melanopic()[i]) * static_cast<double>(cie_d65()[i]) / photometric(1);
  EXPECT_NEAR(power, 1.3262e-3, 1e-7);
}

// CIE S 026, table of daylight (D65) efficacy ratios: illuminant A has 0.496.
TEST(Photometry, MelanopicRatioOfIncandescentLight) {
  const Spectrum a = blackbody(2856);
  EXPECT_NEAR(melanopic_edi(a) / photometric(luminance(a)), 0.496, 2e-3);
}

TEST(Photometry, BinsAddUpToTheWhole) {
  double sum = 0;
  for (int b = 0; b < 47; ++b) sum += melanopic_edi_of_bin(360 + 10 * b, 370 + 10 * b);
  EXPECT_NEAR(sum / melanopic_edi(ConstantSpectrum{1}), 1, 1e-6);
  EXPECT_NEAR(melanopic_edi_of_bin(484.5, 487.25) / (2.75 * melanopic_edi_of_bin(485, 486)), 1, 5e-3);
  EXPECT_EQ(melanopic_edi_of_bin(800, 900), 0);
}

TEST(Photometry, ColorTemperatureOfBlackbodies) {
  for (const double kelvin : {2856.0, 4000.0, 6504.0})
    EXPECT_NEAR(correlated_color_temperature(to_xyz(blackbody(kelvin))), kelvin, 10);
}

}  // namespace
}  // namespace vitrail::photometry_test
