// SPDX-License-Identifier: Apache-2.0
// Glass that scatters: files with eight columns, and what data sheets say of it.
#include "glazing/scattering.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "glazing/data_sheet.h"
#include "glazing/product.h"
#include "glazing/system_file.h"
#include "scene/system/diagnostics.h"
#include "tests/glazing/glazing_files.h"

namespace vitrail::test::scattering_test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string igsdb_frit =
    R"({"name": "Frit", "type": "GLAZING", "subtype": "COATED", "coated_side": "BACK",
 "physical_properties": {"is_specular": false, "thickness": 6, "predefined_emissivity_front": "0.86",
  "predefined_emissivity_back": 0.84, "predefined_tir_front": 0.0, "conductivity": null,
  "optical_properties": {"optical_data": {"number_incidence_angles": 2, "angle_blocks": [
   {"incidence_angle": 60, "wavelength_data": []},
   {"incidence_angle": 0, "wavelength_data": [
    {"w": "0.3", "specular": {"tf": "0.1", "tb": "0.1", "rf": "0.02", "rb": "0.03"},
     "diffuse": {"tf": "0.5", "tb": "0.48", "rf": "0.18", "rb": "0.22"}},
    {"w": "0.8", "specular": {"tf": "0.1", "tb": "0.1", "rf": "0.02", "rb": "0.03"},
     "diffuse": {"tf": "0.5", "tb": "0.48", "rf": "0.18", "rb": "0.22"}},
    {"w": "2.5", "specular": {"tf": "0.2", "tb": "0.2", "rf": "0.02", "rb": "0.03"},
     "diffuse": {"tf": "0.4", "tb": "0.38", "rf": "0.13", "rb": "0.16"}}]}]}}}})";

void expect_values(const PaneValues& found, const PaneValues& expected) {
  EXPECT_NEAR(found.t, expected.t, 1e-12);
  EXPECT_NEAR(found.rf, expected.rf, 1e-12);
  EXPECT_NEAR(found.rb, expected.rb, 1e-12);
}

Product product_of(const std::string& text) {
  const TemporaryDirectory directory;
  return read_product(write_text(directory / "frit.txt", text));
}

TEST(Scattering, IsReadFromEightColumns) {
  for (const std::string& text : {optics_frit, igsdb_frit}) {
    const Product frit = product_of(text);
    EXPECT_EQ(frit.name, "Frit");
    EXPECT_EQ(frit.kind, PaneKind::coated);
    EXPECT_EQ(frit.thickness_mm, 6);
    EXPECT_EQ(frit.heat.emissivity_front, 0.86);
    EXPECT_EQ(frit.heat.emissivity_back, 0.84);
    ASSERT_EQ(frit.rows.size(), 3u);
    ASSERT_EQ(frit.scattered.size(), 3u);
    EXPECT_NEAR(frit.scattered[2].nm, 2500, 1e-9);
    expect_values(frit.rows[0].at, {0.6, 0.2, 0.25});
    expect_values(frit.rows[2].at, {0.6, 0.15, 0.19});
    expect_values(frit.scattered[0].at, {0.5, 0.18, 0.22});
    expect_values(frit.scattered[2].at, {0.4, 0.13, 0.16});
    EXPECT_THAT(frit.notes, Contains(HasSubstr("T from the back differs by up to 0.020")));
  }
}

// Version 2 of the IGSDB has clear glass, too.
TEST(Scattering, IsNotThereWhereNothingIsDiffuse) {
  std::string text = igsdb_frit;
  for (std::size_t at; (at = text.find(",\n     \"diffuse\"")) != text.npos;)
    text.erase(at, text.find('}', at) + 1 - at);
  const Product pane = product_of(text);
  EXPECT_THAT(pane.scattered, IsEmpty());
  expect_values(pane.rows.at(0).at, {0.1, 0.02, 0.03});
  EXPECT_THAT(scattering_notes({"", {{"", pane_of(pane)}}}), IsEmpty());
}

// Its part is of the sum, also where noise leaves the range.
TEST(Scattering, IsNeverMoreThanAll) {
  std::string text = optics_frit;
  text.replace(text.find("0.02 0.18"), 9, "-0.1 0.18");
  const Product frit = product_of(text);
  EXPECT_NEAR(frit.rows[0].at.rf, 0.08, 1e-12);
  EXPECT_NEAR(frit.scattered[0].at.rf, 0.08, 1e-12);
}

TEST(Scattering, IsNamedByDataSheets) {
  const TemporaryDirectory directory;
  const std::string file = write_text(directory / "frit.txt", optics_frit).string();
  GlazingSystem system = read_system({file}).system;
  const DataSheet sheet = data_sheet(system, Polarisation::mixed_at_panes);
  expect_values(sheet.states.at(0).angles.at(0).visible, {0.6, 0.2, 0.25});
  ASSERT_EQ(sheet.scattering.size(), 1u);
  EXPECT_EQ(sheet.scattering[0].pane, 0u);
  expect_values(sheet.scattering[0].visible, {0.6, 0.2, 0.25});
  expect_values(sheet.scattering[0].visible_scattered, {0.5, 0.18, 0.22});
  EXPECT_NEAR(sheet.scattering[0].solar.t, 0.6, 1e-12);
  EXPECT_GT(sheet.scattering[0].solar_scattered.t, 0.45);
  EXPECT_LT(sheet.scattering[0].solar_scattered.t, 0.5);
  EXPECT_THAT(scattering_notes(system),
              Contains(HasSubstr("pane 1 scatters 0.500 of its T 0.600, 0.180 of its R outside 0.200 and "
                                 "0.220 of its R inside 0.250")));
  system.layers[0].flipped = true;
  expect_values(scattering_of(system).at(0).visible_scattered, {0.5, 0.22, 0.18});
}

