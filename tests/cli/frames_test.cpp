// SPDX-License-Identifier: Apache-2.0
// `render --frames`: a picture for each line of a text.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/command.h"
#include "tests/support/paths.h"
#include "tests/support/ranks.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::frames_test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

class Frames : public ::testing::Test {
 protected:
  Frames() {
    const CommandResult made = run(fmt::format("{} {}/examples/cornell-box/cornell-box.pbrt -o {} --quiet",
                                               vitrail("partition"), source_dir(), path("box.vit")));
    EXPECT_EQ(made.status, 0) << made.output;
  }
  std::string path(const std::string& name) const { return (directory_ / name).string(); }
  void write_frames(const std::string& text) const { std::ofstream(directory_ / "frames.txt") << text; }
  CommandResult render(const std::string& more, int ranks = 1) const {
    return run(
        fmt::format("{} {} --width 16 --spp 2 {}", vitrail_on(ranks, "render"), path("box.vit"), more));
  }
  CommandResult render_frames(const std::string& more = "", int ranks = 1) const {
    return render(fmt::format("--frames {} -o {} {}", path("frames.txt"), path("f%03d.png"), more), ranks);
  }
  std::string bytes(const std::string& name) const {
    std::ifstream in(directory_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  TemporaryDirectory directory_;
};

TEST_F(Frames, AreThePicturesOfTheirOptions) {
  write_frames(
      "# a lamp, and an eye\n--set area-1.scale=.5\n\n--look-at=.5,1.5,-2.9,0,1,0  # aside\n--seed 3 "
      "--fov 60\n");
  for (const int ranks : {1, 2}) {
    const CommandResult all = render_frames("--force", ranks);
    ASSERT_EQ(all.status, 0) << all.output;
    const char* options[] = {"--set area-1.scale=.5", "--look-at=.5,1.5,-2.9,0,1,0", "--seed 3 --fov 60"};
    for (int i = 0; i < 3; ++i) {
      const CommandResult one = render(fmt::format("{} -o {} --force", options[i], path("one.png")));
      ASSERT_EQ(one.status, 0) << one.output;
      EXPECT_EQ(bytes(fmt::format("f{:03}.png", i + 1)), bytes("one.png")) << options[i];
    }
  }
  EXPECT_FALSE(fs::exists(directory_ / "f004.png"));
}

TEST_F(Frames, GoOnAtTheFirstThatIsMissing) {
  write_frames("--seed 1\n--seed 2\n--seed 3\n");
  ASSERT_EQ(render_frames().status, 0);
  const std::string second = bytes("f002.png");
  for (const int ranks : {1, 2}) {
    fs::remove(directory_ / "f002.png");
    const CommandResult again = render_frames("--threads 1", ranks);
    EXPECT_EQ(again.status, 0) << again.output;
    EXPECT_THAT(again.output,
                AllOf(HasSubstr("f001.png is there and stays"), HasSubstr("f003.png is there")));
    EXPECT_EQ(bytes("f002.png"), second);
  }
}

TEST_F(Frames, ThatAreThereHaveToBeWhatTheirLinesAskFor) {
  const std::string lines = "--seed 1\n--set area-1.scale=.5\n";
  write_frames(lines);
  ASSERT_EQ(render_frames().status, 0);
  const std::string first = bytes("f001.png"), second = bytes("f002.png");
  const auto expect_refused = [&](const std::string& more, const std::string& words, int ranks = 1) {
    const CommandResult refused = render_frames(more, ranks);
    EXPECT_EQ(refused.status, 3) << more;
    EXPECT_THAT(refused.output, AllOf(HasSubstr(words), HasSubstr("--force"))) << more;
    EXPECT_EQ(bytes("f001.png"), first) << more;
    EXPECT_EQ(bytes("f002.png"), second) << more;
  };
  expect_refused("--spp 4", "f001.png: this picture is not what its line asks for: samples a pixel: 2, this");
  expect_refused("--max-depth 3", "this command has 3 (1 more differ)", 2);
  expect_refused("--look-at=.5,1.5,-2.9,0,1,0", "camera: ");
  expect_refused("--denoise", "--denoise: no, this command has yes");
  expect_refused("--target-error .1 --spp 64", "64 at most, until 0.1 relMSE");
  write_frames("--seed 2\n--set area-1.scale=.5\n");
  expect_refused("", "f001.png: this picture is not what its line asks for: seed: 1, this command has 2;");
  write_frames("--seed 1\n--set area-1.scale=.25\n");
  expect_refused("", "f002.png: this picture is not what its line asks for: values of --set: ");
  write_frames(lines);
  EXPECT_THAT(render_frames().output, HasSubstr("f002.png is there and stays"));
  const CommandResult other = run(fmt::format(
      "{} {}/examples/cornell-box/cornell-box.pbrt -o {} --quiet --force --sky 48,2,2026-06-21T12:00+02:00",
      vitrail("partition"), source_dir(), path("box.vit")));
  ASSERT_EQ(other.status, 0) << other.output;
  expect_refused("", "lights: ");
  fs::remove(directory_ / "fframes.png.json");
  expect_refused("", "does not know it");
  ASSERT_EQ(render_frames("--force").status, 0);
  EXPECT_NE(bytes("f001.png"), first);
  EXPECT_THAT(render_frames().output, HasSubstr("f001.png is there and stays"));
}

TEST_F(Frames, OfFilmsGetMoreSamplesAndAreRefusedWhereTheyDiffer) {
  write_frames("--seed 1\n--seed 2\n");
  const auto films = [&](const std::string& more) {
    return render(fmt::format("--frames {} -o {} {}", path("frames.txt"), path("f%d.film"), more));
  };
  ASSERT_EQ(films("").status, 0);
  EXPECT_THAT(films("").output, HasSubstr("f2.film is finished already"));
  EXPECT_THAT(films("--spp 3").output, HasSubstr("going on from"));
  const CommandResult refused = films("--spp 3 --max-depth 2");
  EXPECT_EQ(refused.status, 3);
  EXPECT_THAT(refused.output, AllOf(HasSubstr("f1.film"), HasSubstr("depth: ")));
}

// The picture so far is no picture of the frame.
TEST_F(Frames, ThatWereStoppedGoOn) {
  write_frames("--seed 1\n");
  const auto stopped_after = [&](const std::string& sign) {
    return run(fmt::format(
        "{0} {1} --width 32 --spp 1000000 --checkpoint-every .2 --progress lines --frames {2} -o {3} > {4} "
        "2>&1 & "
        "p=$!; for i in $(seq 600); do {5} && break; sleep .1; done; kill -TERM $p; wait $p; cat {4}",
        vitrail("render"), path("box.vit"), path("frames.txt"), path("f%03d.png"), path("log"), sign));
  };
  stopped_after(fmt::format("[ -e {} ]", path("f001.png.partial")));
  ASSERT_TRUE(fs::exists(directory_ / "f001.png"));
  EXPECT_THAT(stopped_after(fmt::format("grep -qE 'going on|stays' {}", path("log"))).output,
              HasSubstr("going on from " + path("f001.png.partial")));
}

TEST_F(Frames, WhatIsWrongIsSaidWithItsLine) {
  write_frames("--seed 1\n--seed 2 --threads 3\n");
  const CommandResult refused = render_frames();
  EXPECT_EQ(refused.status, 3);
  EXPECT_THAT(refused.output,
              AllOf(HasSubstr("frames.txt:2"), HasSubstr("--threads"), HasSubstr("--look-at")));
  write_frames("--seed x\n");
  EXPECT_THAT(render_frames().output, HasSubstr("frames.txt:1"));
  write_frames("# nothing\n");
  EXPECT_EQ(render_frames().status, 3);
  write_frames("--seed 1\n");
  const CommandResult unnumbered =
      render(fmt::format("--frames {} -o {}", path("frames.txt"), path("f.png")));
  EXPECT_EQ(unnumbered.status, 2);
  EXPECT_THAT(unnumbered.output, HasSubstr("%04d"));
  const CommandResult of_scene =
      run(fmt::format("{} {}/examples/cornell-box/cornell-box.pbrt --frames {} -o {}", vitrail("render"),
                      source_dir(), path("frames.txt"), path("f%d.png")));
  EXPECT_EQ(of_scene.status, 2);
  EXPECT_THAT(of_scene.output, HasSubstr("partition"));
}

TEST_F(Frames, OfTheExamplesAreFrames) {
  const CommandResult turned =
      run(fmt::format("/usr/bin/python3 {}/examples/frames/turntable.py --around 0,1,0 --radius 0.9 "
                      "--up y --frames 3 > {}",
                      source_dir(), path("frames.txt")));
  ASSERT_EQ(turned.status, 0) << turned.output;
  const CommandResult all = render_frames();
  EXPECT_EQ(all.status, 0) << all.output;
  EXPECT_NE(bytes("f001.png"), bytes("f003.png"));
}

// What is enough for one picture is enough for any number of them.
TEST_F(Frames, HaveTheMemoryThatOneHas) {
  const auto with_memory = [&](const std::string& memory, const std::string& more) {
    return run(fmt::format("{} {} --width 64 --spp 4 --force --quiet --memory {} {}", vitrail("render"),
                           path("box.vit"), memory, more));
  };
  std::string least = "1M";
  for (int tries = 0; tries < 6; ++tries) {
    const CommandResult one = with_memory(least, "-o " + path("one.png"));
    const std::size_t at = one.output.find("at least ");
    if (at == one.output.npos) break;
    least = one.output.substr(at + 9, one.output.find('M', at) - at - 8);
  }
  std::string seeds;
  for (int i = 1; i <= 12; ++i) seeds += fmt::format("--seed {}\n", i);
  write_frames(seeds);
  const CommandResult all =
      with_memory(least, fmt::format("--frames {} -o {}", path("frames.txt"), path("f%03d.png")));
  EXPECT_EQ(all.status, 0) << all.output;
}

}  // namespace
}  // namespace vitrail::test::frames_test
