// SPDX-License-Identifier: Apache-2.0
// Sizes, names and formats of pictures, and what they say of themselves.
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "film/film_progress.h"
#include "tests/support/command.h"
#include "tests/support/paths.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::pictures_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class Pictures : public ::testing::Test {
 protected:
  void SetUp() override { write("in.pbrt", scene("")); }
  static std::string scene(const std::string& film) {
    return "LookAt 1 2 3 1 2 0 0 1 0 Camera \"perspective\" \"float fov\" 40\n"
           "Film \"rgb\" \"integer xresolution\" 40 \"integer yresolution\" 20 " +
           film + "\nWorldBegin LightSource \"infinite\" Shape \"sphere\"\n";
  }
  std::string path(const std::string& name) const { return "'" + (directory_ / name).string() + "'"; }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(directory_ / name) << text;
  }
  CommandResult render(const std::string& out, const std::string& more,
                       const std::string& in = "in.pbrt") const {
    const char* samples = more.find("--spp") == std::string::npos ? "--spp 2" : "";
    return run(
        fmt::format("{} {} -o {} {} --quiet {}", vitrail("render"), path(in), path(out), samples, more));
  }
  std::pair<int, int> size(const std::string& film) const {
    const Film f = read_film(directory_ / film, nullptr);
    return {f.full_width(), f.full_height()};
  }
  OIIO::ImageSpec spec(const std::string& name) const {
    const auto in = OIIO::ImageInput::open((directory_ / name).string());
    return in ? in->spec() : OIIO::ImageSpec();
  }
  TemporaryDirectory directory_;
};

TEST_F(Pictures, HaveTheSizeAskedFor) {
  const std::vector<std::pair<std::string, std::pair<int, int>>> sizes{{"", {40, 20}},
                                                                       {"--scale 0.5", {20, 10}},
                                                                       {"--width 80", {80, 40}},
                                                                       {"--height 10", {20, 10}},
                                                                       {"--width 30 --height 30", {30, 30}}};
  for (const auto& [options, expected] : sizes) {
    ASSERT_EQ(render("a.film", options + " --force").status, 0) << options;
    EXPECT_EQ(size("a.film"), expected) << options;
  }
  EXPECT_EQ(render("a.film", "--scale 0 --force").status, 2);
}

// A picture of twice the size shows the same: averaged, it is the smaller one.
TEST_F(Pictures, OfAnotherSizeShowTheSame) {
  ASSERT_EQ(render("small.film", "--spp 256").status, 0);
  ASSERT_EQ(render("large.film", "--spp 64 --scale 2").status, 0);
  const Film small = read_film(directory_ / "small.film", nullptr),
             large = read_film(directory_ / "large.film", nullptr);
  for (const auto& [x, y] : {std::pair(3, 3), {20, 10}, {36, 16}, {10, 10}}) {
    double sum = 0;
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i)
        sum += large.mean(static_cast<std::uint32_t>((2 * y + j) * 80 + 2 * x + i)).y;
    EXPECT_NEAR(sum / 4, small.mean(static_cast<std::uint32_t>(y * 40 + x)).y, 0.1);
  }
}

TEST_F(Pictures, AreCalledAsTheSceneSays) {
  write("in.pbrt", scene("\"string filename\" [ \"kitchen.png\" ]"));
  write("plain.pbrt", scene("# \"string filename\" \"comment.png\""));
  const std::string here = "cd " + path("") + "; " + vitrail("render");
  ASSERT_EQ(run(here + " in.pbrt --spp 1").status, 0);
  EXPECT_TRUE(std::filesystem::exists(directory_ / "kitchen.png"));
  ASSERT_EQ(run(here + " plain.pbrt --spp 1").status, 0);
  EXPECT_TRUE(std::filesystem::exists(directory_ / "plain.exr"));
}

TEST_F(Pictures, SayWhereTheyComeFrom) {
  ASSERT_EQ(render("a.exr", "--seed 3 --film " + path("a.film")).status, 0);
  const OIIO::ImageSpec s = spec("a.exr");
  EXPECT_THAT(s.get_string_attribute("Software"), HasSubstr("vitrail 0."));
  EXPECT_THAT(s.get_string_attribute("scene"), HasSubstr("in.pbrt"));
  EXPECT_EQ(s.get_string_attribute("seed"), "3");
  EXPECT_EQ(s.get_int_attribute("samplesPerPixel"), 2);
  EXPECT_EQ(s.get_int_attribute("samplesPerPixelLeast"), 2);
  const Film film = read_film(directory_ / "a.film", nullptr);
  EXPECT_EQ(s.get_string_attribute("filmHash"), fmt::format("{:016x}", film.hash()));
  EXPECT_EQ(s.get_string_attribute("sceneHash"), fmt::format("{:016x}", film.key().scene_hash));
  // The camera stands at (1, 2, 3) and looks along -z.
  float m[16];
  ASSERT_TRUE(s.getattribute("worldToCamera", OIIO::TypeDesc::TypeMatrix, m));
  EXPECT_NEAR(1 * m[0] + 2 * m[4] + 3 * m[8] + m[12], 0, 1e-5);
  EXPECT_NEAR(1 * m[1] + 2 * m[5] + 3 * m[9] + m[13], 0, 1e-5);
  EXPECT_NEAR(1 * m[2] + 2 * m[6] + 1 * m[10] + m[14], 2, 1e-5);
  // The middle of the picture's upper edge, as far as one sees up 2 before the camera.
  ASSERT_TRUE(s.getattribute("worldToNDC", OIIO::TypeDesc::TypeMatrix, m));
  const double up = 2 * 0.36397023426620234;  // tan 20°
  const auto at = [&](int row) { return m[row] + (2 + up) * m[4 + row] + 1 * m[8 + row] + m[12 + row]; };
  EXPECT_NEAR(at(0) / at(3), 0, 1e-5);
  EXPECT_NEAR(at(1) / at(3), 1, 1e-5);
  EXPECT_NEAR(at(3), 2, 1e-5);
}

