// SPDX-License-Identifier: Apache-2.0
// What a user hears who takes a verb, an option or a file for another.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/command.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::mistakes_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class Mistakes : public ::testing::Test {
 protected:
  void SetUp() override {
    write("in.pbrt",
          "WorldBegin LightSource \"infinite\" Shape \"trianglemesh\" \"point3 P\" [0 0 5 1 0 5 0 1 5]\n");
  }
  std::string path(const std::string& name) const { return "'" + (directory_ / name).string() + "'"; }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(directory_ / name) << text;
  }
  void copy_programs(std::initializer_list<const char*> names) const {
    const std::string quoted = vitrail("");
    const std::filesystem::path front = quoted.substr(1, quoted.find('\'', 1) - 1);
    for (const char* name : names) std::filesystem::copy(front.parent_path() / name, directory_ / name);
  }
  CommandResult verb(const std::string& verb, const std::string& arguments) const {
    return run(vitrail(verb) + " " + arguments);
  }
  CommandResult render(const std::string& more) const {
    return verb("render",
                path("in.pbrt") + " -o " + path("a.film") + " --spp 1 --crop 0,8,0,8 --force " + more);
  }
  TemporaryDirectory directory_;
};

TEST_F(Mistakes, MisspelledWordsAreRecognised) {
  EXPECT_THAT(verb("rendr", "").output, HasSubstr("did you mean render?"));
  const CommandResult option = render("--treads 2");
  EXPECT_EQ(option.status, 2);
  EXPECT_THAT(option.output, HasSubstr("there is no option --treads; did you mean --threads?"));
  EXPECT_THAT(
      render("--exposure 2").output,
      HasSubstr(
          "no option --exposure: it is one of vitrail develop, of the film that --film NAME.film keeps"));
  EXPECT_THAT(verb("develop", "a.film -o a.png --spp 4").output,
              HasSubstr("it is one of vitrail render, measure"));
  EXPECT_THAT(verb("convert", "a b c").output, HasSubstr("'c' is one argument too many"));
  EXPECT_THAT(verb("convert", "a b --reprot c").output, HasSubstr("did you mean --report?"));
}

TEST_F(Mistakes, AFileOfAnotherKindIsNamed) {
  ASSERT_EQ(verb("partition", path("in.pbrt") + " -o " + path("in.vit")).status, 0);
  ASSERT_EQ(render("").status, 0);
  ASSERT_EQ(verb("develop", path("a.film") + " -o " + path("a.png")).status, 0);
  const auto expect_named = [&](const char* program, const std::string& arguments, const char* kinds,
                                const char* advice) {
    const CommandResult refused = verb(program, arguments);
    EXPECT_EQ(refused.status, 3) << program << " " << arguments;
    EXPECT_THAT(refused.output, AllOf(HasSubstr(kinds), HasSubstr(advice))) << program << " " << arguments;
  };
  const std::string scene = path("in.pbrt"), bundle = path("in.vit"), film = path("a.film"),
                    picture = path("a.png"), to_scene = " " + path("out.xml"),
                    to_bundle = " -o " + path("out.vit"), to_picture = " -o " + path("out.png");
  expect_named("convert", bundle + to_scene, "this is a bundle, not a scene", "vitrail inspect names");
  expect_named("convert", bundle + " --to xml -o " + path("all"), "this is a bundle, not a scene", "inspect");
  expect_named("convert", picture + to_scene, "this is a picture, not a scene", "vitrail compare");
  expect_named("partition", bundle + to_bundle, "this is a bundle, not a scene", "vitrail inspect names");
  expect_named("partition", film + to_bundle, "this is a film, not a scene", "vitrail develop");
  expect_named("inspect", picture, "this is a picture, not a scene or bundle or film", "vitrail compare");
  expect_named("verify", scene, "this is a scene, not a bundle", "vitrail partition");
  expect_named("develop", scene + to_picture, "this is a scene, not a film or picture", "vitrail render");
  expect_named("develop", bundle + to_picture, "this is a bundle, not a film or picture", "vitrail render");
  expect_named("compare", picture + " " + bundle, "this is a bundle, not a picture or film",
               "vitrail render");
  EXPECT_THAT(verb("convert", path("no.vit") + to_scene).output, Not(HasSubstr("this is a")));
  EXPECT_THAT(verb("inspect", bundle).output, HasSubstr("in.pbrt")) << "the advice leads somewhere";
}

TEST_F(Mistakes, CountsHaveSuffixes) {
  const auto photons = [&](const std::string& count) {
    EXPECT_EQ(render("--integrator photon --photons " + count).status, 0) << count;
    return verb("inspect", "--json " + path("a.film")).output;
  };
  EXPECT_THAT(photons("70k"), HasSubstr("\"photons\": 70000,"));
  EXPECT_THAT(photons("0.07M"), HasSubstr("\"photons\": 70000,"));
  for (const char* wrong : {"5G", "k", "70kk", "-1k", "1T"})
    EXPECT_EQ(render(std::string("--integrator photon --photons ") + wrong).status, 2) << wrong;
}

