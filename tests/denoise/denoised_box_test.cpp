// SPDX-License-Identifier: Apache-2.0
// A Cornell box of 16 samples a pixel, denoised, against one of many samples. Skipped where there is no
// denoiser.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numeric>
#include <sstream>
#include <vector>

#include "film/film_progress.h"
#include "film/image_io.h"
#include "tests/support/command.h"
#include "tests/support/paths.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::denoised_box_test {
namespace {

using ::testing::HasSubstr;

class DenoisedBox : public ::testing::Test {
 protected:
  void SetUp() override {
    const CommandResult found = run(vitrail("develop") + " --find-denoiser");
    if (found.status != 0) GTEST_SKIP() << found.output;
  }
  std::string path(const std::string& name) const { return "'" + (directory_ / name).string() + "'"; }
  CommandResult render(const std::string& out, int samples, const std::string& more) const {
    return run(
        fmt::format("{} {}/examples/cornell-box/cornell-box.pbrt --width 64 --height 64 --spp {} "
                    "--quiet -o {} {}",
                    vitrail("render"), source_dir(), samples, path(out), more));
  }
  void develop(const std::string& film, const std::string& out, const std::string& more = "") const {
    const CommandResult done =
        run(fmt::format("{} {} -o {} {}", vitrail("develop"), path(film), path(out), more));
    ASSERT_EQ(done.status, 0) << done.output;
  }
  nlohmann::json compare(const std::string& image, const std::string& reference) const {
    return nlohmann::json::parse(
        run(fmt::format("{} {} {} --json", vitrail("compare"), path(image), path(reference))).output);
  }
  std::string bytes(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(directory_ / name).rdbuf();
    return text.str();
  }
  TemporaryDirectory directory_;
};

// By what it was measured to take: 79 MiB at 64 × 48 pixels.
TEST_F(DenoisedBox, IsCountedInTheMemoryOfARender) {
  const CommandResult little = render("x.png", 1, "--denoise --memory 60M");
  EXPECT_EQ(little.status, 4);
  EXPECT_THAT(little.output, HasSubstr("Give at least "));
  const CommandResult enough = render("x.png", 1, "--denoise --memory 110M");
  EXPECT_EQ(enough.status, 0) << enough.output;
}

// The error falls far (docs/why/denoising.md), and the mean of all light stays.
TEST_F(DenoisedBox, HasItsLightAndLittleOfItsError) {
  ASSERT_EQ(render("box.film", 16, "--aov albedo,normal").status, 0);
  ASSERT_EQ(render("many.film", 512, "--seed 1").status, 0);
  const std::string film = bytes("box.film");
  develop("box.film", "noisy.exr");
  develop("box.film", "clean.exr", "--denoise");
  develop("many.film", "many.exr");
  EXPECT_EQ(bytes("box.film"), film);
  EXPECT_LT(compare("clean.exr", "many.exr")["value"],
            compare("noisy.exr", "many.exr")["value"].get<double>() / 10);
  const nlohmann::json light = compare("clean.exr", "noisy.exr");
  for (const char* ratio : {"luminance_ratio", "red_ratio", "green_ratio"})
    EXPECT_NEAR(light[ratio].get<double>(), 1, 0.01) << ratio;
}

// Σ of the squared error relative to the light, as relmse has it of luminances.
double relative_error(const std::vector<double>& values, const std::vector<double>& reference) {
  double mean = 0, error = 0;
  for (const double r : reference) mean += r / static_cast<double>(reference.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    error += std::pow(values[i] - reference[i], 2) / (reference[i] * reference[i] + 0.01 * mean * mean);
  return error;
}

std::vector<double> bin_of(const Image& spectrum, std::size_t bin) {
  std::vector<double> values;
  for (std::size_t p = 0; p < spectrum.pixels(); ++p)
    values.push_back(
        static_cast<double>(spectrum.values[static_cast<std::size_t>(spectrum.channels) * p + bin]));
  return values;
}

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

TEST_F(DenoisedBox, HasItsSpectra) {
  ASSERT_EQ(render("box.film", 16, "--aov albedo,normal --spectral 7").status, 0);
  ASSERT_EQ(render("many.film", 512, "--seed 1 --spectral 7").status, 0);
  develop("box.film", "noisy.exr", "--spectral");
  develop("box.film", "clean.exr", "--spectral --denoise");
  develop("many.film", "many.exr", "--spectral");
  const Image noisy = read_picture(directory_ / "noisy.exr").spectrum,
              clean = read_picture(directory_ / "clean.exr").spectrum,
              many = read_picture(directory_ / "many.exr").spectrum;
  ASSERT_EQ(clean.channels, 7);
  for (std::size_t bin = 0; bin < 7; ++bin) {
    const std::vector<double> before = bin_of(noisy, bin), after = bin_of(clean, bin),
                              light = bin_of(many, bin);
    EXPECT_LT(relative_error(after, light), relative_error(before, light) / 2) << "bin " << bin;
    // Wavelengths are drawn for the eye: others have specks, whose light goes in part.
    const bool is_seen_well = bin >= 1 && bin <= 3;
    EXPECT_NEAR(sum(after) / sum(before), 1, is_seen_well ? 0.02 : 0.25) << "bin " << bin;
  }
}

// Its quality is that of the picture, so the film has fewer samples.
TEST_F(DenoisedBox, MayHaveANoisierFilm) {
  const auto error_asked_for = [&](const std::string& name, const std::string& options) {
    EXPECT_EQ(render(name, 32, fmt::format("--stats {} {}", path("s.json"), options)).status, 0);
    return read_json(directory_ / "s.json")["target_error"].get<double>();
  };
  EXPECT_EQ(error_asked_for("a.png", "--quality good"), 1);
  EXPECT_EQ(error_asked_for("b.png", "--quality good --denoise"), 1.6);
  EXPECT_EQ(error_asked_for("c.png", "--quality final --denoise"), 0.25);
}

TEST_F(DenoisedBox, IsNamedAsSuch) {
  ASSERT_EQ(render("box.png", 2, "--denoise").status, 0);
  EXPECT_THAT(bytes("box.png"), HasSubstr("denoised by Intel Open Image Denoise 2."));
  develop("box.film", "box.exr", "--denoise");
  EXPECT_THAT(bytes("box.exr"), HasSubstr("Intel Open Image Denoise 2."));
  develop("box.film", "noisy.png");
  EXPECT_THAT(bytes("noisy.png"), ::testing::Not(HasSubstr("denoised")));
}

// The film has guides, and the light that it has without them.
TEST_F(DenoisedBox, KeepsItsFilm) {
  ASSERT_EQ(render("a.png", 2, "--denoise").status, 0);
  ASSERT_EQ(render("b.png", 2, "").status, 0);
  const Film a = read_film(directory_ / "a.film", nullptr), b = read_film(directory_ / "b.film", nullptr);
  EXPECT_TRUE(a.layers().has(Layer::albedo) && a.layers().has(Layer::shading_normal));
  EXPECT_FALSE(b.layers().any());
  for (std::uint32_t p = 0; p < a.pixels(); ++p) ASSERT_EQ(a.mean(p).y, b.mean(p).y) << p;
  develop("a.film", "c.png", "--denoise");
  EXPECT_EQ(bytes("a.png"), bytes("c.png"));
}

}  // namespace
}  // namespace vitrail::test::denoised_box_test
