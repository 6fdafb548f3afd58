// SPDX-License-Identifier: Apache-2.0
// Heat through panes, against WinCalc's expected results and EN 673 by hand.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "glazing/en_673.h"
#include "glazing/gap_convection.h"
#include "glazing/heat_balance.h"
#include "scene/system/diagnostics.h"

namespace vitrail::test::heat_test {
namespace {

// T, Rf and Rb do not matter here: what panes absorb is given.
GlazingLayer pane(double thickness_mm, double emissivity_front, double emissivity_back,
                  double gap_behind_mm = 0, GasMixture gas = {}) {
  GlazingLayer layer{.name = "pane", .pane = MeasuredPane{{{550, {0.9, 0.05, 0.05}}}, PaneKind::clear}};
  layer.thickness_mm = thickness_mm;
  layer.heat.emissivity_front = emissivity_front;
  layer.heat.emissivity_back = emissivity_back;
  layer.gap_behind_mm = gap_behind_mm;
  layer.gas_behind = std::move(gas);
  return layer;
}

// WinCalc (LBNL), test/expected_results: 2_layers/nfrc_102_air_nfrc_102 and low_e_nfrc_2191_air_nfrc_102,
// full spectrum, θ = 0°; emissivities as its "thermal ir layer" files have them.
GlazingSystem two_clear() { return {"", {pane(3.048, 0.84, 0.84, 12.7), pane(3.048, 0.84, 0.84)}}; }
GlazingSystem low_e() { return {"", {pane(3, 0.84479204, 0.06850713, 12.7), pane(3.048, 0.84, 0.84)}}; }
constexpr double wincalc = 5e-4;  // largest difference here

TEST(Heat, UValuesAreThoseOfWinCalc) {
  EXPECT_NEAR(u_value(two_clear(), nfrc_winter), 2.729619, wincalc);
  EXPECT_NEAR(u_value(low_e(), nfrc_winter), 1.736769, wincalc);
  EXPECT_NEAR(u_value({"", {pane(3.048, 0.84, 0.84)}}, nfrc_winter), 5.912514, wincalc);
  EXPECT_NEAR(u_value({"", {pane(5.66, 0.8402628, 0.0396826)}}, nfrc_winter), 3.240993, wincalc);
  EXPECT_NEAR(u_value(two_clear(), nfrc_summer), 2.866261, wincalc);
  EXPECT_NEAR(u_value(low_e(), nfrc_summer), 1.656159, wincalc);
}

TEST(Heat, AFlippedPaneExchangesItsEmissivities) {
  GlazingSystem system = low_e();
  system.layers[0].flipped = true;
  EXPECT_NEAR(u_value(system, nfrc_winter), 2.706049, wincalc);  // WinCalc: flipped_low_e
}

TEST(Heat, TemperaturesAreThoseOfWinCalc) {
  const HeatBalance night = heat_balance(two_clear(), nfrc_winter, {0, 0});
  const double winter[]{258.79164, 259.11612, 279.32398, 279.64846};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(night.kelvin[i / 2][i % 2], winter[i], 0.005) << i;
  // Absorptances of the same system, by the test of the corpus: 0.0965 and 0.0723.
  const HeatBalance day = heat_balance(two_clear(), nfrc_summer, {783 * 0.09650, 783 * 0.07226});
  const double summer[]{308.18549, 308.25997, 306.31811, 306.19123};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(day.kelvin[i / 2][i % 2], summer[i], 0.02) << i;
}

// pywincalc 3.3.1, GlazingSystem(…).u() with nfrc_u_environments(): CLEAR_6 or CLEAR_3 behind each other.
TEST(Heat, GasesAndMixturesAreThoseOfWinCalc) {
  const auto clear_6 = [](GasMixture gas) {
    return GlazingSystem{"", {pane(5.715, 0.84, 0.84, 12.7, std::move(gas)), pane(5.715, 0.84, 0.84)}};
  };
  EXPECT_NEAR(u_value(clear_6({}), nfrc_winter), 2.688767, wincalc);
  EXPECT_NEAR(u_value(clear_6({{Gas::argon, 1}}), nfrc_winter), 2.530941, wincalc);
  GlazingSystem mixed = low_e();
  mixed.layers[0].gap_behind_mm = 16;
  mixed.layers[0].gas_behind = {{Gas::argon, 0.9}, {Gas::air, 0.1}};
  EXPECT_NEAR(u_value(mixed, nfrc_winter), 1.527781, wincalc);
  mixed.layers[0].gap_behind_mm = 10;
  mixed.layers[0].gas_behind = {{Gas::krypton, 0.8}, {Gas::xenon, 0.2}};
  EXPECT_NEAR(u_value(mixed, nfrc_winter), 1.308326, wincalc);
  GlazingSystem wide = two_clear();
  wide.layers[0].gap_behind_mm = 50;  // where the height of the gap matters
  EXPECT_NEAR(u_value(wide, nfrc_winter), 2.800594, wincalc);
}

TEST(Heat, ThreePanesAreThoseOfWinCalc) {
  GlazingSystem triple{"",
                       {pane(3, 0.84479204, 0.06850713, 12.7, {{Gas::argon, 0.9}, {Gas::air, 0.1}}),
                        pane(3.048, 0.84, 0.84, 12.7), pane(3.048, 0.84, 0.84)}};
  EXPECT_NEAR(u_value(triple, nfrc_winter), 1.124416, wincalc);
}

// A film that infrared passes: with e + t the same towards a black sky, what it lets through and what it
// takes up add to the same exchange between black surroundings, so its flow is no less than the opaque
// film's.
TEST(Heat, InfraredPassesFilms) {
  GlazingSystem film{"", {pane(0.1, 0.5, 0.5)}};
  const double opaque = u_value(film, nfrc_winter);
  film.layers[0].heat.infrared_t = 0.3;
  const double more = u_value(film, nfrc_winter) - opaque;
  // σ(Tᵢ⁴ − Tₒ⁴)·0.3 ÷ 39 K
  EXPECT_NEAR(more, 0.3 * 5.670374e-8 * (std::pow(294.15, 4) - std::pow(255.15, 4)) / 39, 1e-3);
}

// 4-12-4 of air, 4 mm, by hand: Gr 4398, Pr 0.7112, Nu 1; h_r 3.700, h_g 2.080; 1/U = 0.04 + 0.12987 + 0.008
// + 0.17302.
TEST(Heat, En673IsThatByHand) {
  GlazingSystem clear{"", {pane(4, 0.837, 0.837, 12), pane(4, 0.837, 0.837)}};
  EXPECT_NEAR(en_673_u_value(clear), 2.850, 0.001);
  // 4-16-4, 90 % argon, ε 0.03: makers say 1.1. By hand: λ 0.017652, µ 2.1237e-5, c 567.9, ρ 1.6523; Gr·Pr
  // 12892·0.68324, Nu 1.1044; h_g 1.2185, h_r 0.1533; 1/U = 0.04 + 0.12987 + 0.008 + 0.72899.
  GlazingSystem coated{
      "", {pane(4, 0.837, 0.03, 16, {{Gas::argon, 0.9}, {Gas::air, 0.1}}), pane(4, 0.837, 0.837)}};
  EXPECT_NEAR(en_673_u_value(coated), 1.1027, 0.0005);
  // One pane: 1 ÷ (0.04 + 0.004 + 0.12987).
  EXPECT_NEAR(en_673_u_value({"", {pane(4, 0.837, 0.837)}}), 5.7514, 0.0005);
}

// Two gaps that are alike share the 15 K: 7.5 K each.
TEST(Heat, En673SharesTheDifferenceAmongGaps) {
  const GasMixture argon{{Gas::argon, 1}};
  GlazingSystem triple{
      "", {pane(4, 0.837, 0.837, 20, argon), pane(4, 0.837, 0.837, 20, argon), pane(4, 0.837, 0.837)}};
  const double radiation = 4 * 5.670374e-8 * std::pow(283, 3) / (2 / 0.837 - 1);
  const double gap = 1 / (radiation + en_673_gap(argon, 0.020, 7.5));
  const Resistances r = en_673_resistances(triple);
  for (const double each : r.gaps) EXPECT_NEAR(each, gap, 1e-6);
  EXPECT_GT(en_673_gap(argon, 0.020, 15), 1.1 * en_673_gap(argon, 0.020, 7.5));
}

// q_i of a single pane, 8 ÷ (8 + 23) of what it absorbs; and of two, by EN 410's formula.
TEST(Heat, SolarFactorIsThatOfEn410) {
  EXPECT_NEAR(en_410_solar_factor({"", {pane(4, 0.837, 0.837)}}, 0.5, {0.31}), 0.5 + 0.31 * 8 / 31, 1e-12);
  GlazingSystem two{"", {pane(4, 0.837, 0.837, 12), pane(4, 0.837, 0.837)}};
  const double conductance = 1 / (0.008 + en_673_resistances(two).gaps[0]);
  EXPECT_NEAR(en_410_solar_factor(two, 0.5, {0.2, 0.1}),
              0.5 + (0.3 / 23 + 0.1 / conductance) / (1 / 8.0 + 1 / 23.0 + 1 / conductance), 1e-12);
}

// Mirrors, black films that infrared passes, gaps of a hair and of a metre, metal and foam, one to twelve
// panes, in the dark and in the sun: a balance is found, no surface is colder than both sides, nor warmer
// than both in the dark, and what goes in comes out.
TEST(Heat, FindsABalanceOfExtremes) {
  int count = 0;
  for (const double emissivity : {0.001, 0.03, 0.84, 1.0})
    for (const double passed : {0.0, 0.6})
      for (const double gap_mm : {0.1, 12.0, 1000.0})
        for (const double conductivity : {0.02, 1.0, 200.0})
          for (const std::size_t panes : {1u, 2u, 5u, 12u})
            for (const bool sun : {false, true}) {
              if (emissivity + passed > 1) continue;
              GlazingLayer layer = pane(6, emissivity, 0.3, gap_mm, {{Gas::krypton, 0.5}, {Gas::argon, 0.5}});
              layer.heat.conductivity_w_mk = conductivity;
              layer.heat.infrared_t = passed;
              const GlazingSystem system{"", std::vector<GlazingLayer>(panes, layer)};
              const HeatEnvironment& environment = sun ? nfrc_summer : nfrc_winter;
              const HeatBalance balance =
                  heat_balance(system, environment,
                               std::vector<double>(panes, sun ? 783.0 / static_cast<double>(panes) : 0));
              for (const auto& surfaces : balance.kelvin)
                for (const double kelvin : surfaces) {
                  EXPECT_GE(kelvin, std::min(environment.outside_k, environment.inside_k) - 1e-6);
                  EXPECT_LE(kelvin, sun ? 1e4 : environment.inside_k + 1e-6);  // foam keeps its sun
                }
              EXPECT_TRUE(std::isfinite(balance.into_room_w_m2));
              if (passed == 0) {
                const double outer = balance.kelvin[0][0];
                const double out =
                    environment.outside_w_m2k * (outer - environment.outside_k) +
                    emissivity * stefan_boltzmann * (std::pow(outer, 4) - std::pow(environment.outside_k, 4));
                EXPECT_NEAR(out + balance.into_room_w_m2, sun ? 783 : 0, 1e-4);
              }
              ++count;
            }
  EXPECT_GT(count, 300);
}

// What is missing is named, not guessed.
TEST(Heat, SaysWhatIsMissing) {
  const auto refusal = [](const GlazingSystem& system) -> std::string {
    try {
      u_value(system, nfrc_winter);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  GlazingSystem system = two_clear();
  system.layers[0].gap_behind_mm = 0;
  EXPECT_THAT(refusal(system), ::testing::HasSubstr("pane 1 (\"pane\") has no gap behind it"));
  system = two_clear();
  system.layers[1].heat.emissivity_back.reset();
  EXPECT_THAT(refusal(system), ::testing::HasSubstr("pane 2 (\"pane\") does not say its emissivity"));
  system.layers[1].thickness_mm = 0;
  EXPECT_THAT(refusal(system), ::testing::HasSubstr("does not say its thickness"));
}

// Where numbers would end in infinities; nothing is reported then.
TEST(Heat, RefusesWhatNoWindowHas) {
  const auto refused = [](auto change) {
    GlazingSystem system = two_clear();
    change(system.layers[0]);
    EXPECT_THROW(u_value(system, nfrc_winter), Error);
    EXPECT_THROW(en_673_u_value(system), Error);
  };
  for (const double value : {1e-300, 1e300}) {
    refused([&](GlazingLayer& layer) { layer.thickness_mm = value; });
    refused([&](GlazingLayer& layer) { layer.gap_behind_mm = value; });
    refused([&](GlazingLayer& layer) { layer.heat.conductivity_w_mk = value; });
  }
  refused([](GlazingLayer& layer) { layer.heat.emissivity_front = 0; });
  refused([](GlazingLayer& layer) { layer.heat.infrared_t = 0.2; });  // and an emissivity of 0.84
}

TEST(Heat, GasesAreReadByName) {
  EXPECT_EQ(gas_mixture("Argon"), (GasMixture{{Gas::argon, 1}}));
  EXPECT_EQ(gas_mixture("argon=0.9,air=0.1"), (GasMixture{{Gas::argon, 0.9}, {Gas::air, 0.1}}));
  for (const char* wrong : {"", "helium", "argon=0.9", "argon=0.5,argon=0.5", "argon=1.1,air=-0.1", "air=x"})
    EXPECT_FALSE(gas_mixture(wrong)) << wrong;
}

}  // namespace
}  // namespace vitrail::test::heat_test
