// SPDX-License-Identifier: Apache-2.0
// Switchable glazing.
#include "glazing/states.h"

#include <gtest/gtest.h>

#include <cmath>

#include "glazing/band_spectrum.h"
#include "glazing/evaluation.h"
#include "glazing/system_file.h"
#include "scene/system/diagnostics.h"
#include "tests/glazing/glazing_files.h"

namespace vitrail::test::states_test {
namespace {

PaneValues average_of(const OpticalRows& rows, const char* method) {
  SystemSpectrum spectrum;
  for (const OpticalRow& row : rows) {
    spectrum.nm.push_back(row.nm);
    spectrum.values.push_back(row.at);
  }
  return average(spectrum, *find_method(nfrc_2003(), method));
}

TEST(States, AbsorbancesAreLinearBetween) {
  const std::vector<StateRows> states{{0, {{500, {0.8, 0.1, 0.1}}}}, {1, {{500, {0.05, 0.06, 0.08}}}}};
  EXPECT_EQ(value_at(rows_at(states, 0), 500).t, 0.8);
  EXPECT_NEAR(value_at(rows_at(states, 0.5), 500).t, std::sqrt(0.8 * 0.05), 1e-12);
  EXPECT_NEAR(value_at(rows_at(states, 0.5), 500).rf, 0.08, 1e-12);
  EXPECT_EQ(value_at(rows_at(states, 2), 500).t, 0.05);
}

// EnergyPlus' electrochromic data set: T_sol/T_vis, clear → dark.
TEST(States, ABandOfAbsorptionHasThePublishedAverages) {
  struct Published {
    double clear_solar, clear_visible, dark_solar, dark_visible, dark_reflectance;
  };
  for (const Published p :
       {Published{0.814, 0.847, 0.111, 0.128, 0.081}, {0.694, 0.818, 0.099, 0.155, 0.073}}) {
    std::vector<std::string> notes;
    const OpticalRows clear =
        band_spectrum({{p.clear_solar, 0.086, 0.086}, {p.clear_visible, 0.099, 0.099}}, notes);
    const auto dark = tinted(clear, {p.dark_visible, p.dark_solar, p.dark_reflectance});
    ASSERT_TRUE(dark);
    EXPECT_NEAR(average_of(*dark, "PHOTOPIC").t, p.dark_visible, 0.002 * p.dark_visible);
    EXPECT_NEAR(average_of(*dark, "SOLAR").t, p.dark_solar, 0.002 * p.dark_solar);
    EXPECT_NEAR(average_of(*dark, "PHOTOPIC").rf, p.dark_reflectance, 0.002 * p.dark_reflectance);
    EXPECT_GT(value_at(*dark, 450).t, 1.5 * value_at(*dark, 700).t);  // red goes first
  }
  EXPECT_FALSE(tinted({{500, {0.8, 0.1, 0.1}}}, {0.1, 0.7, {}}));
  EXPECT_TRUE(tinted({{500, {0.8, 0, 0.1}}}, {0.1, 0.08, {}}));
  EXPECT_FALSE(tinted({{500, {0.8, 0, 0.1}}}, {0.1, 0.08, 0.05}));  // nothing to scale
}

// Whatever T_sol goes with T_vis, there is a spectrum, and the ends of the range are where it ends.
TEST(States, EveryPairOfAveragesWithinTheRangeHasASpectrum) {
  std::vector<std::string> notes;
  const OpticalRows clear = band_spectrum({{0.399, 0.086, 0.086}, {0.624, 0.099, 0.099}}, notes);
  for (const double visible : {0.5, 0.1, 0.01}) {
    const auto range = solar_range(clear, visible);
    ASSERT_TRUE(range);
    fmt::print("T_vis {}: T_sol from {:.4g} to {:.4g}\n", visible, range->least, range->greatest);
    EXPECT_LT(range->least, 0.42 * visible);
    EXPECT_GT(range->least, 0.1 * visible);
    EXPECT_GT(range->greatest, 0.6 * visible);
    for (const double part : {0.001, 0.1, 0.3, 0.5, 0.7, 0.9, 0.999}) {
      const double solar = range->least + part * (range->greatest - range->least);
      const auto dark = tinted(clear, {visible, solar, {}});
      ASSERT_TRUE(dark) << visible << ' ' << solar;
      EXPECT_NEAR(average_of(*dark, "PHOTOPIC").t, visible, 0.002 * visible) << solar;
      EXPECT_NEAR(average_of(*dark, "SOLAR").t, solar, 0.002 * solar) << visible;
      for (const OpticalRow& row : *dark) EXPECT_LE(row.at.t, value_at(clear, row.nm).t);
    }
    EXPECT_FALSE(tinted(clear, {visible, 0.99 * range->least, {}}));
    EXPECT_FALSE(tinted(clear, {visible, 1.01 * range->greatest, {}}));
  }
  EXPECT_FALSE(solar_range(clear, 0.7));
  EXPECT_FALSE(solar_range(clear, 0));
}

// Against Euler's method in small steps; half-lives; the equilibrium stands still.
TEST(States, PhotochromicGlassFollowsItsEquation) {
  const Photochromic p{2e-4, 1e-3, 60e3};
  double s = 0;
  for (int i = 0; i < 60000; ++i) s += 1e-2 * (p.k_d_m2_per_j * 30 * (1 - s) - fading_per_s(p, 30) * s);
  EXPECT_NEAR(photochromic_state(p, 0, 30, 30, 600), s, 1e-5);
  const double end = photochromic_equilibrium(p, 30, 30);
  EXPECT_NEAR(photochromic_state(p, end, 30, 30, 1e4), end, 1e-12);
  EXPECT_NEAR(photochromic_state(p, 0.8, 0, 20, std::log(2) / p.k_f_per_s), 0.4, 1e-12);
  // In two steps as in one.
  EXPECT_NEAR(photochromic_state(p, photochromic_state(p, 0.1, 30, 30, 70), 30, 30, 130),
              photochromic_state(p, 0.1, 30, 30, 200), 1e-12);
  // Organic dyes fade 2.7–5.4 times more slowly at 6 °C than at 21 °C: 60 kJ/mol is in between.
  const double slower = fading_per_s(p, 21) / fading_per_s(p, 6);
  EXPECT_TRUE(slower > 2.7 && slower < 5.4) << slower;
}

TEST(States, ComeFromASystemFile) {
  const TemporaryDirectory directory;
  write_text(directory / "pane.dat", optics_text);
  write_text(directory / "windows.idf", idf_text);
  const auto visible_t = [&](const std::string& layer, double state, bool by_temperature) {
    write_text(directory / "unit.json", "{\"layers\": [" + layer + "]}");
    GlazingSystem system = read_system({(directory / "unit.json").string()}).system;
    if (state >= 0) {
      EXPECT_TRUE(set(system, by_temperature ? Quantity::temperature : Quantity::state, state));
    }
    return system_values(system, 550, 1, Polarisation::mixed_at_panes).t;
  };
  const std::string tint = R"({"states": [{"state": 0, "pane": "pane.dat"},
    {"state": 1, "tinted": {"visible_transmittance": 0.1, "solar_transmittance": 0.08}}])";
  const double clear = visible_t(tint + "}", 0, false), dark = visible_t(tint + "}", 1, false);
  EXPECT_NEAR(visible_t(tint + "}", 0.5, false), std::sqrt(clear * dark), 1e-9);
  EXPECT_NEAR(visible_t(tint + ", \"state\": 0.5}", -1, false), std::sqrt(clear * dark), 1e-9);
  EXPECT_NEAR(visible_t(tint + R"(, "photochromic": {"k_d_m2_per_j": 1, "k_f_per_s": 1, "uv_w_per_m2": 1}})",
                        -1, false),
              std::sqrt(clear * dark), 1e-9);
  // No light and no time: it stands where the file says. Light brings it to its equilibrium.
  const std::string photochromic =
      tint + R"(, "state": 0.5, "photochromic": {"k_d_m2_per_j": 1, "k_f_per_s": 1}})";
  EXPECT_NEAR(visible_t(photochromic, -1, false), std::sqrt(clear * dark), 1e-9);
  GlazingSystem lit = read_system({(directory / "unit.json").string()}).system;
  EXPECT_TRUE(set(lit, Quantity::uv, 3));
  EXPECT_NEAR(*value_of(lit, Quantity::state), 0.75, 1e-12);
  EXPECT_TRUE(set(lit, Quantity::temperature, 50));
  EXPECT_NEAR(*value_of(lit, Quantity::state), 0.75, 1e-12) << "warmth speeds up what has an activation";
  const std::string warm = R"({"pane": "windows.idf", "product": "Warm"})";
  EXPECT_NEAR(visible_t(warm, 25, true), visible_t(R"({"pane": "pane.dat"})", -1, false), 1e-9);
  EXPECT_NEAR(visible_t(warm, 60, true), 0.128, 1e-9);
  EXPECT_THROW(
      visible_t(R"({"states": [{"state": 1, "pane": "pane.dat"}, {"state": 0, "pane": "pane.dat"}]})", -1,
                false),
      Error);
}

// A state is made of all wavelengths even where the clear one has few.
TEST(States, SayWhereTheyAreHeld) {
  const TemporaryDirectory directory;
  write_text(directory / "pane.txt", "wavelength_nm T R\n400 0.8 0.1\n800 0.8 0.1\n");
  write_text(directory / "unit.json", R"({"layers": [{"state": 1, "states": [{"state": 0, "pane": "pane.txt"},
    {"state": 1, "tinted": {"visible_transmittance": 0.1, "solar_transmittance": 0.08}}]}]})");
  const GlazingSystem system = read_system({(directory / "unit.json").string()}).system;
  EXPECT_EQ(held_note(system, 300, 2500), "values are held beyond 400 to 800 nm");
  EXPECT_EQ(held_note(system, 400, 800), "");
}

}  // namespace
}  // namespace vitrail::test::states_test
