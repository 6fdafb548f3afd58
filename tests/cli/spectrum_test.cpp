// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/command.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test {
namespace {

TEST(Spectrum, EvaluatesBothMethods) {
  const CommandResult result = run(vitrail("spectrum") + " --cube 9 --json");
  ASSERT_EQ(result.status, 0) << result.output;
  const auto json = nlohmann::json::parse(result.output);
  ASSERT_EQ(json.size(), 2u);
  for (const auto& method : json) {
    EXPECT_EQ(method.at("colors"), 729);
    EXPECT_LT(method.at("max_error").get<double>(), 2e-5);
    EXPECT_GE(method.at("min_reflectance").get<double>(), 0);
    EXPECT_LE(method.at("max_reflectance").get<double>(), 1);
    EXPECT_EQ(method.at("color_checker").size(), 24u);
  }
  EXPECT_LT(json[1].at("max_error").get<double>(), 1e-9);
}

// Means are over pixels, not over colours.
TEST(Spectrum, TakesTheColorsOfAPicture) {
  const TemporaryDirectory directory;
  const auto json_of = [&](const std::string& pixels) {
    std::ofstream(directory / "a.ppm") << "P3 3 2 255 " << pixels;
    const CommandResult result =
        run(fmt::format("{} --json --picture '{}'", vitrail("spectrum"), (directory / "a.ppm").string()));
    EXPECT_EQ(result.status, 0) << result.output;
    return nlohmann::json::parse(result.output);
  };
  const auto once = json_of("200 30 30 0 0 0 255 255 255 90 90 90 128 128 128 0 0 0");
  EXPECT_EQ(once[0].at("colors"), 5);
  EXPECT_LT(once[0].at("max_error").get<double>(), 2e-5);
  EXPECT_LT(once[1].at("max_error").get<double>(), 1e-9);
  // Greys are constants: their roughness is 0.
  const auto four = json_of("200 30 30 200 30 30 200 30 30 200 30 30 128 128 128 0 0 0");
  EXPECT_NEAR(four[1].at("roughness").get<double>(), 4 * once[1].at("roughness").get<double>(), 1e-9);
  EXPECT_EQ(run(vitrail("spectrum") + " --picture none.png").status, 3);
}

TEST(Spectrum, PrintsOneColorAndPlots) {
  const TemporaryDirectory directory;
  const auto plot = directory / "patches.svg";
  const CommandResult result =
      run(fmt::format("{} --rgb 0.8,0.1,0.1 --plot '{}'", vitrail("spectrum"), plot.string()));
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_THAT(result.output, ::testing::StartsWith("wavelength_nm,jakob_hanika,matrix_r\n360,"));
  EXPECT_TRUE(std::filesystem::exists(plot));
  EXPECT_EQ(run(vitrail("spectrum") + " --rgb 2,0,0").status, 2);
}

}  // namespace
}  // namespace vitrail::test
