// SPDX-License-Identifier: Apache-2.0
#include "scene/spectra/spectrum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "scene/spectra/color.h"
#include "scene/spectra/named_spectra.h"
#include "scene/spectra/rgb_to_spectrum.h"
#include "scene/system/diagnostics.h"

namespace vitrail::spectrum_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(Tabulate, InterpolatesBetweenSamplesAndIsZeroOutside) {
  const Spectrum s = tabulate({{400, 1}, {500, 3}}, false);
  EXPECT_DOUBLE_EQ(evaluate(s, 400), 1);
  EXPECT_DOUBLE_EQ(evaluate(s, 450), 2);
  EXPECT_NEAR(evaluate(s, 450.5), 2.01, 1e-6);
  EXPECT_DOUBLE_EQ(evaluate(s, 500), 3);
  EXPECT_EQ(evaluate(s, 399), 0);
  EXPECT_EQ(evaluate(s, 501), 0);
}

TEST(Tabulate, ExtendsOnRequest) {
  const Spectrum s = tabulate({{400, 1}, {500, 3}}, true);
  EXPECT_EQ(evaluate(s, 360), 1);
  EXPECT_EQ(evaluate(s, 830), 3);
  EXPECT_TRUE(is_constant(tabulate({{550, 0.25}}, true)));
}

// A triangle of area `height`·`half_width`.
std::vector<std::array<double, 2>> line(double nm, double half_width, double height) {
  return {{600, 0}, {nm - half_width, 0}, {nm, height}, {nm + half_width, 0}, {700, 0}};
}

// Against the integral of the line times the observer, which is linear between whole nanometres.
TEST(Tabulate, KeepsTheIntegralOfALine) {
  const auto observer = [](double nm) {
    const auto i = static_cast<std::size_t>(nm - lambda_min_nm);
    const double f = nm - std::floor(nm);
    return (1 - f) * static_cast<double>(cie_1931()[i][1]) + f * static_cast<double>(cie_1931()[i + 1][1]);
  };
  for (const double nm : {656.0, 656.08, 656.28, 656.5, 656.97, 625.3})
    for (const double half_width : {0.001, 0.08, 0.7, 1.5}) {
      constexpr int steps = 20000;
      double y = 0;
      for (int k = 0; k < steps; ++k) {
        const double x = 2 * (k + 0.5) / steps - 1;
        y += 100 * (1 - std::abs(x)) * observer(nm + x * half_width) * 2 * half_width / steps;
      }
      y /= cie_y_integral_nm;
      EXPECT_NEAR(to_xyz(tabulate(line(nm, half_width, 100), false)).y, y, 1e-5 * y)
          << nm << " ± " << half_width;
    }
}

TEST(Tabulate, KeepsTheIntegralOfEverything) {
  const std::vector<std::array<double, 2>> samples{
      {412.3, 2}, {412.35, 7}, {500.5, 0}, {500.6, 9}, {701.9, 4}};
  const TabulatedSpectrum table = tabulate(samples, false);
  double want = 0, found = 0;
  for (std::size_t i = 1; i < samples.size(); ++i)
    want += (samples[i][0] - samples[i - 1][0]) * (samples[i][1] + samples[i - 1][1]) / 2;
  for (const float v : table.values) {
    found += static_cast<double>(v);
    EXPECT_GE(v, 0);
  }
  EXPECT_NEAR(found, want, 1e-6 * want);
}

TEST(Tabulate, KeepsConstantsAndWholeNanometres) {
  EXPECT_TRUE(is_constant(tabulate({{400.3, 0.3}, {512.7, 0.3}}, true)));
  const Spectrum held = tabulate({{400.5, 1}, {500.5, 3}}, true);
  EXPECT_FLOAT_EQ(static_cast<float>(evaluate(held, 360)), 1);
  EXPECT_FLOAT_EQ(static_cast<float>(evaluate(held, 450)), 1.99f);
  EXPECT_FLOAT_EQ(static_cast<float>(evaluate(held, 830)), 3);
  const Spectrum whole = tabulate({{350.5, 0}, {499, 0}, {500, 1}, {501, 0}, {840.5, 0}}, false);
  EXPECT_EQ(evaluate(whole, 500), 1);
  EXPECT_EQ(evaluate(whole, 501), 0);
}

TEST(Tabulate, RefusesWhatIsNoSpectrum) {
  EXPECT_THROW(tabulate({}, true), Error);
  EXPECT_THROW(tabulate({{400, 1}, {400, 2}}, true), Error);
  EXPECT_THROW(tabulate({{500, 1}, {400, 2}}, true), Error);
  EXPECT_THROW(tabulate({{400, nan}}, true), Error);
  EXPECT_THROW(tabulate({{std::numeric_limits<double>::infinity(), 1}}, true), Error);
}

TEST(Evaluate, HoldsTheEndsOfATable) {
  const Spectrum s = tabulate({{360, 1}, {830, 2}}, false);
  EXPECT_EQ(evaluate(s, 359.999), 1);
  EXPECT_EQ(evaluate(s, 831), 2);
  EXPECT_EQ(evaluate(s, 830), 2);
}

