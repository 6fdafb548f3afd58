// SPDX-License-Identifier: Apache-2.0
// Averages and colours of spectra that have known ones.
#include "glazing/evaluation.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "scene/spectra/color.h"
#include "scene/system/diagnostics.h"
#include "tests/glazing/glazing_files.h"

namespace vitrail::test::evaluation_test {
namespace {

Evaluation of_flat(double t, Sampling sampling) {
  const std::vector<double> nm{300, 900, 2500};
  const auto spectrum = [&](std::vector<double> at) {
    const std::size_t count = at.size();
    return SystemSpectrum{std::move(at), std::vector<PaneValues>(count, {t, 0.1, 0.2})};
  };
  return evaluate(spectrum, nm, nfrc_2003(), sampling);
}

TEST(Evaluation, OfAConstantIsTheConstant) {
  for (const Sampling sampling : {Sampling::full, Sampling::condensed, Sampling::standard}) {
    const Evaluation e = of_flat(0.5, sampling);
    ASSERT_EQ(e.averages.size(), 5u);
    for (const auto& [name, v] : e.averages) {
      EXPECT_NEAR(v.t, 0.5, 1e-12) << name;
      EXPECT_NEAR(v.rf, 0.1, 1e-12) << name;
      EXPECT_NEAR(v.rb, 0.2, 1e-12) << name;
    }
    ASSERT_TRUE(e.has_color);
    EXPECT_NEAR(e.t.xyz[1], 50, 1e-9);
    EXPECT_NEAR(e.rf.xyz[1], 10, 1e-9);
    EXPECT_NEAR(e.rb.xyz[1], 20, 1e-9);
    EXPECT_NEAR(e.t.lab[0], 76.0693, 1e-4);  // 116·0.5^⅓ − 16
    EXPECT_NEAR(e.t.lab[1], 0, 1e-9);
    EXPECT_NEAR(e.t.lab[2], 0, 1e-9);
  }
}

// WinCalc's: of the visible 380 nm (three times) to 780 nm in steps of 80, of the infrared to 2328 nm in
// steps of 172.
TEST(Evaluation, CondensedTakesTheSpectrumOfFewWavelengths) {
  std::vector<double> asked;
  const auto spectrum = [&](std::vector<double> at) {
    if (at.size() > 2) asked = at;
    const std::size_t count = at.size();
    return SystemSpectrum{std::move(at), std::vector<PaneValues>(count, {0.5, 0.1, 0.2})};
  };
  evaluate(spectrum, {300, 2500}, nfrc_2003(), Sampling::condensed);
  std::vector<double> expected{300, 380 - 2e-3, 380, 380 + 2e-3, 460, 540, 620, 700};
  for (int i = 0; i < 10; ++i) expected.push_back(780 + 172 * i);
  expected.push_back(2500);
  EXPECT_EQ(asked, expected);
}

// The spectrum is 1 at the wavelengths of the panes, between those of the methods, and else 0.
TEST(Evaluation, FullTakesColorsOfThePanesWavelengthsWhereTheseAreFine) {
  for (const auto& [step_nm, light] : {std::pair{5, 100}, {10, 100}, {20, 0}}) {
    std::vector<double> nm;
    for (double at = 302.5; at < 2500; at += step_nm) nm.push_back(at);
    const auto spectrum = [&](std::vector<double> at) {
      std::vector<PaneValues> values;
      for (const double x : at) values.push_back({x == std::floor(x) ? 0.0 : 1.0, 0, 0});
      return SystemSpectrum{std::move(at), std::move(values)};
    };
    EXPECT_NEAR(evaluate(spectrum, nm, nfrc_2003(), Sampling::full).t.xyz[1], light, 1e-9) << step_nm;
  }
}

// D65 seen by the observer of 1964: the white that CIE 15 gives.
TEST(Evaluation, HasTheWhiteOfD65) {
  const ColorValues white = of_flat(1, Sampling::standard).t;
  EXPECT_NEAR(white.xyz[0], 94.81, 0.02);
  EXPECT_NEAR(white.xyz[2], 107.32, 0.02);
}

// Light of one wavelength has that dominant wavelength and is pure; half of it with white is in between.
TEST(ColorValues, FindDominantWavelengths) {
  const std::array<double, 3> white{0.9481, 1, 1.0732};
  // x̄, ȳ, z̄ of 1964 at 500 nm.
  const std::array<double, 3> green{0.003816, 0.460777, 0.218502};
  std::array<double, 3> relative{};
  for (std::size_t i = 0; i < 3; ++i) relative[i] = green[i] / white[i];
  const ColorValues pure = color_values(relative, white, Observer::cie_1964);
  EXPECT_NEAR(pure.dominant_nm, 500, 0.01);
  EXPECT_NEAR(pure.purity, 1, 1e-4);
  for (double& v : relative) v = 0.5 * v + 0.2;
  const ColorValues mixed = color_values(relative, white, Observer::cie_1964);
  EXPECT_NEAR(mixed.dominant_nm, 500, 0.01);
  EXPECT_LT(mixed.purity, 0.6);
  const ColorValues purple = color_values({0.5, 0.3, 0.5}, white, Observer::cie_1964);
  EXPECT_TRUE(purple.dominant_nm == 360 || purple.dominant_nm == 830);
  ASSERT_TRUE(purple.complementary_nm);
  EXPECT_GT(*purple.complementary_nm, 500);
  EXPECT_LT(*purple.complementary_nm, 570);
}

// Light of both ends of the spectrum lies on the line of purples, wherever it does.
TEST(ColorValues, FindPurplesPure) {
  const std::array<double, 3> white{0.9505, 1, 1.089};
  const auto &blue = cie_1931().front(), &red = cie_1931().back();
  for (const double share : {0.2, 0.7}) {
    std::array<double, 3> relative{};
    for (std::size_t i = 0; i < 3; ++i)
      relative[i] = (share * blue[i] / (blue[0] + blue[1] + blue[2]) +
                     (1 - share) * red[i] / (red[0] + red[1] + red[2])) /
                    white[i];
    const ColorValues purple = color_values(relative, white, Observer::cie_1931);
    EXPECT_NEAR(purple.purity, 1, 1e-5) << share;
    EXPECT_EQ(purple.dominant_nm, share > 0.5 ? 360 : 830);
  }
}

// A display of 80 cd/m² that reflects 0.2 cd/m² has to add a quarter of its range.
TEST(ColorValues, AreShownOnADisplay) {
  const std::array<double, 3> d65{0.9505, 1, 1.089};
  const double quarter = (0.2 + (80 - 0.2) / 4) / 100;
  const auto rgb_of = [&](double relative) {
    return color_values({relative, relative, relative}, d65, Observer::cie_1931).rgb;
  };
  EXPECT_EQ(rgb_of(quarter), (std::array{137, 137, 137}));  // 255 (1.055·0.25^(1/2.4) − 0.055)
  EXPECT_EQ(rgb_of(1), (std::array{255, 255, 255}));
  EXPECT_EQ(rgb_of(0), (std::array{0, 0, 0}));
}

TEST(Standard, IsReadFromFiles) {
  const TemporaryDirectory directory;
  write_text(directory / "sun.ssp",
             "Description: a sun\nType: Source\nWavelength Units: microns\n\n0.4 1\n0.6 3\n");
  write_text(directory / "eye.dsp", "Wavelength Units: Nanometers\n400 1\n600 0\n");
  write_text(
      directory / "s.std",
      "Standard Description : made up\n\nName : SOLAR\nSource Spectrum : sun.ssp\nDetector Spectrum : None\n"
      "Wavelength Set : Source\nIntegration Rule : Trapezoidal\nMinimum Wavelength : 0.4\nMaximum Wavelength "
      ": "
      "Wavelength set\n\nName : THERMAL IR\nSource Spectrum : Blackbody (T=300.0K)\n\nName : TDW\nSource "
      "Spectrum "
      ": sun.ssp\nDetector Spectrum : UV Action (a=3.6, b=12.0)\nWavelength Set : Data\n\nName : PHOTOPIC\n"
      "Source Spectrum : sun.ssp\nDetector Spectrum : eye.dsp\nIntegration Rule : Pre-weighted Table\n");
  const Standard standard = read_standard(directory / "s.std");
  ASSERT_EQ(standard.methods.size(), 3u);
  const SystemSpectrum ramp{{400, 600}, {{0, 0, 0}, {1, 0, 0}}};
  EXPECT_NEAR(average(ramp, *find_method(standard, "solar")).t, 3.0 / 4, 1e-12);
  EXPECT_NEAR(average(ramp, *find_method(standard, "PHOTOPIC")).t, 0, 1e-12);
  ASSERT_TRUE(find_method(standard, "TDW")->action);
  EXPECT_EQ(find_method(standard, "TDW")->action->b, 12);
  EXPECT_EQ(find_method(standard, "TKR"), nullptr);
  for (const auto& [unit, scale] : {std::pair{"nm", 1.0},
                                    {"NM", 1.0},
                                    {"nanometres", 1.0},
                                    {"um", 1e-3},
                                    {"\u00b5m", 1e-3},
                                    {"Micrometers", 1e-3}}) {
    write_text(directory / "sun.ssp",
               fmt::format("Wavelength Units: {}\n\n{} 1\n{} 3\n", unit, 400 * scale, 600 * scale));
    EXPECT_NEAR(average(ramp, *find_method(read_standard(directory / "s.std"), "solar")).t, 3.0 / 4, 1e-12)
        << unit;
  }
  write_text(directory / "sun.ssp", "Description: a sun\nWavelength Units: furlongs\n\n400 1\n600 3\n");
  EXPECT_THAT(
      [&] { read_standard(directory / "s.std"); },
      ::testing::ThrowsMessage<Error>(::testing::HasSubstr("knows no unit of wavelength \"furlongs\"")));
  write_text(directory / "bad.std", "Name : SOLAR\nSource Spectrum : none.ssp\n");
  EXPECT_THROW(read_standard(directory / "bad.std"), Error);
  write_text(directory / "empty.std", "nothing\n");
  EXPECT_THROW(read_standard(directory / "empty.std"), Error);
}

}  // namespace
}  // namespace vitrail::test::evaluation_test
