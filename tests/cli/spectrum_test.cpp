// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/command.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::spectrum_test {
namespace {

using ::testing::HasSubstr;

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

// Of a wall of one colour under a white sky: the manifest's text.
std::string partitioned(const TemporaryDirectory& directory, const std::string& color,
                        const std::string& options) {
  const std::string scene = (directory / "a.pbrt").string(), bundle = (directory / "a.vit").string();
  std::ofstream(scene)
      << "LookAt 0 0 -4 0 0 0 0 1 0\nCamera \"perspective\" \"float fov\" 40\nFilm \"rgb\" \"integer "
         "xresolution\" 4 \"integer yresolution\" 4\nWorldBegin\n"
         "LightSource \"infinite\" \"rgb L\" [1 1 1]\nMaterial \"diffuse\" \"rgb reflectance\" ["
      << color << "]\nShape \"sphere\"\n";
  const CommandResult made =
      run(fmt::format("{} '{}' -o '{}' --quiet {}", vitrail("partition"), scene, bundle, options));
  EXPECT_EQ(made.status, 0) << made.output;
  std::ifstream in(directory / "a.vit" / "manifest.json");
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(Spectrum, AMethodIsAPropertyOfABundleWithColors) {
  const TemporaryDirectory directory;
  const auto hash_of = [](const std::string& manifest) {
    return manifest.substr(manifest.find("\"scene_hash\""), 40);
  };
  const auto of = [&](const std::string& color, const std::string& options) {
    return partitioned(directory, color, options);
  };
  EXPECT_EQ(hash_of(of("0.8 0.2 0.1", "")), hash_of(of("0.8 0.2 0.1", "--rgb jakob-hanika")));
  EXPECT_NE(hash_of(of("0.8 0.2 0.1", "")), hash_of(of("0.8 0.2 0.1", "--rgb matrix-r")));
  EXPECT_EQ(hash_of(of("0.4 0.4 0.4", "")), hash_of(of("0.4 0.4 0.4", "--rgb matrix-r")))
      << "greys are constants";
  const std::string manifest = of("0.8 0.2 0.1", "--rgb matrix-r"), bundle = (directory / "a.vit").string();
  EXPECT_THAT(manifest, HasSubstr("\"rgb\": \"matrix-r\""));
  EXPECT_EQ(run(fmt::format("{} '{}'", vitrail("verify"), bundle)).status, 0);
  EXPECT_THAT(run(fmt::format("{} '{}'", vitrail("inspect"), bundle)).output, HasSubstr("matrix-r"));
  const auto hash_of_film = [&](const std::string& input, const std::string& options) {
    const CommandResult result =
        run(fmt::format("{} '{}' -o '{}' --force --quiet --spp 4 --stats '{}' {}", vitrail("render"),
                        (directory / input).string(), (directory / "a.film").string(),
                        (directory / "s.json").string(), options));
    EXPECT_EQ(result.status, 0) << result.output;
    std::ifstream in(directory / "s.json");
    return nlohmann::json::parse(in).at("film_hash").get<std::string>();
  };
  const std::string whole = hash_of_film("a.vit", "");
  EXPECT_EQ(hash_of_film("a.pbrt", "--rgb matrix-r"), whole) << "of a scene, too";
  EXPECT_NE(hash_of_film("a.pbrt", ""), whole);
  const CommandResult late = run(fmt::format("{} '{}' -o '{}' --rgb matrix-r", vitrail("render"), bundle,
                                             (directory / "b.film").string()));
  EXPECT_EQ(late.status, 2);
  EXPECT_THAT(late.output, HasSubstr("give --rgb to partition"));
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
}  // namespace vitrail::test::spectrum_test
