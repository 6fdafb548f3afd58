// SPDX-License-Identifier: Apache-2.0
// Panes together.
#include "glazing/system.h"

#include <gtest/gtest.h>

#include <cmath>

#include "glazing/system_file.h"
#include "scene/system/diagnostics.h"
#include "tests/glazing/glazing_files.h"

namespace vitrail::test::system_test {
namespace {

GlazingLayer flat(PaneValues v, bool flipped = false) {
  return {"flat", MeasuredPane{{{500, v}}, PaneKind::coated}, flipped};
}

// The sum by walking: light up and down the gaps until nothing is left of it.
PaneValues walked(const std::vector<PaneValues>& panes) {
  const auto from = [&](bool front) {
    const std::size_t n = panes.size();
    std::vector<double> down(n + 1, 0.0), up(n + 1, 0.0);
    (front ? down[0] : up[n]) = 1;
    double through = 0, reflected = 0;
    for (int step = 0; step < 4000; ++step) {
      std::vector<double> d(n + 1, 0.0), u(n + 1, 0.0);
      for (std::size_t i = 0; i < n; ++i) {
        d[i + 1] += down[i] * panes[i].t + up[i + 1] * panes[i].rb;
        u[i] += down[i] * panes[i].rf + up[i + 1] * panes[i].t;
      }
      (front ? through : reflected) += d[n];
      (front ? reflected : through) += u[0];
      d[n] = u[0] = 0;
      down = d;
      up = u;
    }
    return std::pair{through, reflected};
  };
  return {from(true).first, from(true).second, from(false).second};
}

TEST(GlazingSystem, IsTheSumOfAllReflections) {
  const std::vector<PaneValues> panes{{0.6, 0.1, 0.3}, {0.5, 0.45, 0.2}, {0.7, 0.05, 0.25}, {0.2, 0.7, 0.6}};
  GlazingSystem system;
  for (const PaneValues& v : panes) system.layers.push_back(flat(v));
  const PaneValues sum = system_values(system, 500, 1, Polarisation::mixed_at_panes), w = walked(panes);
  EXPECT_NEAR(sum.t, w.t, 1e-12);
  EXPECT_NEAR(sum.rf, w.rf, 1e-12);
  EXPECT_NEAR(sum.rb, w.rb, 1e-12);
}

TEST(GlazingSystem, TurnedRoundHasItsSidesExchanged) {
  const PaneValues a{0.6, 0.1, 0.3}, b{0.5, 0.45, 0.2};
  for (const double cosine : {1.0, 0.5}) {
    const PaneValues there =
        system_values({"", {flat(a), flat(b)}}, 500, cosine, Polarisation::mixed_at_panes);
    const PaneValues back =
        system_values({"", {flat(b, true), flat(a, true)}}, 500, cosine, Polarisation::mixed_at_panes);
    EXPECT_NEAR(there.t, back.t, 1e-12);
    EXPECT_NEAR(there.rf, back.rb, 1e-12);
    EXPECT_NEAR(there.rb, back.rf, 1e-12);
  }
}

// Stokes 1862: m sheets of glass without absorption let 1/(1 + 2m·ρ/(1−ρ)) through, each polarisation for
// itself.
TEST(GlazingSystem, PileOfPlatesIsStokes) {
  const StackPane sheet{{{{{500, 1.5, 0}}, 4}}, {{}, {}}};
  GlazingSystem pile;
  for (int i = 0; i < 5; ++i) pile.layers.push_back({"", sheet});
  const double cosine = 0.5, inner = std::sqrt(1 - 0.75 / 2.25);
  const auto stokes = [](double r) { return 1 / (1 + 2 * 5 * r * r / (1 - r * r)); };
  const double s = (cosine - 1.5 * inner) / (cosine + 1.5 * inner),
               p = (1.5 * cosine - inner) / (1.5 * cosine + inner);
  EXPECT_NEAR(system_values(pile, 500, cosine, Polarisation::apart).t, (stokes(s) + stokes(p)) / 2, 1e-12);
  EXPECT_LT(system_values(pile, 500, cosine, Polarisation::mixed_at_panes).t,
            (stokes(s) + stokes(p)) / 2 - 0.01);
}

// Closed form of the mean over the hemisphere of one face's reflectance does not carry over to sheets; a
// table of a million angles does.
TEST(GlazingSystem, HemisphericalIsTheIntegral) {
  const GlazingSystem system{"",
                             {{"", StackPane{{{{{500, 1.52, 5e-7}}, 6}}, {{}, {}}}}, flat({0.6, 0.1, 0.3})}};
  PaneValues sum;
  constexpr int count = 20000;
  for (int i = 0; i < count; ++i) {
    const double cosine = (i + 0.5) / count;
    const PaneValues v = system_values(system, 500, cosine, Polarisation::apart);
    sum = {sum.t + 2 * cosine * v.t / count, sum.rf + 2 * cosine * v.rf / count,
           sum.rb + 2 * cosine * v.rb / count};
  }
  const PaneValues gauss =
      hemispherical_spectrum(system, {500}, Polarisation::apart, HemisphereRule::gauss).values[0];
  EXPECT_NEAR(gauss.t, sum.t, 1e-5);
  EXPECT_NEAR(gauss.rf, sum.rf, 1e-5);
  EXPECT_NEAR(gauss.rb, sum.rb, 1e-5);
}

TEST(GlazingSystem, ReadsItsFile) {
  const TemporaryDirectory directory;
  write_text(directory / "pane.dat", optics_text);
  write_text(directory / "n.txt", index_text);
  write_text(directory / "unit.json", R"({"name": "unit", "layers": [
    {"pane": "pane.dat", "flipped": true}, {"gap_mm": 16, "gas": "argon"},
    {"stack": [{"index": 2.0, "thickness_nm": 0.5}, {"pane": "pane.dat"}, {"index": "n.txt", "thickness_mm": 0.76},
               {"pane": "pane.dat", "thickness_mm": 4}]}]})");
  const ReadSystem read =
      read_system({(directory / "unit.json").string(), (directory / "pane.dat").string()});
  ASSERT_EQ(read.system.layers.size(), 3u);
  EXPECT_EQ(read.system.name, "unit");
  EXPECT_TRUE(read.system.layers[0].flipped);
  EXPECT_EQ(read.system.layers[0].gap_behind_mm, 16);
  const auto& stack = std::get<StackPane>(read.system.layers[1].pane);
  EXPECT_EQ(stack.slabs.size(), 3u);
  ASSERT_EQ(stack.films.size(), 4u);
  ASSERT_EQ(stack.films[0].size(), 1u);
  EXPECT_EQ(stack.films[0][0].thickness_nm, 0.5);
  EXPECT_EQ(stack.slabs[2].thickness_mm, 4);
}