TEST_F(Mistakes, AShallowDepthOfSensorsIsWarnedOf) {
  write("sensors.txt", "0 0 0  0 0 1\n");
  const auto measured = [&](const std::string& options) {
    const CommandResult result = verb("render", path("in.pbrt") + " --sensors " + path("sensors.txt") +
                                                    " -o " + path("out.csv") + " --spp 1 --force " + options);
    EXPECT_EQ(result.status, 0) << result.output;
    return result.output;
  };
  EXPECT_THAT(measured(""), HasSubstr("after 5 scattering events"));
  for (const char* option : {"--max-depth -1", "--max-depth 5", "--integrator direct", "--quiet"})
    EXPECT_THAT(measured(option), Not(HasSubstr("scattering events"))) << option;
}

// What is counted is what the user asked for: a sensor is no row of pixels.
TEST_F(Mistakes, SensorsAreNotCountedAsAPicture) {
  write("sensors.txt", "0 0 0  0 0 1\n0 1 0  0 0 1\n");
  const CommandResult result = verb("render", path("in.pbrt") + " --sensors " + path("sensors.txt") + " -o " +
                                                  path("out.csv") + " --spp 1 --max-depth 1");
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_THAT(result.output, HasSubstr("measuring at 2 sensors of 16 pixels, 1 sample a pixel"));
}

TEST_F(Mistakes, AFolderThatIsNotThereIsToBeMade) {
  for (const char* command : {"render {} -o {}.png --spp 1", "partition {} -o {}.vit", "convert {} {}.xml"}) {
    const CommandResult result =
        run(vitrail(fmt::format(fmt::runtime(command), path("in.pbrt"), path("not/there/out"))));
    EXPECT_EQ(result.status, 4) << command << ": " << result.output;
    EXPECT_THAT(result.output, HasSubstr("make this folder first (mkdir -p)")) << command;
  }
}

TEST_F(Mistakes, WaysToSampleThatAreNotThere) {
  for (const auto& [option, hint] : {std::pair("--filter box:", "number of pixels"),
                                     {"--filter box:0", "number of pixels"},
                                     {"--filter box:1e9", "number of pixels"},
                                     {"--filter box:1x", "number of pixels"},
                                     {"--filter bix", "there are box"},
                                     {"--wavelengths 2", "1,4"},
                                     {"--light-candidates 0", "range 1 to 16"},
                                     {"--roulette 3", "early"},
                                     {"--texture-filter trilinear", "nearest"},
                                     {"--splat --adaptive", "give --spp instead"},
                                     {"--one-sequence --target-error .1", "give --spp instead"},
                                     {"--splat --filter box:5", "up to 4.5 pixels"}}) {
    const CommandResult result = render(option);
    EXPECT_EQ(result.status, 2) << option;
    EXPECT_THAT(result.output, HasSubstr(hint)) << option;
  }
  EXPECT_EQ(render("--filter lanczos:1.5 --light-candidates 16").status, 0);
}

TEST_F(Mistakes, LayersThatAreNotThere) {
  for (const auto& [program, output] : {std::pair("render", "a.film"), {"partition", "a.vit"}}) {
    const CommandResult unknown =
        verb(program, path("in.pbrt") + " -o " + path(output) + " --aov albedo,colour");
    EXPECT_EQ(unknown.status, 2);
    EXPECT_THAT(unknown.output, AllOf(HasSubstr("\"colour\""), HasSubstr("geo_normal")));
  }
  ASSERT_EQ(verb("partition", path("in.pbrt") + " -o " + path("plain.vit")).status, 0);
  const auto of_bundle = [&](const std::string& bundle, const std::string& aov) {
    return verb("render",
                path(bundle) + " -o " + path("b.film") + " --spp 1 --crop 0,8,0,8 --force --aov " + aov);
  };
  EXPECT_EQ(of_bundle("plain.vit", "albedo,normal,dd.y:depth,prim_index").status, 0);
  for (const char* aov : {"uv", "shape_index"}) {
    const CommandResult lacking = of_bundle("plain.vit", aov);
    EXPECT_EQ(lacking.status, 3);
    EXPECT_THAT(lacking.output, HasSubstr(fmt::format("partition the scene with --aov {}", aov)));
  }
  ASSERT_EQ(verb("partition", path("in.pbrt") + " -o " + path("more.vit") + " --aov uv,shape_index").status,
            0);
  EXPECT_EQ(of_bundle("more.vit", "uv,shape_index,position --aov-space camera").status, 0);
  EXPECT_THAT(verb("inspect", path("b.film")).output, HasSubstr("position,uv,shape_index"));
}

TEST_F(Mistakes, OptionsOfOthersAreUnderstoodOrAnswered) {
  EXPECT_EQ(verb("render", path("in.pbrt") + " --outfile " + path("b.film") +
                               " --spp 1 --nthreads 1 --pixelbounds 0,8,0,8 --max-depth -1")
                .status,
            0);
  EXPECT_TRUE(std::filesystem::exists(directory_ / "b.film"));
  EXPECT_EQ(render("-t 1").status, 0);
  for (const auto& [theirs, ours] : {std::pair("--cropwindow 0,1,0,1", "--crop"),
                                     {"--gpu", "processors"},
                                     {"-m scalar_rgb", "spectral"},
                                     {"--quick", "--spp"}}) {
    const CommandResult answered = render(theirs);
    EXPECT_EQ(answered.status, 2) << theirs;
    EXPECT_THAT(answered.output, HasSubstr(ours)) << theirs;
  }
}