TEST(Evaluate, InfiniteSigmoidsAreBlackAndWhite) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(evaluate(SigmoidSpectrum{0, 0, infinity}, 500), 1);
  EXPECT_EQ(evaluate(SigmoidSpectrum{0, 0, -infinity}, 500), 0);
  EXPECT_DOUBLE_EQ(evaluate(SigmoidSpectrum{0, 0, 1}, 500), 0.5 + 0.5 / std::sqrt(2.0));
}

TEST(Constancy, FollowsTheKind) {
  EXPECT_TRUE(is_constant(ConstantSpectrum{2}));
  EXPECT_TRUE(is_constant(SigmoidSpectrum{0, 0, 3}));
  EXPECT_FALSE(is_constant(SigmoidSpectrum{1e-5f, 0, 3}));
  EXPECT_FALSE(is_constant(RgbIlluminantSpectrum{{0, 0, 0}, 1}));  // D65 is not flat
  EXPECT_FALSE(is_constant(bk7()));
  EXPECT_FALSE(is_constant(*named_spectrum("stdillum-A")));
}

TEST(Scaled, KeepsTheKindAndScalesTheValues) {
  EXPECT_EQ(scaled(ConstantSpectrum{2}, 3), Spectrum{ConstantSpectrum{6}});
  EXPECT_EQ(scaled(emission_from_rgb({1, 2, 3}), 0.5), Spectrum{emission_from_rgb({.5, 1, 1.5})});
  EXPECT_EQ(scaled(unbounded_from_rgb({1, 2, 3}), 0.5), Spectrum{unbounded_from_rgb({.5, 1, 1.5})});
  EXPECT_EQ(scaled(BlackbodySpectrum{5000, 2}, 3), (Spectrum{BlackbodySpectrum{5000, 6}}));
  EXPECT_NEAR(luminance(BlackbodySpectrum{5000, 2}), 2, 1e-6);
  EXPECT_EQ(scaled(SigmoidSpectrum{0, 0, 0}, 3), Spectrum{ConstantSpectrum{1.5f}});
  const Spectrum sigmoid = SigmoidSpectrum{1e-5f, 0, -3};
  for (const double lambda : {360.0, 555.0, 830.0})
    EXPECT_NEAR(evaluate(scaled(sigmoid, 7), lambda), 7 * evaluate(sigmoid, lambda), 1e-6);
  EXPECT_EQ(scaled(sigmoid, 1), sigmoid);
}

TEST(Luminance, IsTheMeanOfAConstant) { EXPECT_NEAR(luminance(ConstantSpectrum{3}), 3, 3e-6); }

TEST(Blackbody, PeaksWhereWienSays) {
  const TabulatedSpectrum s = blackbody(2897.771955e3 / 500);  // peak at 500 nm
  EXPECT_EQ(s.values[500 - 360], 1.0f);
  for (const float v : s.values) EXPECT_LE(v, 1.0f);
  EXPECT_LT(s.values[490 - 360], 1.0f);
  EXPECT_LT(s.values[510 - 360], 1.0f);
}

TEST(Blackbody, HasPlanckChromaticity) {
  const XYZ w = to_xyz(blackbody(6500));  // the Planckian locus: x = 0.3135, y = 0.3237
  EXPECT_NEAR(w.x / (w.x + w.y + w.z), 0.3135, 1e-4);
  EXPECT_NEAR(w.y / (w.x + w.y + w.z), 0.3237, 1e-4);
}

TEST(Blackbody, ColdOnesAreDarkAndWrongOnesErrors) {
  for (const float v : blackbody(1).values) EXPECT_EQ(v, 0.0f);
  EXPECT_THROW(blackbody(0), Error);
  EXPECT_THROW(blackbody(-5), Error);
  EXPECT_THROW(blackbody(nan), Error);
}

// n_d and V_d = (n_d − 1)/(n_F − n_C) of the catalogue identify the glass.
TEST(Glass, HasTheIndexAndAbbeNumberOfTheCatalogue) {
  struct Glass {
    const char* name;
    double n_d, v_d;
  };
  for (const Glass& g : {Glass{"bk7", 1.5168, 64.17}, Glass{"glass-BK7", 1.5168, 64.17},
                         Glass{"glass-BAF10", 1.67003, 47.11}, Glass{"glass-FK51A", 1.48656, 84.47},
                         Glass{"glass-LASF9", 1.85025, 32.17}, Glass{"glass-F5", 1.67270, 32.21},
                         Glass{"glass-F10", 1.72825, 28.41}, Glass{"glass-F11", 1.78472, 25.76}}) {
    const Spectrum s = *named_spectrum(g.name);
    const double d = evaluate(s, 587.5618), f = evaluate(s, 486.1327), c = evaluate(s, 656.2725);
    EXPECT_NEAR(d, g.n_d, 1e-5) << g.name;
    EXPECT_NEAR((d - 1) / (f - c), g.v_d, 0.01) << g.name;
  }
}

TEST(Named, UnknownNamesAreEmpty) { EXPECT_FALSE(named_spectrum("metal-Unobtainium").has_value()); }

}  // namespace
}  // namespace vitrail::spectrum_test