TEST(GlazingSystem, SaysWhatIsWrongWithItsFile) {
  const TemporaryDirectory directory;
  write_text(directory / "pane.txt", table_text);
  write_text(directory / "clear.dat", optics_text);
  for (const char* layers :
       {"[]", "[{\"gap_mm\": 12}]", "[{\"pane\": \"none.txt\"}]",
        "[{\"pane\": \"clear.dat\", \"thickness_mm\": 10}]", "[{\"pane\": \"pane.txt\", \"fliped\": true}]",
        "[{\"pane\": \"pane.txt\"}, {\"gap_mm\": 0}]",
        "[{\"stack\": [{\"index\": 1.5, \"thickness_nm\": 9}]}]", "[{\"stack\": [{\"pane\": \"pane.txt\"}]}]",
        "[{\"states\": [{\"state\": 0, \"pane\": \"clear.dat\", \"tint\": 1}]}]",
        "[{\"stack\": [{\"index\": \"pane.txt\", \"thickness_mm\": 1}]}]"}) {
    write_text(directory / "unit.json", std::string("{\"layers\": ") + layers + "}");
    EXPECT_THROW(read_system({(directory / "unit.json").string()}), Error) << layers;
  }
}

// Where all tables of index have data: a number is the index of every wavelength.
TEST(GlazingSystem, SaysBeyondWhichWavelengthsItIsHeld) {
  const IndexRows glass{{300, 1.54, 0}, {2500, 1.49, 0}}, silver{{400, 0.05, 2}, {900, 0.1, 6}},
      oxide{{550, 2, 0}};
  const StackPane stack{{{glass, 4}}, {{{oxide, 40}, {silver, 12}}, {}}};
  const GlazingSystem system{"", {{"", stack}, flat({0.6, 0.1, 0.3})}};
  EXPECT_EQ(held_note({"", {{"", stack}}}, 300, 2500), "values are held beyond 400 to 900 nm");
  EXPECT_EQ(held_note({"", {{"", stack}}}, 400, 900), "");
  EXPECT_NE(held_note(system, 400, 900), "");  // the other pane has 500 nm alone
  EXPECT_EQ(held_note({"", {{"", StackPane{{{glass, 4}}, {{}, {}}}}}}, 300, 2500), "");
}

TEST(GlazingSystem, HasOneStateAndOneTemperatureBehindItsName) {
  const TemporaryDirectory directory;
  write_text(directory / "windows.idf", idf_text);
  write_text(directory / "pane.dat", optics_text);
  write_text(directory / "unit.json",
             R"({"name": "unit", "layers": [{"pane": "windows.idf", "product": "Warm"},
    {"states": [{"state": 0, "pane": "pane.dat"}, {"state": 1, "pane": "pane.dat"}]}]})");
  const std::string unit = (directory / "unit.json").string();
  EXPECT_EQ(read_system({unit + "#state=0.5#temperature=30"}).system.name, "unit");
  EXPECT_TRUE(is_glazing_file(unit + "#state=0.5#temperature=30"));
  EXPECT_TRUE(is_glazing_file((directory / "windows.idf").string() + "#Warm#temperature=30"));
  for (const char* wrong : {"#state=0#state=0", "#temperature=1#state=0#temperature=1", "#state=nan"})
    EXPECT_THROW(read_system({unit + wrong}), Error) << wrong;
  EXPECT_TRUE(is_glazing_file((directory / "windows.idf").string() + "#Warm#state=0#temperature=30"));
  // Names are users' text: however many "#" they have, a few are looked at.
  EXPECT_FALSE(is_glazing_file(unit + "#1#2#3#4"));
}

}  // namespace
}  // namespace vitrail::test::system_test
