// SPDX-License-Identifier: Apache-2.0
// The loop of someone who makes a scene: render, look, edit, render again, to the same picture. Each line is
// typed as such a user types it, and what comes out is asserted.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <thread>

#include "film/film_progress.h"
#include "tests/support/background.h"
#include "tests/support/command.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::edit_and_render_test {
namespace {

using namespace std::chrono_literals;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

class EditAndRender : public ::testing::Test {
 protected:
  EditAndRender() { edit({}); }

  struct Edit {
    std::string look_at = "0 0 5  0 0 0  0 1 0", color = ".5 .5 .5", power = "1 1 1";
    int width = 48;
  };
  void edit(const Edit& e) const {
    write("scene.pbrt", fmt::format("LookAt {}\nCamera \"perspective\" \"float fov\" 40\n"
                                    "Film \"rgb\" \"integer xresolution\" {} \"integer yresolution\" 32\n"
                                    "WorldBegin\nLightSource \"infinite\" \"rgb L\" [{}]\n"
                                    "Material \"diffuse\" \"rgb reflectance\" [{}]\nShape \"sphere\"\n",
                                    e.look_at, e.width, e.power, e.color));
  }
  CommandResult render(const std::string& more) const {
    return run(fmt::format("cd '{}' && {} scene.pbrt --threads 1 {}", directory_.path().string(),
                           vitrail("render"), more));
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(directory_ / name) << text;
  }
  std::string read(const std::string& name) const {
    std::ifstream in(directory_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(directory_.path()))
      names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    return names;
  }
  bool exists(const std::string& name) const { return std::filesystem::exists(directory_ / name); }
  std::string in_background(const std::string& more) const {
    return fmt::format("-C '{}' {} scene.pbrt --threads 1 --checkpoint-every 0.1 {}",
                       directory_.path().string(), vitrail("render"), more);
  }
  // Begins a render that takes long, and stops it once a checkpoint is there.
  void interrupt(const std::string& picture) const {
    Background job(in_background("--spp 400000 -o " + picture));
    while (job.running() && !exists(picture + ".partial")) std::this_thread::sleep_for(5ms);
    ASSERT_TRUE(job.running());
    job.send(SIGINT);
    EXPECT_EQ(job.wait(), 128 + SIGINT);
  }