TEST_F(Pictures, AreWrittenInOtherFormats) {
  ASSERT_EQ(render("a.film", "").status, 0);
  const auto develop = [&](const std::string& out, const std::string& more) {
    return run(vitrail("develop") + " " + path("a.film") + " -o " + path(out) + " " + more).status;
  };
  EXPECT_EQ(develop("a.jpg", ""), 0);
  EXPECT_EQ(spec("a.jpg").format, OIIO::TypeDesc(OIIO::TypeDesc::UINT8));
  EXPECT_EQ(develop("a.tif", ""), 0);
  EXPECT_EQ(spec("a.tif").format, OIIO::TypeDesc(OIIO::TypeDesc::UINT16));
  EXPECT_EQ(develop("a.png", "--bits 16"), 0);
  EXPECT_EQ(spec("a.png").format, OIIO::TypeDesc(OIIO::TypeDesc::UINT16));
  EXPECT_EQ(develop("b.jpg", "--bits 16"), 2);
  EXPECT_EQ(develop("b.exr", "--bits 8"), 2);
  EXPECT_EQ(render("a.jpg", "").status, 0);
}

// The usual picture starts no second program and no library of images.
TEST_F(Pictures, ARenderWritesPngJpegAndTiffItself) {
  ASSERT_EQ(run(vitrail("partition") + " " + path("in.pbrt") + " -o " + path("in.vit") + " --quiet").status,
            0);
  std::filesystem::create_directory(directory_ / "alone");
  std::filesystem::copy_file(std::filesystem::path(bin_dir()) / "vitrail-render",
                             directory_ / "alone/vitrail-render");
  const auto alone = [&](const std::string& out) {
    return run(fmt::format("{} {} -o {} --spp 2 --crop 5,30,2,20 --quiet", path("alone/vitrail-render"),
                           path("in.vit"), out));
  };
  const CommandResult png = alone(path("a.png") + " --film " + path("a.film"));
  EXPECT_EQ(png.status, 0) << png.output;
  EXPECT_EQ(png.output, "");
  const CommandResult jpeg = alone(path("b.jpg"));
  EXPECT_EQ(jpeg.status, 0) << jpeg.output;
  EXPECT_EQ(spec("b.jpg").width, 25);
  const CommandResult tiff = alone(path("b.tif") + " --memory 40M");
  EXPECT_EQ(tiff.status, 0) << tiff.output;
  EXPECT_EQ(spec("b.tif").width, 25);
  EXPECT_EQ(spec("b.tif").y, 2);
  const CommandResult exr = alone(path("b.exr"));
  EXPECT_EQ(exr.status, 4) << exr.output;
  EXPECT_THAT(exr.output, HasSubstr("vitrail-develop is missing"));
  EXPECT_EQ(spec("a.png").x, 5);
  EXPECT_EQ(spec("a.png").width, 25);
  const CommandResult loaded =
      run("LD_DEBUG=files " + vitrail("develop") + " " + path("a.film") + " -o " + path("c.png"));
  EXPECT_EQ(loaded.status, 0);
  EXPECT_THAT(loaded.output, AllOf(HasSubstr("libpng"), ::testing::Not(HasSubstr("OpenImageIO"))));
  EXPECT_EQ(run(fmt::format("cmp {} {}", path("a.png"), path("c.png"))).status, 0);
  EXPECT_EQ(run(vitrail("develop") + " " + path("a.film") + " --exposure fit -o " + path("c.tif")).status, 0);
  EXPECT_EQ(run(fmt::format("cmp {} {}", path("b.tif"), path("c.tif"))).status, 0);
}

TEST_F(Pictures, APngThatCannotBeWrittenIsAnError) {
  const CommandResult nowhere = render("no/such/folder/a.png", "");
  EXPECT_EQ(nowhere.status, 4) << nowhere.output;
  EXPECT_THAT(nowhere.output, HasSubstr("no/such/folder"));
  std::filesystem::create_directory(directory_ / "folder.png");
  EXPECT_NE(render("folder.png", "").status, 0);
}

