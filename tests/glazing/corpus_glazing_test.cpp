// SPDX-License-Identifier: Apache-2.0
// Real products against what LBNL's WinCalc makes of them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "glazing/data_sheet.h"
#include "glazing/evaluation.h"
#include "glazing/product.h"
#include "glazing/system_file.h"
#include "tests/support/command.h"

namespace vitrail::test::corpus_glazing_test {
namespace {

namespace fs = std::filesystem;

struct Case {
  const char* results;
  std::vector<const char*> panes;
};

// WinCalc's own test of the flipped pane evaluates another system than it flips: its results are those of the
// system as it stands, bit for bit.
const std::vector<Case> cases{
    {"1_layer/nfrc_102/no_basis", {"CLEAR_3.json"}},
    {"1_layer/coated_nfrc_6046/no_basis", {"nfrc_6046.json"}},
    {"1_layer/coated_nfrc_20748/no_basis", {"nfrc_20748.oag"}},
    {"1_layer/laminate_optics_nanometers/no_basis", {"OpticsNanometers.txt"}},
    {"2_layers/nfrc_102_air_nfrc_102/no_basis", {"CLEAR_3.json", "CLEAR_3.DAT"}},
    {"2_layers/low_e_nfrc_2191_air_nfrc_102/no_basis", {"nfrc_2191.json", "CLEAR_3.json"}},
    {"2_layers/low_e_nfrc_2191_air_nfrc_102/flipped_low_e/no_basis", {"nfrc_2191.json", "CLEAR_3.json"}},
};

PaneValues side_values(const nlohmann::json& of, const char* what) {
  const auto& front = of.at("front");
  return {front.at("transmittance").at(what), front.at("reflectance").at(what),
          of.at("back").at("reflectance").at(what)};
}

void expect_near(const PaneValues& made, const PaneValues& expected, double tolerance,
                 const std::string& what) {
  EXPECT_NEAR(made.t, expected.t, tolerance) << what;
  EXPECT_NEAR(made.rf, expected.rf, tolerance) << what;
  EXPECT_NEAR(made.rb, expected.rb, tolerance) << what;
}

void expect_color(const ColorValues& made, const nlohmann::json& expected, const std::string& what) {
  const char* const xyz[]{"X", "Y", "Z"};
  const char* const lab[]{"L", "a", "b"};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(made.xyz[i], expected.at("trichromatic").at(xyz[i]).get<double>(), 1e-5) << what;
    EXPECT_NEAR(made.lab[i], expected.at("lab").at(lab[i]).get<double>(), 1e-4) << what;
  }
  // One rounds to an even half in one of them.
  EXPECT_NEAR(made.rgb[0], expected.at("rgb").at("R").get<int>(), 1) << what;
  EXPECT_NEAR(made.rgb[1], expected.at("rgb").at("G").get<int>(), 1) << what;
  EXPECT_NEAR(made.rgb[2], expected.at("rgb").at("B").get<int>(), 1) << what;
  const auto& dominant = expected.at("dominant_wavelength_purity");
  EXPECT_NEAR(made.dominant_nm, 1000 * dominant.at("dominant_wavelength").get<double>(), 0.02) << what;
  EXPECT_NEAR(made.purity, dominant.at("purity").get<double>() / 100, 2e-4) << what;
}

class GlazingCorpus : public ::testing::Test {
 protected:
  void SetUp() override {
    folder = corpus() / "glazing";
    if (!fs::exists(folder)) GTEST_SKIP() << "no corpus of glazing: set VITRAIL_CORPUS to its folder";
  }
  fs::path folder;
};

double largest_difference(const PaneValues& a, const PaneValues& b) {
  return std::max({std::abs(a.t - b.t), std::abs(a.rf - b.rf), std::abs(a.rb - b.rb)});
}

// Returns the largest difference of T, Rf and Rb from one direction.
double compare(const fs::path& folder, const Case& c, const Standard& standard, Sampling sampling,
               double theta_deg) {
  double largest = 0;
  std::vector<std::string> files;
  for (const char* pane : c.panes) files.push_back((folder / "products" / pane).string());
  const GlazingSystem system = read_system(files).system;
  const auto nm = common_wavelengths(system);
  const double cosine = std::cos(theta_deg * std::numbers::pi / 180);
  const Evaluation at = evaluate(
      [&](std::vector<double> x) {
        return spectrum_at(system, std::move(x), cosine, Polarisation::mixed_at_panes);
      },
      nm, standard, sampling);
  const Evaluation all = evaluate(
      [&](std::vector<double> x) {
        return hemispherical_spectrum(system, std::move(x), Polarisation::mixed_at_panes,
                                      HemisphereRule::each_10_deg);
      },
      nm, standard, sampling);
  const fs::path results = folder / "expected_results" / c.results /
                           (sampling == Sampling::full ? "full_spectrum" : "condensed_spectrum") /
                           (theta_deg == 0 ? "theta=0_phi=0" : "theta=15_phi=270");
  for (const char* method : {"solar", "photopic", "tuv", "tdw", "tkr"}) {
    const auto expected = read_json(results / fmt::format("{}.json", method)).at("system_results");
    const std::string what = fmt::format("{} {} at {}°", c.results, method, theta_deg);
    expect_near(at.averages.at(method), side_values(expected, "direct_direct"), 2e-5, what);
    largest =
        std::max(largest, largest_difference(at.averages.at(method), side_values(expected, "direct_direct")));
    expect_near(all.averages.at(method), side_values(expected, "diffuse_diffuse"), 5e-5,
                what + ", hemispherical");
  }
  const auto color = read_json(results / "color.json").at("system_results");
  const std::string what = fmt::format("{} colour at {}°", c.results, theta_deg);
  expect_color(at.t, color.at("front").at("transmittance").at("direct_direct"), what);
  expect_color(at.rf, color.at("front").at("reflectance").at("direct_direct"), what);
  expect_color(at.rb, color.at("back").at("reflectance").at("direct_direct"), what);
  return largest;
}

TEST_F(GlazingCorpus, EverySystemIsAsExpected) {
  const Standard standard = read_standard(folder / "standards" / "W5_NFRC_2003.std");
  for (const Sampling sampling : {Sampling::full, Sampling::condensed})
    for (const double theta : {0.0, 15.0}) {
      double largest = 0;
      for (const Case& c : cases) largest = std::max(largest, compare(folder, c, standard, sampling, theta));
      fmt::print("{} systems, {} wavelengths, {}°: largest difference {:.2g}\n", cases.size(),
                 sampling == Sampling::full ? "all" : "17", theta, largest);
    }
}

// WINDOW takes emissivities from infrared spectra where a file has them; ours are the file's. That is 0.004
// W/(m²K) where LoE 180 faces outside.
TEST_F(GlazingCorpus, HeatIsAsExpected) {
  double largest_u = 0, largest_g = 0;
  for (const Case& c : cases) {
    std::vector<std::string> files;
    for (const char* pane : c.panes) files.push_back((folder / "products" / pane).string());
    GlazingSystem system = read_system(files).system;
    system.layers.front().gap_behind_mm = 12.7;
    system.layers.front().flipped = std::string(c.results).find("flipped") != std::string::npos;
    const DataSheetState sheet = data_sheet(system, Polarisation::mixed_at_panes).states.at(0);
    const fs::path results = folder / "expected_results" / c.results / "full_spectrum";
    const auto expected = [&](const char* environment, const char* theta) {
      return read_json(results / theta / fmt::format("thermal_{}_Environment.json", environment));
    };
    ASSERT_TRUE(sheet.heat) << c.results;
    const double u = std::abs(sheet.heat->u_nfrc - expected("U", "theta=0_phi=0").at("U").get<double>());
    const double g =
        std::abs(*sheet.angles.at(0).shgc - expected("SHGC", "theta=0_phi=0").at("SHGC").get<double>());
    EXPECT_LT(u, 0.005) << c.results;
    EXPECT_LT(g, 0.0005) << c.results;
    largest_u = std::max(largest_u, u);
    largest_g = std::max(largest_g, g);
    const auto kelvin = expected("SHGC", "theta=0_phi=0").at("layer_temperatures_shgc");
    for (std::size_t i = 0; i < kelvin.size(); ++i)
      EXPECT_NEAR(sheet.heat->summer.kelvin.at(i / 2).at(i % 2), kelvin[i].get<double>(), 0.05)
          << c.results << " surface " << i;
    // 15°, from the absorptances of that angle.
    const SystemSpectrum at =
        spectrum_at(system, common_wavelengths(system), std::cos(15 * std::numbers::pi / 180),
                    Polarisation::mixed_at_panes);
    std::vector<double> absorbed;
    for (const SystemSpectrum& pane :
         absorbed_spectra(system, at.nm, std::cos(15 * std::numbers::pi / 180), Polarisation::mixed_at_panes))
      absorbed.push_back(average(pane, *find_method(nfrc_2003(), "SOLAR")).t);
    EXPECT_NEAR(
        solar_heat_gain(system, nfrc_summer, average(at, *find_method(nfrc_2003(), "SOLAR")).t, absorbed),
        expected("SHGC", "theta=15_phi=270").at("SHGC").get<double>(), 0.0005)
        << c.results;
  }
  fmt::print("largest differences: U {:.2g} W/(m²K), SHGC {:.2g}\n", largest_u, largest_g);
}

// Our own numbers of the standard do as well as its files.
TEST_F(GlazingCorpus, TheBuiltInStandardIsTheFile) {
  const Standard file = read_standard(folder / "standards" / "W5_NFRC_2003.std");
  const GlazingSystem system = read_system({(folder / "products" / "nfrc_6046.json").string()}).system;
  const auto nm = common_wavelengths(system);
  const auto spectrum = [&](std::vector<double> x) {
    return spectrum_at(system, std::move(x), 1, Polarisation::mixed_at_panes);
  };
  const Evaluation a = evaluate(spectrum, nm, file, Sampling::full);
  const Evaluation b = evaluate(spectrum, nm, nfrc_2003(), Sampling::full);
  for (const auto& [name, v] : b.averages) expect_near(v, a.averages.at(name), 1e-6, name);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(a.t.xyz[i], b.t.xyz[i], 0.01);
}

// The maker's own integrated values, of every product that has a spectrum.
TEST_F(GlazingCorpus, ProductsHaveTheirMakersAverages) {
  int compared = 0;
  for (const auto& entry : fs::directory_iterator(folder / "products")) {
    const auto products = read_products(entry.path());
    ASSERT_EQ(products.size(), 1u) << entry.path();
    if (entry.path().extension() != ".json") continue;
    const auto summary = read_json(entry.path()).at("integrated_results_summary").at(0);
    SystemSpectrum spectrum;
    for (const OpticalRow& row : products[0].rows) {
      spectrum.nm.push_back(row.nm);
      spectrum.values.push_back(row.at);
    }
    const auto compare_one = [&](const char* method, const char* key, double PaneValues::*value,
                                 double tolerance) {
      if (!summary.at(key).is_number()) return;
      const PaneValues v = average(spectrum, *find_method(nfrc_2003(), method));
      EXPECT_NEAR(v.*value, summary.at(key).get<double>(), tolerance) << entry.path() << ' ' << key;
      ++compared;
    };
    compare_one("SOLAR", "tfsol", &PaneValues::t, 1e-3);
    compare_one("SOLAR", "rbsol", &PaneValues::rb, 1e-3);
    compare_one("PHOTOPIC", "tfvis", &PaneValues::t, 5e-5);
    compare_one("PHOTOPIC", "rfvis", &PaneValues::rf, 5e-5);
    compare_one("TUV", "tuv", &PaneValues::t, 1e-3);
  }
  EXPECT_GT(compared, 30);
}

}  // namespace
}  // namespace vitrail::test::corpus_glazing_test
