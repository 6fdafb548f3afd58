// SPDX-License-Identifier: Apache-2.0
// What a bundle keeps of a system is all that its sheets are made of.
#include "glazing/kept_system.h"

#include <gtest/gtest.h>

#include "glazing/sheet.h"
#include "glazing/system_file.h"
#include "scene/diagnostics.h"
#include "tests/glazing/glazing_files.h"

namespace vitrail::test {
namespace {

class KeptSystem : public ::testing::Test {
 protected:
  KeptSystem() {
    write_text(directory / "pane.dat", optics_text);
    write_text(directory / "table.txt", table_text);
    write_text(directory / "index.txt", index_text);
    write_text(directory / "windows.idf", idf_text);
    write_text(directory / "unit.json", R"({"name": "unit", "layers": [
      {"states": [{"state": 0, "pane": "pane.dat"}, {"state": 0.4, "pane": "table.txt"},
        {"state": 1, "tinted": {"visible_transmittance": 0.1, "solar_transmittance": 0.08}}],
       "photochromic": {"k_d_m2_per_j": 2e-4, "k_f_per_s": 1e-3, "uv_w_per_m2": 3, "seconds": 100}},
      {"gap_mm": 12}, {"pane": "windows.idf", "product": "Warm", "flipped": true},
      {"gap_mm": 12}, {"stack": [{"index": "index.txt", "thickness_mm": 4}, {"index": 2.4, "thickness_nm": 50}]}]})");
    system = read_system({(directory / "unit.json").string()}).system;
  }
  TemporaryDirectory directory;
  GlazingSystem system;
};

void expect_same_sheets(const GlazingSystem& a, const GlazingSystem& b) {
  const GlazingSheets x = sheets_of(a, Polarisation::mixed_at_panes),
                      y = sheets_of(b, Polarisation::mixed_at_panes);
  EXPECT_TRUE(x.front == y.front && x.back == y.back);
}

TEST_F(KeptSystem, HasTheSameSheetsInAllStates) {
  GlazingSystem kept = kept_system(kept_text(system), "kept");
  expect_same_sheets(kept, system);
  for (const auto& [quantity, value] : {std::pair{Quantity::state, 0.0},
                                        {Quantity::state, 0.3},
                                        {Quantity::state, 0.7},
                                        {Quantity::temperature, 40.0},
                                        {Quantity::uv, 10.0},
                                        {Quantity::seconds, 50.0}}) {
    EXPECT_TRUE(set(system, quantity, value));
    EXPECT_TRUE(set(kept, quantity, value));
    EXPECT_EQ(value_of(kept, quantity), value);
    expect_same_sheets(kept, system);
  }
}

TEST_F(KeptSystem, LeavesOutWhatIsNotSeen) {
  // Of the infrared rows of the tinted state nothing is left.
  EXPECT_LT(kept_text(system).size(), 30'000u);
  EXPECT_EQ(kept_text(system).find("[1200.0"), std::string::npos);
}

TEST_F(KeptSystem, RefusesWhatIsNoSystem) {
  const std::string text = kept_text(system);
  const auto without = [&](const std::string& what, const std::string& instead) {
    std::string changed = text;
    const std::size_t at = changed.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return changed.replace(at, what.size(), instead);
  };
  for (const std::string& wrong :
       {std::string("{"), std::string("[]"), std::string(R"({"name": "a", "layers": []})"),
        without("\"states\"", "\"status\""), without("\"rows\":[[300.0", "\"rows\":[[\"300\""),
        without("\"rows\":[[300.0", "\"rows\":[[9300.0"), without("\"flipped\":false", "\"flipped\":1"),
        text.substr(0, text.size() / 2)})
    EXPECT_THROW(kept_system(wrong, "kept"), Error) << wrong.substr(0, 60);
}

}  // namespace
}  // namespace vitrail::test