  TemporaryDirectory directory_;
};

TEST_F(EditAndRender, APictureIsReplacedByThatOfTheEditedScene) {
  for (const char* picture : {"x.png", "x.exr", "x.jpg", "x.tif"}) {
    edit({});
    const std::string command = fmt::format("-o {} --spp 4", picture);
    const CommandResult first = render(command);
    ASSERT_EQ(first.status, 0) << first.output;
    EXPECT_THAT(files(), ElementsAre("scene.pbrt", picture)) << "something was left over";
    const std::string before = read(picture);
    edit({.look_at = "0 1 6  0 0 0  0 1 0"});
    const CommandResult second = render(command);
    EXPECT_EQ(second.status, 0) << second.output;
    EXPECT_NE(read(picture), before) << picture;
    EXPECT_THAT(files(), ElementsAre("scene.pbrt", picture));
    std::filesystem::remove(directory_ / picture);
  }
}

// The image library takes 135 MiB, whatever it writes; all that a render writes do without it.
TEST_F(EditAndRender, PicturesNeedNoImageLibrary) {
  edit({});
  for (const char* picture : {"x.png", "x.jpg", "x.exr", "x.tif"}) {
    const CommandResult made = render(fmt::format("-o {} --spp 1 --memory 40M", picture));
    EXPECT_EQ(made.status, 0) << made.output;
  }
}

// Other programs make them beside rank 0, or it reads the film once more.
TEST_F(EditAndRender, WhatShowsAPictureIsCounted) {
  edit({.width = 4000});
  const std::string here = fmt::format("cd '{}' && ", directory_.path().string());
  ASSERT_EQ(run(here + vitrail("partition") + " scene.pbrt -o s.vit --quiet").status, 0);
  const auto render_it = [&](const std::string& more) {
    return run(here + vitrail("render") + " s.vit -o x.png --spp 1 --threads 1 --force " + more);
  };
  const auto least = [&](const std::string& more) {
    const CommandResult refused = render_it("--memory 1M " + more);
    EXPECT_EQ(refused.status, 4) << refused.output;
    const std::size_t at = refused.output.find("Give at least ");
    return at == std::string::npos ? 0 : std::stoi(refused.output.substr(at + 14));
  };
  const int alone = least("");
  EXPECT_GT(alone, 10);
  EXPECT_GE(least("--preview p.webp"), alone + 136);
  EXPECT_GT(least("--display-server localhost:1"), alone);
  const int shown = least("--preview p.png");
  EXPECT_GE(shown, alone + 10);
  const CommandResult made = render_it(fmt::format("--preview p.png --memory {}M", shown));
  EXPECT_EQ(made.status, 0) << made.output;
}

TEST_F(EditAndRender, TheLastLineNamesThePicture) {
  const CommandResult done = render("-o x.png --spp 4");
  const std::string text = done.output.substr(0, done.output.size() - 1);
  EXPECT_THAT(text.substr(text.rfind('\n') + 1), HasSubstr("x.png: 4 of 4 samples a pixel after")) << text;
}

// Fewer samples, another size, seed, color or light, and the same once more.
TEST_F(EditAndRender, AnyChangeIsRendered) {
  ASSERT_EQ(render("-o x.png --spp 64").status, 0);
  for (const Edit& e : {Edit{.color = ".9 .1 .1"}, Edit{.power = "2 2 2"}, Edit{.width = 32}}) {
    edit(e);
    EXPECT_EQ(render("-o x.png --spp 64").status, 0);
  }
  for (const char* options : {"--spp 64", "--spp 16", "--spp 64 --seed 3", "--quality draft", "--time 0.3"})
    EXPECT_EQ(render(std::string("-o x.png ") + options).status, 0) << options;
}

TEST_F(EditAndRender, SomebodysPictureIsKept) {
  write("x.png", "a photograph");
  const CommandResult refused = render("-o x.png --spp 4");
  EXPECT_EQ(refused.status, 3);
  EXPECT_THAT(refused.output, AllOf(HasSubstr("x.png: "), HasSubstr("does not say that vitrail made it")));
  EXPECT_EQ(read("x.png"), "a photograph");
  EXPECT_EQ(render("-o x.png --spp 4 --force").status, 0);
}

TEST_F(EditAndRender, AFilmIsKeptWhereItIsAskedFor) {
  ASSERT_EQ(render("-o x.png --film x.film --spp 4").status, 0);
  EXPECT_THAT(files(), ElementsAre("scene.pbrt", "x.film", "x.png"));
  const CommandResult more = render("-o x.png --film x.film --spp 8");
  EXPECT_EQ(more.status, 0);
  EXPECT_THAT(more.output, HasSubstr("going on from x.film, with 4 of 8 samples a pixel"));
  const std::string film = read("x.film");
  EXPECT_EQ(render("-o x.png --spp 4").status, 0) << "without its film, which stays";
  EXPECT_EQ(read("x.film"), film);
  EXPECT_EQ(render("-o x.png --film x.png --spp 4").status, 2);
}

// Each difference with both values, and nothing else.
TEST_F(EditAndRender, ARefusalSaysExactlyWhatDiffers) {
  ASSERT_EQ(render("-o x.film --spp 64").status, 0);
  const std::string film = read("x.film");
  const auto refusal = [&](const std::string& options) {
    const CommandResult refused = render("-o x.film " + options);
    EXPECT_EQ(refused.status, 3) << options << refused.output;
    EXPECT_THAT(refused.output, HasSubstr("x.film: this film cannot be resumed. Its 64 samples a pixel"));
    const std::size_t begin = refused.output.find("lost: ") + 6;
    return refused.output.substr(begin, refused.output.find("; --force") - begin);
  };
  EXPECT_EQ(refusal("--spp 16"), "samples a pixel: 64, this command has 16");
  EXPECT_EQ(refusal("--spp 64 --seed 7"), "seed: 0, this command has 7");
  EXPECT_EQ(refusal("--spp 64 --max-depth -1"), "depth: 5, this command has no limit");
  EXPECT_EQ(refusal("--spp 64 --integrator direct --clamp 3"),
            "integrator: path, this command has direct; clamp: 0, this command has 3");
  EXPECT_EQ(refusal("--spp 64 --filter box:1"), "way to sample: as usual, this command has --filter box:1");
  edit({.look_at = "0 0 6  0 0 0  0 1 0"});
  EXPECT_EQ(
      refusal("--spp 64"),
      "camera: perspective at (0, 0, 5) along (0, 0, -1), up (0, 1, 0), this command has perspective at "
      "(0, 0, 6) "
      "along (0, 0, -1), up (0, 1, 0)");
  edit({.color = ".1 .2 .3"});
  EXPECT_THAT(refusal("--spp 64"), AllOf(HasSubstr("materials and textures: "), Not(HasSubstr(";"))));
  edit({.power = "3 3 3"});
  EXPECT_THAT(refusal("--spp 64"), AllOf(HasSubstr("lights: "), Not(HasSubstr(";"))));
  EXPECT_EQ(read("x.film"), film);
}

TEST_F(EditAndRender, AnInterruptedPictureGoesOn) {
  interrupt("x.png");
  EXPECT_FALSE(exists("x.png.work"));
  EXPECT_TRUE(exists("x.png")) << "the picture so far";
  const CommandResult again = render("-o x.png --spp 400000 --time 1");
  EXPECT_EQ(again.status, 0) << again.output;
  EXPECT_THAT(again.output, HasSubstr("going on from x.png.partial"));
  EXPECT_FALSE(exists("x.png.partial"));
}

TEST_F(EditAndRender, AnInterruptedPictureIsNotLostToAnotherOne) {
  interrupt("x.png");
  const std::string work = read("x.png.partial");
  edit({.look_at = "0 0 6  0 0 0  0 1 0"});
  const CommandResult refused = render("-o x.png --spp 400000");
  EXPECT_EQ(refused.status, 3) << refused.output;
  EXPECT_THAT(refused.output,
              AllOf(HasSubstr("x.png.partial: "), HasSubstr("this command has perspective at (0, 0, 6)")));
  EXPECT_EQ(read("x.png.partial"), work);
  EXPECT_EQ(render("-o y.png --spp 2").status, 0) << "another name";
  EXPECT_EQ(render("-o x.png --spp 2 --force").status, 0);
  EXPECT_THAT(files(), ElementsAre("scene.pbrt", "x.png", "y.png"));
}

// A time that is up is an end: its picture is there, and the next scene may have its place. The same command
// goes on.
TEST_F(EditAndRender, ATimeThatIsUpIsAnEnd) {
  const std::string command = "-o x.png --time 0.4";
  ASSERT_EQ(render(command).status, 0);
  EXPECT_THAT(files(), ElementsAre("scene.pbrt", "x.png", "x.png.work"));
  EXPECT_THAT(render(command).output, HasSubstr("going on from x.png.work"));
  edit({.color = ".1 .2 .3"});
  const CommandResult other = render(command);
  EXPECT_EQ(other.status, 0) << other.output;
  EXPECT_THAT(other.output, Not(HasSubstr("going on")));
  std::filesystem::remove(directory_ / "x.png");
  edit({});
  EXPECT_EQ(render(command).status, 3) << "samples whose picture is gone";
}

TEST_F(EditAndRender, SeveralRanksDoTheSame) {
  const auto ranks = [&](const std::string& more) {
    return run(fmt::format("cd '{}' && {} scene.pbrt --threads 1 {}", directory_.path().string(),
                           mpi_vitrail("render", 2), more));
  };
  ASSERT_EQ(ranks("-o x.png --spp 4").status, 0);
  edit({.look_at = "0 1 6  0 0 0  0 1 0"});
  const CommandResult second = ranks("-o x.png --spp 4");
  EXPECT_EQ(second.status, 0) << second.output;
  EXPECT_THAT(files(), ElementsAre("scene.pbrt", "x.png"));
}

// The supervisor watches the same lock, and a rank's death loses nothing.
TEST_F(EditAndRender, ARestartGoesOn) {
  Background job(in_background("-o x.png --spp 6000 --restarts 2"));
  while (job.running() && !exists("x.png.partial")) std::this_thread::sleep_for(5ms);
  for (const pid_t rank : job.ranks())
    if (rank != job.pid()) ::kill(rank, SIGKILL);
  EXPECT_EQ(job.wait(), 0);
  EXPECT_THAT(files(), ElementsAre("scene.pbrt", "x.png"));
}

}  // namespace
}  // namespace vitrail::test::edit_and_render_test
