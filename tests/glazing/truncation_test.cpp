// SPDX-License-Identifier: Apache-2.0
// Nothing that a file may hold does more than throw an Error: every beginning of it, and with bytes changed.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "glazing/en_673.h"
#include "glazing/heat_balance.h"
#include "glazing/system_file.h"
#include "scene/system/diagnostics.h"
#include "tests/glazing/glazing_files.h"

namespace vitrail::test::truncation_test {
namespace {

const std::string heat_text =
    R"({"layers": [{"pane": "pane.txt", "heat": {"thickness_mm": 6, "conductivity_w_mk": 0.9,
 "emissivity_front": 0.84, "emissivity_back": 0.04, "infrared_t": 0.01}}, {"gap_mm": 12.7, "gas": "xenon"},
 {"pane": "pane.txt", "heat": {"thickness_mm": 6, "emissivity_front": 0.84, "emissivity_back": 0.84}}]})";
const std::string system_text = R"({"name": "unit", "layers": [{"pane": "pane.txt", "flipped": true},
 {"gap_mm": 12.7, "gas": {"argon": 0.9, "air": 0.1}}, {"pane": "pane.txt", "heat": {"thickness_mm": 6,
 "conductivity_w_mk": 0.9, "emissivity_front": 0.84, "emissivity_back": 0.04, "infrared_t": 0.01}}, {"stack": [{"index": 1.46, "thickness_nm": 90}, {"index": "n.txt", "thickness_mm": 4}]}]})";

// Where heat can be computed, U is a number.
void has_heat(const GlazingSystem& system) {
  try {
    EXPECT_TRUE(std::isfinite(u_value(system, nfrc_winter)));
    EXPECT_TRUE(std::isfinite(en_673_u_value(system)));
  } catch (const Error&) {
  }
}

// True where it was read; anything but an Error ends the test.
bool reads(const std::filesystem::path& file, const std::string& text) {
  write_text(file, text);
  try {
    const ReadSystem read = read_system({file.string()});
    const PaneValues v = system_values(read.system, 550, 0.5, Polarisation::apart);
    EXPECT_TRUE(v.t >= 0 && v.t <= 1 && v.rf >= 0 && v.rf <= 1 && v.rb >= 0 && v.rb <= 1) << text;
    has_heat(read.system);
    return true;
  } catch (const Error&) {
    return false;
  }
}

TEST(GlazingFiles, SurviveTruncationAndDamage) {
  const TemporaryDirectory directory;
  write_text(directory / "pane.txt", table_text);
  write_text(directory / "n.txt", index_text);
  const auto file = directory / "tried";
  std::mt19937 random(1);
  const std::string alphabet = "0123456789.,;:-+eE{}[]\"# \n\t!\xff\x80Nan";
  for (const std::string& whole :
       {igsdb_text, optics_text, table_text, epjson_text, idf_text, system_text, heat_text}) {
    int read = 0;
    for (std::size_t length = 0; length < whole.size(); ++length)
      read += reads(file, whole.substr(0, length));
    EXPECT_LT(read, static_cast<int>(whole.size()) / 2);
    for (int i = 0; i < 500; ++i) {
      std::string damaged = whole;
      for (int n = 1 + i % 4; n > 0; --n)
        damaged[random() % damaged.size()] = alphabet[random() % alphabet.size()];
      reads(file, damaged);
    }
  }
  EXPECT_TRUE(reads(file, system_text));
  EXPECT_TRUE(reads(file, heat_text));
}

}  // namespace
}  // namespace vitrail::test::truncation_test