TEST_F(Mistakes, NumbersWithoutSenseAreRefused) {
  for (const char* wrong :
       {"--time -1", "--time 0", "--threads 0", "--seed -1", "--checkpoint-every -5", "--spp 0", "--spp -3",
        "--max-depth -2", "--crop 0,8,0", "--crop 0,9999,0,8", "--memory 1Q"}) {
    const CommandResult refused = render(wrong);
    EXPECT_EQ(refused.status, 2) << wrong << refused.output;
  }
  const CommandResult domains =
      verb("partition", path("in.pbrt") + " -o " + path("a.vit") + " --domains 999999");
  EXPECT_EQ(domains.status, 2);
  EXPECT_THAT(domains.output, HasSubstr("999999 domains for 1 triangles"));
}

TEST_F(Mistakes, FilesAreCalledWhatTheyAre) {
  ASSERT_EQ(render("").status, 0);
  const CommandResult film = verb("render", path("a.film") + " -o " + path("b.exr"));
  EXPECT_EQ(film.status, 3);
  EXPECT_THAT(film.output, HasSubstr("vitrail develop makes a picture of it"));
  const CommandResult missing = verb("render", path("none.vit") + " -o " + path("b.exr"));
  EXPECT_EQ(missing.status, 3);
  EXPECT_THAT(missing.output, HasSubstr("there is no such bundle"));
  EXPECT_THAT(verb("render", path("none.pbrt") + " -o " + path("b.exr")).output,
              HasSubstr("there is no such file"));
  std::filesystem::create_directory(directory_ / "folder");
  EXPECT_THAT(verb("render", path("folder") + " -o " + path("b.exr")).output, HasSubstr("no manifest.json"));
}

TEST_F(Mistakes, AProgramWithoutItsSiblingsSaysSo) {
  copy_programs({"vitrail", "vitrail-render"});
  const CommandResult alone = run(path("vitrail") + " render " + path("in.pbrt") + " -o " + path("a.film"));
  EXPECT_EQ(alone.status, 4);
  EXPECT_THAT(alone.output, AllOf(HasSubstr("vitrail-partition is missing"), HasSubstr("one folder")));
  const CommandResult front_alone = run(path("vitrail") + " convert a b");
  EXPECT_EQ(front_alone.status, 4);
  EXPECT_THAT(front_alone.output, HasSubstr("have to lie in one folder"));
}

// As where the package vitrail-images is not installed.
TEST_F(Mistakes, WithoutImagesLinearPicturesAreWritten) {
  copy_programs({"vitrail", "vitrail-develop"});
  ASSERT_EQ(render("").status, 0);
  const std::string develop = path("vitrail") + " develop " + path("a.film") + " -o ";
  for (const char* picture : {"a.exr", "a.hdr", "a.jpg", "a.png", "a.tif"})
    EXPECT_EQ(run(develop + path(picture)).status, 0) << picture;
  const CommandResult other = run(develop + path("a.webp"));
  EXPECT_EQ(other.status, 4);
  EXPECT_THAT(other.output, HasSubstr("the package vitrail-images has it"));
}

TEST_F(Mistakes, DarknessIsAnnounced) {
  write("in.pbrt", "WorldBegin Shape \"sphere\"\n");
  EXPECT_THAT(render("").output,
              HasSubstr("the scene has no light: its picture is black; add a lamp, or give --sky"));
  EXPECT_THAT(verb("partition", path("in.pbrt") + " -o " + path("a.vit")).output,
              HasSubstr("has no light: its picture is black; add a lamp, or give --sky"));
  EXPECT_EQ(render("--quiet").output, "");
}

TEST_F(Mistakes, HelpSaysWhatHappensWithoutAnOption) {
  const CommandResult help = verb("render", "--help-all");
  EXPECT_EQ(help.status, 0);
  for (const char* name : {"convert", "inspect", "partition", "verify", "render", "develop", "compare"}) {
    const CommandResult one = verb("help", name);
    EXPECT_EQ(one.status, 0) << name;
    EXPECT_THAT(one.output, HasSubstr("--quiet")) << name;
  }
  for (const char* option :
       {"--spp", "--seed", "--max-depth", "--memory", "--threads", "--crop", "--progress"}) {
    const std::size_t at = help.output.find(std::string("\n  ") + option);
    const std::size_t named = at == std::string::npos ? help.output.find(option) : at;
    ASSERT_NE(named, std::string::npos) << option;
    const std::string entry = help.output.substr(named, 400);
    EXPECT_TRUE(entry.find("default") != std::string::npos || entry.find('=') != std::string::npos) << option;
  }
}

}  // namespace
}  // namespace vitrail::test::mistakes_test
