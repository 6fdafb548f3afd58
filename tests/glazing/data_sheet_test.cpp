// SPDX-License-Identifier: Apache-2.0
// What panes absorb, Europe's weights, colour rendering, and sheets of several states.
#include "glazing/data_sheet.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <sstream>

#include "glazing/color_rendering.h"
#include "glazing/energyplus_text.h"
#include "glazing/product.h"
#include "glazing/system_file.h"
#include "scene/system/diagnostics.h"
#include "tests/glazing/glazing_files.h"

namespace vitrail::test::data_sheet_test {
namespace {

GlazingLayer flat(PaneValues values) {
  return {.name = "flat", .pane = MeasuredPane{{{300, values}, {2500, values}}, PaneKind::coated}};
}

// Light goes to and fro between two panes: the sum over reflections by hand, at 30 terms.
TEST(Absorbed, IsTheSumOverReflections) {
  const PaneValues a{0.6, 0.1, 0.3}, b{0.5, 0.2, 0.1};
  const std::vector<double> shares =
      absorbed_shares({"", {flat(a), flat(b)}}, 500, 1, Polarisation::mixed_at_panes);
  double first = 1 - a.t - a.rf, second = 0, on_second = a.t;
  for (int pass = 0; pass < 30; ++pass) {
    second += on_second * (1 - b.t - b.rf);
    const double back = on_second * b.rf;
    first += back * (1 - a.t - a.rb);
    on_second = back * a.rb;
  }
  EXPECT_NEAR(shares.at(0), first, 1e-12);
  EXPECT_NEAR(shares.at(1), second, 1e-12);
}

TEST(Absorbed, AndWhatLeavesAreAll) {
  GlazingLayer clear = flat({0.7, 0.08, 0.07}), coated = flat({0.4, 0.3, 0.45});
  std::get<MeasuredPane>(clear.pane).kind = PaneKind::clear;
  coated.flipped = true;
  const GlazingSystem system{"", {clear, coated, clear}};
  for (const Polarisation polarisation : {Polarisation::mixed_at_panes, Polarisation::apart})
    for (const double cosine : {1.0, 0.5, 0.1, 0.0}) {
      const PaneValues whole = system_values(system, 500, cosine, polarisation);
      double sum = whole.t + whole.rf;
      for (const double share : absorbed_shares(system, 500, cosine, polarisation)) sum += share;
      EXPECT_NEAR(sum, 1, 1e-12) << cosine;
    }
}

// All of the light to 785 nm and none from 795 nm on. Sums over the printed tables: EN 410:1998, table 2, to
// 780 nm; ISO 9050:1990, table 3, to 750 nm; ISO 9845-1, column 5, by trapezoids.
TEST(EuropeanStandards, WeighTheSunByTheirOwnTables) {
  const SystemSpectrum edge{{300, 785, 795, 2500}, {{1, 0, 0}, {1, 0, 0}, {}, {}}};
  EXPECT_NEAR(average(edge, *find_method(en_410(), "SOLAR")).t, 0.6042, 1e-6);
  EXPECT_NEAR(average(edge, *find_method(iso_9050_1990(), "SOLAR")).t, 0.562844, 1e-6);
  EXPECT_NEAR(average(edge, *find_method(iso_9050_2003(), "SOLAR")).t, 0.581701, 1e-6);
  const SystemSpectrum violet{{280, 338, 342, 400}, {{1, 0, 0}, {1, 0, 0}, {}, {}}};
  EXPECT_NEAR(average(violet, *find_method(en_410(), "TUV")).t, 0.35265, 1e-6);
}

// Made with colour-science 0.4.7's tables and numpy, by matrices: D65 through a ramp, and through an edge.
TEST(ColorRendering, IsThatOfCie13_3) {
  EXPECT_NEAR(*color_rendering_index({{380, 780}, {{0.4, 0, 0}, {0.4, 0, 0}}}), 100, 1e-9);
  EXPECT_NEAR(*color_rendering_index({{380, 780}, {{0.2, 0, 0}, {0.8, 0, 0}}}), 81.6187, 0.002);
  EXPECT_NEAR(
      *color_rendering_index({{380, 599.9, 600, 780}, {{0.5, 0, 0}, {0.5, 0, 0}, {0.2, 0, 0}, {0.2, 0, 0}}}),
      62.3757, 0.002);
  EXPECT_FALSE(color_rendering_index({{380, 780}, {{}, {}}}));
}

// colour-science 0.4.7, colour_fidelity_index_ANSIIESTM3018 of D65 through the same spectra. Its colour
// temperatures are by Ohno's method. R_f 100.0004 of nothing is its rounding and ours.
TEST(ColorFidelity, IsThatOfTm30) {
  const auto near = [](const SystemSpectrum& spectrum, double fidelity, double gamut, double kelvin) {
    const auto made = color_fidelity(spectrum);
    ASSERT_TRUE(made);
    EXPECT_NEAR(made->fidelity, fidelity, 0.02);
    EXPECT_NEAR(made->gamut, gamut, 0.02);
    EXPECT_NEAR(made->kelvin, kelvin, 1e-3 * kelvin);
  };
  near({{380, 780}, {{0.4, 0, 0}, {0.4, 0, 0}}}, 100.0004, 100.0000, 6502.97);
  near({{380, 780}, {{0.2, 0, 0}, {0.8, 0, 0}}}, 99.0143, 99.4725, 4508.18);
  near({{380, 780}, {{0.8, 0, 0}, {0.1, 0, 0}}}, 95.3395, 96.2545, 10874.55);
  near({{380, 599.9, 600, 780}, {{0.5, 0, 0}, {0.5, 0, 0}, {0.2, 0, 0}, {0.2, 0, 0}}}, 80.6261, 83.9574,
       9138.95);
  EXPECT_FALSE(color_fidelity({{380, 780}, {{}, {}}}));
}

TEST(DataSheet, HasEachStateBesideTheOthers) {
  const TemporaryDirectory directory;
  write_text(directory / "pane.dat", optics_text);
  write_text(directory / "unit.json", R"({"layers": [
    {"states": [{"state": 0, "pane": "pane.dat"}, {"state": 1, "tinted": {"visible_transmittance": 0.1,
      "solar_transmittance": 0.1}}], "heat": {"emissivity_front": 0.84, "emissivity_back": 0.1}},
    {"gap_mm": 16, "gas": {"argon": 0.9, "air": 0.1}},
    {"pane": "pane.dat", "heat": {"emissivity_front": 0.84, "emissivity_back": 0.84}}]})");
  GlazingSystem system = read_system({(directory / "unit.json").string()}).system;
  EXPECT_EQ(system.layers[0].gas_behind, (GasMixture{{Gas::argon, 0.9}, {Gas::air, 0.1}}));
  set(system, Quantity::state, 0.25);
  const DataSheet sheet = data_sheet(system, Polarisation::mixed_at_panes);
  EXPECT_EQ(sheet.why_no_heat, "");
  ASSERT_EQ(sheet.states.size(), 3u);  // the two of the file, and where it stands
  EXPECT_EQ(sheet.states[0].name, "state 0");
  EXPECT_EQ(sheet.states[1].name, "state 0.25");
  EXPECT_EQ(sheet.states[2].name, "state 1");
  for (std::size_t i = 1; i < 3; ++i) {
    EXPECT_LT(*sheet.states[i].angles[0].shgc, *sheet.states[i - 1].angles[0].shgc);
    EXPECT_LT(*sheet.states[i].heat->g_en_410, *sheet.states[i - 1].heat->g_en_410);
    EXPECT_GT(sheet.states[i].heat->summer.kelvin[0][1], sheet.states[i - 1].heat->summer.kelvin[0][1]);
    EXPECT_EQ(sheet.states[i].heat->u_nfrc, sheet.states[0].heat->u_nfrc);  // the tint does not insulate
  }
  // EN 673 and EN 410 know no pane that infrared passes.
  system.layers[1].heat.infrared_t = 0.1;
  const DataSheet film = data_sheet(system, Polarisation::mixed_at_panes);
  EXPECT_TRUE(film.states[0].heat);
  EXPECT_FALSE(film.states[0].heat->u_en_673);
  EXPECT_FALSE(film.states[0].heat->g_en_410);
  for (const DataSheetState& state : sheet.states) {
    ASSERT_EQ(state.angles.size(), 11u);
    EXPECT_NEAR(*state.angles[9].shgc, 0, 1e-9);  // 90°
    EXPECT_FALSE(state.angles.back().theta_deg);
  }
}

