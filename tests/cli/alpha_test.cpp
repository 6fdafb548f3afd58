// SPDX-License-Identifier: Apache-2.0
// `render --alpha --hide-emitters`, as it is typed.
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/command.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::alpha_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

// A card over the left half of the picture, under a sky.
class AlphaTyped : public ::testing::Test {
 protected:
  AlphaTyped() {
    std::ofstream(directory_ / "a.pbrt") << R"(Scale -1 1 1
LookAt 0 0 4  0 0 0  0 1 0
Camera "orthographic" "float screenwindow" [-1 1 -1 1]
Sampler "independent" "integer pixelsamples" 64
PixelFilter "box" "float xradius" .5 "float yradius" .5
Film "rgb" "integer xresolution" 8 "integer yresolution" 4
WorldBegin
LightSource "infinite" "rgb L" [1 1 1]
Material "diffuse" "rgb reflectance" [.8 .8 .8]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [-1 -1 0 -.125 -1 0 -.125 1 0 -1 1 0]
)";
  }
  std::string path(const std::string& name) const { return (directory_ / name).string(); }
  CommandResult render(const std::string& picture, const std::string& more) const {
    return run(fmt::format("{} {} -o {} --force --quiet {}", vitrail("render"), path("a.pbrt"), path(picture),
                           more));
  }
  // Of the pixel (x, 1): values of the channels by the names of the file.
  std::map<std::string, float> pixel(const std::string& picture, int x) const {
    const auto in = OIIO::ImageInput::open(path(picture));
    EXPECT_TRUE(in) << picture;
    if (!in) return {};
    const OIIO::ImageSpec& spec = in->spec();
    std::vector<float> values(static_cast<std::size_t>(spec.nchannels * spec.width * spec.height));
    in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values.data());
    std::map<std::string, float> channels;
    for (int c = 0; c < spec.nchannels; ++c)
      channels[spec.channelnames[static_cast<std::size_t>(c)]] =
          values[static_cast<std::size_t>((spec.width + x) * spec.nchannels + c)];
    return channels;
  }

  TemporaryDirectory directory_;
};

TEST_F(AlphaTyped, ExrHasItBesideColoursThatAreMultipliedByIt) {
  ASSERT_EQ(render("a.exr", "--alpha --hide-emitters").status, 0);
  const auto card = pixel("a.exr", 1), edge = pixel("a.exr", 3), nothing = pixel("a.exr", 6);
  EXPECT_EQ(card.at("A"), 1);
  EXPECT_NEAR(card.at("G"), 0.8f, 0.02f);
  EXPECT_NEAR(edge.at("A"), 0.5f, 0.05f) << "half of the pixel";
  EXPECT_NEAR(edge.at("G"), 0.8f * edge.at("A"), 0.02f);
  EXPECT_EQ(nothing.at("A"), 0);
  EXPECT_EQ(nothing.at("G"), 0);
  ASSERT_EQ(render("a.exr", "--alpha").status, 0);
  EXPECT_EQ(pixel("a.exr", 6).at("A"), 0);
  EXPECT_NEAR(pixel("a.exr", 6).at("G"), 1, 0.02f) << "surroundings are seen";
  ASSERT_EQ(render("a.exr", "").status, 0);
  EXPECT_FALSE(pixel("a.exr", 6).contains("A"));
}

TEST_F(AlphaTyped, PngHasStraightColours) {
  ASSERT_EQ(render("a.png", "--alpha --hide-emitters --film " + path("a.film")).status, 0);
  // OpenImageIO multiplies as it reads: of what is half there the half, in the picture's integers.
  const auto card = pixel("a.png", 1), edge = pixel("a.png", 3), nothing = pixel("a.png", 6);
  const float full = card.at("G");
  EXPECT_NEAR(full, 0.906f, 0.01f) << "0.8 by sRGB's transfer function";
  EXPECT_EQ(card.at("A"), 1);
  EXPECT_NEAR(edge.at("A"), 0.5f, 0.05f);
  EXPECT_GT(edge.at("G"), 0.3f);
  EXPECT_LT(edge.at("G"), full * 0.8f);
  EXPECT_EQ(nothing.at("A"), 0);
  ASSERT_EQ(run(fmt::format("{} {} -o {}", vitrail("develop"), path("a.film"), path("b.png"))).status, 0);
  EXPECT_EQ(run(fmt::format("cmp {} {}", path("a.png"), path("b.png"))).status, 0);
  ASSERT_EQ(run(fmt::format("{} {} -o {}", vitrail("develop"), path("a.film"), path("b.jpg"))).status, 0);
  EXPECT_FALSE(pixel("b.jpg", 1).contains("A")) << "other formats have none";
}

TEST_F(AlphaTyped, ConvertKeepsWhatIsHiddenOrSaysSo) {
  std::ofstream(directory_ / "a.xml")
      << "<scene version='3.0.0'><integrator type='path'><boolean name='hide_emitters' value='true'/>"
         "</integrator><sensor type='perspective'/><emitter type='constant'/><shape type='sphere'/></scene>";
  const auto convert = [&](const std::string& to) {
    return run(fmt::format("{} {} -o {}", vitrail("convert"), path("a.xml"), path(to))).output;
  };
  EXPECT_THAT(convert("b.xml"), Not(HasSubstr("hidden emitters")));
  const auto written = [&](const char* file) {
    std::ifstream in(directory_ / file);
    return std::string{std::istreambuf_iterator<char>(in), {}};
  };
  EXPECT_THAT(written("b.xml"), HasSubstr("name=\"hide_emitters\" value=\"true\""));
  EXPECT_THAT(convert("b.pbrt"), HasSubstr("hidden emitters"));
  EXPECT_THAT(convert("b.pov"), Not(HasSubstr("hidden emitters"))) << "a black ball is before them";
  EXPECT_THAT(written("b.pov"), HasSubstr("no_shadow no_reflection no_radiosity"));
}

TEST_F(AlphaTyped, WhatIsHiddenIsInspectedAndKeptApart) {
  ASSERT_EQ(render("a.film", "--hide-emitters").status, 0);
  const CommandResult told = run(fmt::format("{} --json {}", vitrail("inspect"), path("a.film")));
  EXPECT_EQ(nlohmann::json::parse(told.output).at("hide_emitters"), true);
  ASSERT_EQ(
      run(fmt::format("{} {} -o {} --seed 2 --quiet", vitrail("render"), path("a.pbrt"), path("b.film")))
          .status,
      0);
  const CommandResult merged =
      run(fmt::format("{} {} {} -o {}", vitrail("develop"), path("a.film"), path("b.film"), path("c.exr")));
  EXPECT_EQ(merged.status, 3);
  EXPECT_THAT(merged.output, HasSubstr("one shows lamps to the camera"));
}

}  // namespace
}  // namespace vitrail::test::alpha_test
