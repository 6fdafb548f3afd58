// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
