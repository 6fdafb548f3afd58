// SPDX-License-Identifier: Apache-2.0
// What a bundle keeps of a system is all that its sheets are made of.
#include "glazing/kept_system.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstdlib>

#include "glazing/sheet.h"
#include "glazing/system_file.h"
#include "scene/system/diagnostics.h"
#include "tests/glazing/glazing_files.h"
#include "tests/support/command.h"

namespace vitrail::test::kept_system_test {
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

// The C library chooses among its functions by what the processor has: here it is told that there is less.
TEST_F(KeptSystem, HasTheSameBitsOnOtherProcessors) {
  std::uint64_t bits = 0;
  const auto add = [&](double value) {
    bits = (bits ^ std::bit_cast<std::uint64_t>(value)) * 1099511628211u;  // FNV-1a's prime
  };
  const auto add_all = [&](const PaneValues& v) { add(v.t), add(v.rf), add(v.rb); };
  // Variants differ in about one value of a thousand, so there are some ten thousand of each kind.
  for (int i = 0; i < 400; ++i) {
    ASSERT_TRUE(set(system, Quantity::state, i / 399.0));
    for (const OpticalRow& row : std::get<MeasuredPane>(system.layers[0].pane).rows) add_all(row.at);
  }
  for (int i = 0; i < 20000; ++i) {
    const double part = (i + 0.5) / 20000, cosine = 0.1 + 0.8 * part;
    add(photochromic_state({2e-4, 1e-3, 6e4}, 0, 5, 60 * part, 2000 * part));
    add_all(mean(clear_glass({0.3 + 0.5 * part, 0.08, 0.08}, cosine)));
    add_all(mean(values_at(system.layers[2].pane, 360 + 470 * part, cosine)));
  }
  const std::string text = fmt::format("bits {:016x}\n", bits);
  fmt::print("{}", text);
  if (std::getenv("GLIBC_TUNABLES")) return;  // asked by the line below
  const CommandResult other =
      run(fmt::format("GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA,-AVX2_Usable,-FMA_Usable '{}' "
                      "--gtest_filter=KeptSystem.HasTheSameBitsOnOtherProcessors",
                      std::filesystem::read_symlink("/proc/self/exe").string()));
  EXPECT_EQ(other.status, 0) << other.output;
  EXPECT_NE(other.output.find(text), std::string::npos) << other.output;
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
        without("\"rows\":[[300.0", "\"rows\":[[9300.0"),
        without("\"rows\":[[300.0,", "\"rows\":[[300.0,1.5,"),
        without("\"rows\":[[300.0,", "\"rows\":[[300.0,-0.5,"), without("\"flipped\":false", "\"flipped\":1"),
        text.substr(0, text.size() / 2)})
    EXPECT_THROW(kept_system(wrong, "kept"), Error) << wrong.substr(0, 60);
}

}  // namespace
}  // namespace vitrail::test::kept_system_test