// Its IDF, read by our own reader: the same panes, those of each state, and those turned round.
TEST(DataSheet, EnergyPlusTextIsReadBack) {
  const TemporaryDirectory directory;
  write_text(directory / "pane.dat", optics_text);
  write_text(directory / "unit.json", R"({"name": "unit, 2; !new", "layers": [
    {"states": [{"state": 0, "pane": "pane.dat"}, {"state": 1, "tinted": {"visible_transmittance": 0.1,
      "solar_transmittance": 0.1}}], "heat": {"emissivity_front": 0.84, "emissivity_back": 0.1}},
    {"gap_mm": 16, "gas": {"argon": 0.9, "air": 0.1}},
    {"pane": "pane.dat", "flipped": true, "heat": {"emissivity_front": 0.2, "emissivity_back": 0.84}}]})");
  const GlazingSystem system = read_system({(directory / "unit.json").string()}).system;
  const std::string text = energyplus_text(system);
  EXPECT_THAT(text,
              ::testing::HasSubstr("WindowMaterial:GasMixture,\n  unit  2   new gap 1, 0.016, 2, Argon, 0.9, "
                                   "Air, 0.1;"));
  EXPECT_THAT(
      text, ::testing::HasSubstr("Construction,\n  unit  2   new state 1,\n  unit  2   new state 1 pane 1,\n"
                                 "  unit  2   new gap 1,\n  unit  2   new pane 2;"));
  const auto idf = write_text(directory / "out.idf", text);
  const auto same_values = [&](const char* name, const OpticalRows& rows, bool flipped) {
    const Product product = read_product(idf, name);
    ASSERT_GE(product.rows.size(), 3u) << name;
    for (const OpticalRow& row : product.rows) {  // those of a state have the wavelengths of all
      const PaneValues expected = value_at(rows, row.nm);
      EXPECT_NEAR(row.at.t, expected.t, 3e-6) << name << " at " << row.nm;
      EXPECT_NEAR(row.at.rf, flipped ? expected.rb : expected.rf, 3e-6) << name << " at " << row.nm;
    }
  };
  const auto& states = system.layers[0].states;
  same_values("unit  2   new state 0 pane 1", states[0].rows, false);
  same_values("unit  2   new state 1 pane 1", states[1].rows, false);
  same_values("unit  2   new pane 2", std::get<MeasuredPane>(system.layers[1].pane).rows, true);
  EXPECT_EQ(read_product(idf, "unit  2   new pane 2").heat, (PaneHeat{1, 0.84, 0.2, 0}));
  EXPECT_EQ(read_product(idf, "unit  2   new pane 2").thickness_mm, 6);
}