TEST_F(Pictures, OfMitsubaTakeParameters) {
  write("in.xml",
        "<scene version=\"3.0.0\"><default name=\"res\" value=\"40\"/><integrator type=\"path\"/>"
        "<sensor type=\"perspective\"><film type=\"hdrfilm\"><integer name=\"width\" value=\"$res\"/>"
        "<integer name=\"height\" value=\"$res\"/></film></sensor><emitter type=\"constant\"/></scene>");
  for (const auto& [option, width] : {std::pair("", 40), {"-Dres=16", 16}, {"-D res=24", 24}}) {
    const CommandResult done = render("a.film", std::string("--force ") + option, "in.xml");
    ASSERT_EQ(done.status, 0) << option << done.output;
    EXPECT_EQ(size("a.film").first, width) << option;
  }
  const CommandResult unknown = render("b.film", "-D spp=4", "in.xml");
  EXPECT_EQ(unknown.status, 3);
  EXPECT_THAT(unknown.output, HasSubstr("no parameter \"spp\"; it has res"));
  EXPECT_EQ(render("b.film", "-D spp", "in.xml").status, 2);
  EXPECT_NE(render("b.film", "-D spp=4").status, 0) << "pbrt has none";
}

TEST_F(Pictures, AreSeenByTheSensorAskedFor) {
  const auto sensor = [](int width) {
    return fmt::format(
        "<sensor type=\"perspective\"><film type=\"hdrfilm\"><integer name=\"width\" value=\"{}\"/>"
        "<integer name=\"height\" value=\"16\"/></film></sensor>",
        width);
  };
  write("in.xml",
        "<scene version=\"3.0.0\">" + sensor(40) + sensor(24) + "<emitter type=\"constant\"/></scene>");
  for (const auto& [option, width] : {std::pair("", 40), {"--camera 0", 40}, {"--camera 1", 24}}) {
    ASSERT_EQ(render("a.film", std::string("--force ") + option, "in.xml").status, 0) << option;
    EXPECT_EQ(size("a.film").first, width) << option;
  }
  const CommandResult none = render("b.film", "--camera 2", "in.xml");
  EXPECT_NE(none.status, 0);
  EXPECT_THAT(none.output, HasSubstr("2 sensors"));
  EXPECT_NE(render("b.film", "--camera 1").status, 0) << "pbrt has one";
}

TEST_F(Pictures, SayHowMuchDarkerTheClampMakesThem) {
  const auto brightness = [&](const std::string& film) {
    const Film f = read_film(directory_ / film, nullptr);
    double sum = 0;
    for (std::uint32_t p = 0; p < f.pixels(); ++p) sum += f.mean(p).y;
    return sum;
  };
  ASSERT_EQ(render("whole.film", "").status, 0);
  const CommandResult clamped = run(
      fmt::format("{} {} -o {} --spp 2 --clamp 0.4", vitrail("render"), path("in.pbrt"), path("cut.film")));
  ASSERT_EQ(clamped.status, 0) << clamped.output;
  EXPECT_THAT(clamped.output, HasSubstr("% of the light"));
  const double share = read_film(directory_ / "cut.film", nullptr).clamped_share();
  EXPECT_GT(share, 0.01);
  EXPECT_NEAR(brightness("cut.film") / brightness("whole.film"), 1 - share, 1e-6);
  EXPECT_EQ(render("cut.film", "").status, 3) << "another picture";
  EXPECT_THAT(run(vitrail("inspect") + " " + path("cut.film")).output, HasSubstr("clamped share"));
}

TEST_F(Pictures, ADryRunWritesNothing) {
  const CommandResult dry = run(
      fmt::format("{} {} -o {} --spp 100000 --dry-run", vitrail("render"), path("in.pbrt"), path("a.exr")));
  EXPECT_EQ(dry.status, 0) << dry.output;
  EXPECT_THAT(dry.output, AllOf(HasSubstr("memory of a rank"), HasSubstr("under mpirun MPI takes"),
                                HasSubstr("time: about")));
  for (const char* file : {"a.exr", "a.exr.work", "a.exr.partial", "a.exr.work.lock", "a.exr.tmp.vit"})
    EXPECT_FALSE(std::filesystem::exists(directory_ / file)) << file;
}

TEST_F(Pictures, BundlesSayWhatTheyWereMadeOf) {
  ASSERT_EQ(
      run(vitrail("partition") + " " + path("in.pbrt") + " -o " + path("a.vit") + " --domains 2 --quiet")
          .status,
      0);
  const CommandResult told = run(vitrail("inspect") + " " + path("a.vit"));
  EXPECT_EQ(told.status, 0) << told.output;
  EXPECT_THAT(told.output, AllOf(HasSubstr("in.pbrt"), HasSubstr("vitrail 0."), HasSubstr("--domains 2")));
  const CommandResult whole = run(vitrail("verify") + " " + path("a.vit"));
  EXPECT_EQ(whole.output.find("warning"), std::string::npos) << whole.output;
}

}  // namespace
}  // namespace vitrail::test::pictures_test