// Direct light of 1 onto a frit and a mirror behind it that scatters half: by hand, order by order.
TEST(Scattering, BetweenPanesIsTheSumOfAllOrders) {
  const Streams frit{{0.2, 0.05, 0.07}, {0.4, 0.1, 0.15}, 0.35, {0.5, 0.25, 0.3}},
      mirror{{0.1, 0.3, 0.2}, {0.05, 0.35, 0.1}, 0.06, {0.12, 0.6, 0.4}};
  double direct = frit.direct.t, diffuse = frit.scattered.t, t = 0, scattered_t = 0, rf = frit.direct.rf,
         scattered_rf = frit.scattered.rf;
  for (int order = 0; order < 200; ++order) {
    t += direct * mirror.direct.t;
    scattered_t += direct * mirror.scattered.t + diffuse * mirror.diffuse.t;
    const double back = direct * mirror.direct.rf,
                 diffuse_back = direct * mirror.scattered.rf + diffuse * mirror.diffuse.rf;
    rf += back * frit.direct.t;
    scattered_rf += back * frit.scattered_tb + diffuse_back * frit.diffuse.t;
    direct = back * frit.direct.rb;
    diffuse = back * frit.scattered.rb + diffuse_back * frit.diffuse.rb;
  }
  const Streams both = joined(frit, mirror);
  EXPECT_NEAR(both.direct.t, t, 1e-12);
  EXPECT_NEAR(both.direct.rf, rf, 1e-12);
  EXPECT_NEAR(both.scattered.t, scattered_t, 1e-12);
  EXPECT_NEAR(both.scattered.rf, scattered_rf, 1e-12);
  double sum = both.t() + both.direct.rf + both.scattered.rf;
  for (const double share : absorbed_by({frit, mirror, frit})) EXPECT_GT(share, 0);
  for (const double share : absorbed_by({frit, mirror})) sum += share;
  EXPECT_NEAR(sum, 1, 1e-12);
}

// Behind a frit a clear pane meets light of all angles, which it lets through less well.
TEST(Scattering, IsDiffuseBehindTheNextPane) {
  const TemporaryDirectory directory;
  const GlazingSystem frit = read_system({write_text(directory / "frit.txt", optics_frit).string()}).system;
  const GlazingSystem clear = read_system({write_text(directory / "clear.dat", optics_text).string()}).system;
  const GlazingSystem both{"", {frit.layers[0], clear.layers[0]}};
  const Streams of = system_streams(both, 550, 1, Polarisation::apart);
  GlazingSystem straight = both;
  forget_scattering(straight);
  EXPECT_LT(of.t(), system_values(straight, 550, 1, Polarisation::apart).t - 0.02);
  double sum = of.t() + of.direct.rf + of.scattered.rf;
  for (const double share : absorbed_shares(both, 550, 1, Polarisation::apart)) sum += share;
  EXPECT_NEAR(sum, 1, 1e-12);
}

TEST(Scattering, AsAStateIsSaid) {
  const TemporaryDirectory directory;
  write_text(directory / "frit.txt", optics_frit);
  const auto file = write_text(
      directory / "unit.json",
      R"({"layers": [{"states": [{"state": 0, "pane": "frit.txt"}, {"state": 1, "pane": "frit.txt"}]}]})");
  EXPECT_THAT(read_system({file.string()}).notes,
              Contains(HasSubstr("as a state all of it goes straight on")));
}

TEST(Scattering, SaysWhereAFileIsWrong) {
  struct Wrong {
    std::string part, instead, message;
    int line;
  };
  const auto expect_refused = [](const std::string& whole, const Wrong& wrong) {
    std::string text = whole;
    text.replace(text.find(wrong.part), wrong.part.size(), wrong.instead);
    try {
      product_of(text);
      ADD_FAILURE() << wrong.instead;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr(wrong.message));
      EXPECT_EQ(error.location.line, wrong.line) << error.what();
      EXPECT_THAT(error.location.file, HasSubstr("frit.txt"));
    }
  };
  expect_refused(optics_frit, {"0.800 0.10 0.50", "0.800 0.50", "each direct and then diffuse", 8});
  expect_refused(optics_frit, {"0.800 0.10 0.50", "0.800 0.10 x.50", "each direct and then diffuse", 8});
  expect_refused(optics_frit,
                 {"0.800 0.10 0.50 0.10 0.48 0.02", "0.800 0.10", "each direct and then diffuse", 8});
  expect_refused(optics_frit, {"0.800 0.10 0.50 0.10 0.48 0.02 0.18 0.03 0.22", "0.800 0.6 0.2 0.25",
                               "three and of eight columns", 8});
  expect_refused(optics_frit, {"0.800 0.10 0.50", "0.800 10 50", "have to be fractions", 8});
  const std::string block = "/physical_properties/optical_properties/optical_data/angle_blocks";
  expect_refused(igsdb_frit,
                 {"\"0.5\"", "\"half\"", block + "/1/wavelength_data/0/diffuse/tf: has to be a number", 0});
  expect_refused(igsdb_frit, {"\"incidence_angle\": 0", "\"incidence_angle\": 8", block + ": has none", 0});
  expect_refused(igsdb_frit, {"\"0.5\"", "\"50\"", "have to be fractions", 0});
  expect_refused(igsdb_frit, {"\"rb\": \"0.22\"", "\"rc\": 0", "/1/wavelength_data/0/diffuse", 0});
}

}  // namespace
}  // namespace vitrail::test::scattering_test