// EnergyPlus refuses wavelengths that do not ascend as printed, more than 800, and T + R above 1. Returns how
// many there are.
int checked_wavelengths(OpticalRows rows) {
  GlazingLayer layer{
      .name = "pane", .pane = MeasuredPane{std::move(rows), PaneKind::coated}, .thickness_mm = 6};
  layer.heat.emissivity_front = layer.heat.emissivity_back = 0.84;
  std::istringstream lines(energyplus_text({"", {layer}}));
  double last_um = 0;
  int count = 0;
  for (std::string line; std::getline(lines, line);) {
    double um = 0, t = 0, rf = 0, rb = 0;
    if (std::sscanf(line.c_str(), " %lf, %lf, %lf, %lf", &um, &t, &rf, &rb) != 4) continue;
    EXPECT_GT(um, last_um);
    EXPECT_LE(t + rf, 1 + 1e-12);
    last_um = um;
    ++count;
  }
  return count;
}

TEST(DataSheet, EnergyPlusTextKeepsItsLimits) {
  const PaneValues values{0.1234565, 0.8765435, 0.2};
  OpticalRows rows;
  for (int i = 0; i < 2000; ++i) rows.push_back({300 + 1.1 * i, values});
  const int many = checked_wavelengths(rows);
  EXPECT_GT(many, 400);
  EXPECT_LE(many, 800);
  EXPECT_EQ(checked_wavelengths({{300, values}, {300.0000001, values}, {2500, values}}), 2);
}

TEST(DataSheet, SaysWhyThereIsNoHeat) {
  const DataSheet sheet = data_sheet({"", {flat({0.6, 0.1, 0.3})}}, Polarisation::mixed_at_panes);
  EXPECT_THAT(sheet.why_no_heat, ::testing::HasSubstr("does not say its thickness"));
  EXPECT_FALSE(sheet.states.at(0).heat);
  EXPECT_NEAR(sheet.states.at(0).standards.at(1).solar.t, 0.6, 1e-12);
}

// Without --gap or a file that says gaps, whatever gases are called.
TEST(DataSheet, RefusesUnknownGases) {
  const TemporaryDirectory directory;
  write_text(directory / "pane.dat", optics_text);
  for (const char* gas : {"\"helium\"", "{\"argon\": 0.9}", "3", "{\"argon\": 0.9, \"air\": 0.2}"}) {
    write_text(
        directory / "unit.json",
        fmt::format(
            R"({{"layers": [{{"pane": "pane.dat"}}, {{"gap_mm": 16, "gas": {}}}, {{"pane": "pane.dat"}}]}})",
            gas));
    EXPECT_THROW(read_system({(directory / "unit.json").string()}), Error) << gas;
  }
}

}  // namespace
}  // namespace vitrail::test::data_sheet_test
