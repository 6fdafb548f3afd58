// SPDX-License-Identifier: Apache-2.0
// What a user has is not written over by a command that was meant for something else, and a command typed
// again goes on instead of beginning again.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "film/film_progress.h"
#include "tests/glazing/glazing_files.h"
#include "tests/support/background.h"
#include "tests/support/partitioned_box.h"

namespace vitrail::test::nothing_lost_test {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;
using ::testing::Not;

class NothingLost : public PartitionedBox {
 protected:
  NothingLost() : PartitionedBox(1) {}
  std::string line(const std::string& out, const std::string& more) const {
    return fmt::format("{} '{}' -o '{}' --crop 0,32,0,32 --threads 1 --stats '{}' {}", vitrail("render"),
                       path("box.vit"), path(out), path("stats.json"), more);
  }
  CommandResult render(const std::string& out, const std::string& more) const { return run(line(out, more)); }
  nlohmann::json stats() const { return read_json(directory_ / "stats.json"); }
  std::uint64_t hash(const std::string& film) const { return read_film(directory_ / film, nullptr).hash(); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(directory_ / name) << text;
  }
  std::string read(const std::string& name) const {
    std::ifstream in(directory_ / name);
    return {std::istreambuf_iterator<char>(in), {}};
  }
};

TEST_F(NothingLost, AFilmOfOtherWorkIsKept) {
  ASSERT_EQ(render("a.film", "--spp 8").status, 0);
  const std::uint64_t film = hash("a.film");
  for (const char* other : {"--spp 8 --seed 7", "--spp 8 --max-depth 2", "--spp 8 --spectral 8", "--spp 4"}) {
    const CommandResult refused = render("a.film", other);
    EXPECT_EQ(refused.status, 3) << other << refused.output;
    EXPECT_THAT(refused.output, HasSubstr("a.film: "));
    EXPECT_THAT(refused.output, HasSubstr("--force"));
    EXPECT_EQ(hash("a.film"), film) << other;
  }
  EXPECT_THAT(render("a.film", "--spp 4").output, HasSubstr("samples a pixel: 8, this command has 4"));
  EXPECT_EQ(render("a.film", "--spp 4 --force").status, 0);
  EXPECT_NE(hash("a.film"), film);
}

TEST_F(NothingLost, ABundleOfAnotherSceneIsKept) {
  write("a.pbrt", "WorldBegin\nShape \"sphere\"\n");
  write("b.pbrt", "WorldBegin\nShape \"disk\"\n");
  const auto partition = [&](const std::string& scene, const std::string& more) {
    return run(fmt::format("{} '{}' -o '{}' --domains 1 --quiet {}", vitrail("partition"), path(scene),
                           path("c.vit"), more));
  };
  ASSERT_EQ(partition("a.pbrt", "").status, 0);
  const std::string manifest = read("c.vit/manifest.json");
  const CommandResult refused = partition("b.pbrt", "");
  EXPECT_EQ(refused.status, 3);
  EXPECT_THAT(refused.output, HasSubstr("a.pbrt; --force replaces it"));
  EXPECT_EQ(read("c.vit/manifest.json"), manifest);
  EXPECT_EQ(partition("a.pbrt", "--flatten").status, 0) << "the same scene's, in another way";
  EXPECT_EQ(partition("b.pbrt", "--force").status, 0);
}

TEST_F(NothingLost, WhatIsNoFilmIsKept) {
  write("a.film", "a home video");
  const CommandResult refused = render("a.film", "--spp 1");
  EXPECT_EQ(refused.status, 3) << refused.output;
  EXPECT_THAT(refused.output, HasSubstr("not a film file"));
  EXPECT_EQ(read("a.film"), "a home video");
}

// In each format that is written: what vitrail made is replaced, what somebody made is kept.
TEST_F(NothingLost, SomebodysSceneIsKept) {
  write("a.pbrt", "WorldBegin\nLightSource \"infinite\"\nShape \"sphere\"\n");
  const auto convert = [&](const std::string& out, const std::string& more) {
    return run(fmt::format("{} '{}' '{}' --quiet {}", vitrail("convert"), path("a.pbrt"), path(out), more));
  };
  for (const char* out : {"b.pbrt", "b.xml", "b.obj", "b.ply", "b.gltf", "b.glb", "b.pov"}) {
    write(out, "somebody's");
    const CommandResult refused = convert(out, "");
    EXPECT_EQ(refused.status, 3) << out << refused.output;
    EXPECT_THAT(refused.output, HasSubstr("--force replaces it"));
    EXPECT_EQ(read(out), "somebody's");
    EXPECT_EQ(convert(out, "--force").status, 0) << out;
    EXPECT_NE(read(out), "somebody's");
    EXPECT_EQ(convert(out, "").status, 0) << out << ", which is vitrail's";
    write(out, "");
    EXPECT_EQ(convert(out, "").status, 0) << out << ", which is empty";
  }
}

TEST_F(NothingLost, SomebodysSceneIsKeptAmongMany) {
  write("a.pbrt", "WorldBegin\nLightSource \"infinite\"\nShape \"sphere\"\n");
  std::filesystem::create_directory(directory_ / "many");
  write("many/a.xml", "somebody's");
  const auto convert = [&](const std::string& more) {
    return run(
        fmt::format("{} '{}' --to xml -o '{}' {}", vitrail("convert"), path("a.pbrt"), path("many"), more));
  };
  EXPECT_NE(convert("").status, 0);
  EXPECT_EQ(read("many/a.xml"), "somebody's");
  EXPECT_EQ(convert("--force").status, 0);
  EXPECT_NE(read("many/a.xml"), "somebody's");
}

TEST_F(NothingLost, SomebodysPictureIsNotDevelopedOver) {
  ASSERT_EQ(render("a.film", "--spp 1").status, 0);
  const auto develop = [&](const std::string& out, const std::string& more) {
    return run(
        fmt::format("{} '{}' -o '{}' --quiet {}", vitrail("develop"), path("a.film"), path(out), more));
  };
  for (const char* out : {"a.exr", "a.hdr", "a.png", "a.jpg", "a.tif"}) {
    write(out, "somebody's");
    const CommandResult refused = develop(out, "");
    EXPECT_EQ(refused.status, 3) << out << refused.output;
    EXPECT_EQ(read(out), "somebody's");
    EXPECT_EQ(develop(out, "--force").status, 0) << out;
    EXPECT_EQ(develop(out, "").status, 0) << out << ", which is vitrail's";
  }
}

TEST_F(NothingLost, SomebodysPictureIsKept) {
  write("holiday.png", "a photograph");
  const CommandResult refused = render("holiday.png", "--spp 1");
  EXPECT_EQ(refused.status, 3) << refused.output;
  EXPECT_THAT(refused.output, HasSubstr("holiday.png"));
  EXPECT_EQ(read("holiday.png"), "a photograph");
  EXPECT_EQ(render("holiday.png", "--spp 1 --force").status, 0);
  EXPECT_NE(read("holiday.png"), "a photograph");
}

// Each verb's files beside what it is for: statistics, reports, tables, plots, pages.
TEST_F(NothingLost, SomebodysTextIsKept) {
  ASSERT_EQ(render("a.film", "--spp 1").status, 0);
  ASSERT_EQ(
      run(fmt::format("{} '{}' -o '{}' --quiet", vitrail("develop"), path("a.film"), path("a.exr"))).status,
      0);
  ASSERT_EQ(render("b.film", fmt::format("--spp 1 --profile '{}'", path("rays"))).status, 0);
  write("a.pbrt", "WorldBegin\nLightSource \"infinite\"\nShape \"sphere\"\n");
  const std::string render_it = fmt::format("{} '{}' -o '{}' --spp 1 --threads 1 --crop 0,8,0,8",
                                            vitrail("render"), path("box.vit"), path("c.film"));
  const std::string scene = fmt::format("'{}'", path("a.pbrt")), image = fmt::format("'{}'", path("a.exr"));
  const std::vector<std::pair<std::string, std::string>> commands = {
      {render_it, "--stats x.json"},
      {render_it, "--profile x.json"},
      {render_it, "--trace x.json"},
      {vitrail("partition") + " " + scene + " -o d.vit --domains 1", "--stats x.json"},
      {vitrail("convert") + " " + scene + " d.xml", "--report x.json"},
      {vitrail("convert") + " " + scene + " d.xml", "--report x.html"},
      {vitrail("plan") + fmt::format(" '{}' --profile '{}' --ranks 1", path("box.vit"), path("rays")),
       "--svg x.svg"},
      {vitrail("spectrum") + " --rgb .5,.2,.1", "--csv x.csv"},
      {vitrail("spectrum") + " --cube 2", "--plot x.svg"},
      {vitrail("compare") + fmt::format(" {0} {0}", image), "--html x.html"},
      {vitrail("compare") + fmt::format(" {0} {0}", image), "--heatmap x.png"},
      {vitrail("compare") + fmt::format(" {0} {0}", image), "--signed-map x.exr"},
      {vitrail("glazing") + " pane.dat", "--csv x.csv"},
      {vitrail("glazing") + " pane.dat", "--report x.json"},
      {vitrail("glazing") + " pane.dat", "--report x.html"},
      {vitrail("glazing") + " pane.dat", "--energyplus x.idf"}};
  std::string pane = optics_text;
  pane.replace(pane.find("{ }"), 3, "{ Emissivity, front back } Emis= 0.84 0.84");
  write("pane.dat", pane);
  for (const auto& [command, option] : commands) {
    SCOPED_TRACE(command + " " + option);
    const std::string file = option.substr(option.find(' ') + 1);
    const auto type = [&](const std::string& more) {
      return run(fmt::format("cd '{}' && {} {} {}", directory_.path().string(), command, option, more));
    };
    write(file, "somebody's");
    const CommandResult refused = type("");
    EXPECT_EQ(refused.status, 3) << refused.output;
    EXPECT_THAT(refused.output, ::testing::AllOf(HasSubstr(file), HasSubstr("--force")));
    EXPECT_EQ(read(file), "somebody's");
    EXPECT_EQ(type("--force").status, 0);
    EXPECT_NE(read(file), "somebody's");
    const CommandResult again = type("");
    EXPECT_THAT(again.output, Not(HasSubstr("does not say that vitrail made it"))) << "it is its own";
    std::filesystem::remove(directory_ / file);
  }
}

TEST_F(NothingLost, APreviewTakesNobodysPicture) {
  write("mine.png", "a picture");
  const std::string preview = fmt::format("--spp 8 --preview '{}'", path("mine.png"));
  const CommandResult refused = render("a.film", preview);
  EXPECT_EQ(refused.status, 3) << refused.output;
  EXPECT_THAT(refused.output, HasSubstr("mine.png: "));
  EXPECT_EQ(read("mine.png"), "a picture");
  EXPECT_EQ(render("a.film", preview + " --force").status, 0);
}

TEST_F(NothingLost, AFinishedJobSaysSo) {
  const std::string film = fmt::format("--spp 8 --film '{}'", path("a.film"));
  ASSERT_EQ(render("a.png", film).status, 0);
  write("a.png", "retouched");
  const CommandResult again = render("a.png", film);
  EXPECT_EQ(again.status, 0);
  EXPECT_THAT(again.output, HasSubstr("is finished already"));
  EXPECT_EQ(stats()["rays_camera"], 0);
  EXPECT_EQ(stats()["complete"], true);
  EXPECT_EQ(stats()["samples"], 32 * 32 * 8);
  EXPECT_EQ(read("a.png"), "retouched") << "it is newer than the film";
  EXPECT_EQ(render("a.exr", film).status, 0);
  EXPECT_TRUE(std::filesystem::exists(path("a.exr"))) << "another picture of the film";
}

TEST_F(NothingLost, MoreSamplesAreAdded) {
  ASSERT_EQ(render("whole.film", "--spp 300").status, 0);
  ASSERT_EQ(render("grown.film", "--spp 5").status, 0);
  ASSERT_EQ(render("grown.film", "--resume --spp 200").status, 0);
  EXPECT_EQ(stats()["rays_camera"], 32 * 32 * 195);
  ASSERT_EQ(render("grown.film", "--spp 300").status, 0);
  EXPECT_EQ(stats()["rays_camera"], 32 * 32 * 100);
  EXPECT_EQ(hash("grown.film"), hash("whole.film"));
  FilmProgress grown, whole;
  read_film(directory_ / "grown.film", &grown);
  read_film(directory_ / "whole.film", &whole);
  EXPECT_EQ(grown.items, whole.items);
  EXPECT_EQ(grown.done, whole.done);
  EXPECT_TRUE(grown.complete());
}

TEST_F(NothingLost, AChainOfLimitedJobsGetsToTheEnd) {
  ASSERT_EQ(render("whole.film", "--spp 1024").status, 0);
  std::uint64_t before = 0;
  int jobs = 0;
  for (bool complete = false; !complete; ++jobs) {
    ASSERT_LT(jobs, 200);
    const CommandResult job = render("a.png", "--spp 1024 --time 0.4");
    ASSERT_EQ(job.status, 0) << job.output;
    complete = stats()["complete"];
    EXPECT_GT(stats()["samples"], before);
    before = stats()["samples"];
    EXPECT_TRUE(std::filesystem::exists(path("a.png")));
  }
  EXPECT_GT(jobs, 1) << "nothing was tested";
  EXPECT_EQ(stats()["film_hash"], fmt::format("{:016x}", hash("whole.film")));
  EXPECT_FALSE(std::filesystem::exists(path("a.png.work")));
}

// An unfinished render of fewer samples goes on too, and through a checkpoint.
TEST_F(NothingLost, WhatWasStoppedGoesOnToMoreSamples) {
  ASSERT_EQ(render("whole.film", "--spp 1600").status, 0);
  Background job(line("a.film", "--spp 1200 --checkpoint-every 0.05"));
  while (job.running() && !std::filesystem::exists(path("a.film.partial"))) std::this_thread::sleep_for(5ms);
  ASSERT_TRUE(job.running());
  job.send(SIGTERM);
  EXPECT_EQ(job.wait(), 128 + SIGTERM);
  const CommandResult more = render("a.film", "--spp 1600");
  EXPECT_EQ(more.status, 0);
  EXPECT_THAT(more.output, HasSubstr("going on from"));
  EXPECT_EQ(hash("a.film"), hash("whole.film"));
  EXPECT_FALSE(std::filesystem::exists(path("a.film.partial")));
}

TEST_F(NothingLost, SignalsEndWithTheirOwnStatus) {
  for (const int number : {SIGINT, SIGTERM}) {
    const std::string film = fmt::format("{}.film", number);
    Background job(line(film, "--spp 60000"));
    std::this_thread::sleep_for(700ms);
    ASSERT_TRUE(job.running());
    job.send(number);
    EXPECT_EQ(job.wait(), 128 + number);
    EXPECT_TRUE(job.signalled()) << "a shell's loop would go on";
    EXPECT_TRUE(std::filesystem::exists(path(film + ".partial")));
    EXPECT_FALSE(std::filesystem::exists(path(film + ".lock")));
  }
}

TEST_F(NothingLost, TheSecondJobOnAnOutputIsRefused) {
  Background job(line("a.film", "--spp 60000"));
  while (job.running() && !std::filesystem::exists(path("a.film.lock"))) std::this_thread::sleep_for(5ms);
  std::this_thread::sleep_for(100ms);
  ASSERT_TRUE(job.running());
  job.send(SIGSTOP);  // its locks are held without work
  for (const std::string& more : {std::string(), fmt::format(" --film '{}'", path("a.film"))}) {
    const CommandResult second = render(more.empty() ? "a.film" : "a.png", "--spp 1 --force" + more);
    EXPECT_EQ(second.status, 4) << second.output;
    EXPECT_THAT(second.output, HasSubstr("being written by another render (process "));
    EXPECT_THAT(second.output, HasSubstr("waiting up to 5 s for its end"));
  }
  job.send(SIGKILL);
  job.wait();
  EXPECT_EQ(render("a.film", "--spp 1").status, 0) << "the lock of a killed job is free";
  EXPECT_FALSE(std::filesystem::exists(path("a.film.lock")));
}

// A rank outlives its mpirun by a moment, and one that was killed gives its locks back last.
TEST_F(NothingLost, TheNextJobWaitsForOneThatEnds) {
  Background job(line("a.film", "--spp 60000"));
  while (job.running() && !std::filesystem::exists(path("a.film.lock"))) std::this_thread::sleep_for(5ms);
  std::this_thread::sleep_for(100ms);
  ASSERT_TRUE(job.running());
  job.send(SIGSTOP);
  std::jthread killer([&] {
    std::this_thread::sleep_for(1500ms);
    job.send(SIGKILL);
  });
  const CommandResult next = render("a.film", "--spp 1 --force");
  EXPECT_EQ(next.status, 0) << next.output;
}

TEST_F(NothingLost, OutputsAreCheckedBeforeTheWork) {
  const CommandResult nowhere = run(fmt::format("{} '{}' -o '{}' --spp 60000 --stats '{}'", vitrail("render"),
                                                path("box.vit"), path("a.film"), path("no/such/stats.json")));
  EXPECT_EQ(nowhere.status, 4);
  EXPECT_THAT(nowhere.output, HasSubstr("no/such"));
  EXPECT_FALSE(std::filesystem::exists(path("a.film")));
  write("in.pbrt", "WorldBegin Shape \"sphere\"\n");
  for (const std::string& wrong :
       {fmt::format("{} '{}' '{}'", vitrail("convert"), path("in.pbrt"), path("no/a.xml")),
        fmt::format("{} '{}' '{}' --report '{}'", vitrail("convert"), path("in.pbrt"), path("a.xml"),
                    path("no/r.json")),
        fmt::format("{} '{}' -o '{}'", vitrail("partition"), path("in.pbrt"), path("no/a.vit")),
        fmt::format("{} '{}' -o '{}' --stats '{}'", vitrail("partition"), path("in.pbrt"), path("a.vit"),
                    path("no/s.json"))}) {
    const CommandResult result = run(wrong);
    EXPECT_EQ(result.status, 4) << wrong << result.output;
    EXPECT_FALSE(std::filesystem::exists(path("no"))) << wrong;
    EXPECT_FALSE(std::filesystem::exists(path("a.xml"))) << wrong;
    EXPECT_FALSE(std::filesystem::exists(path("a.vit"))) << wrong;
  }
}

}  // namespace
}  // namespace vitrail::test::nothing_lost_test
