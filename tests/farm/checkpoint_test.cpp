// SPDX-License-Identifier: Apache-2.0
// What a checkpoint has to be to be resumed, and what a film says of itself.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "film/film_progress.h"
#include "tests/support/command.h"
#include "tests/support/paths.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::checkpoint_test {
namespace {

using testing::HasSubstr;

class Checkpoint : public ::testing::Test {
 protected:
  void SetUp() override {
    const CommandResult made =
        run(fmt::format("{} '{}/examples/cornell-box/cornell-box.pbrt' -o '{}' --domains 1 --quiet",
                        vitrail("partition"), source_dir(), (directory_ / "box.vit").string()));
    ASSERT_EQ(made.status, 0) << made.output;
    ASSERT_EQ(render("").status, 0);
    std::filesystem::rename(film_, partial_);
  }
  CommandResult render(const std::string& more, int depth = 3) {
    return run(fmt::format("{} '{}' -o '{}' --crop 0,16,0,16 --spp 4 --threads 1 --max-depth {} {}",
                           vitrail("render"), (directory_ / "box.vit").string(), film_.string(), depth,
                           more));
  }
  // The same sums under another key.
  void rewrite(const FilmKey& key) {
    FilmProgress progress;
    const Film film = read_film(partial_, &progress);
    FilmSettings settings;
    settings.width = film.full_width(), settings.height = film.full_height();
    settings.crop = film.crop(), settings.imaging_ratio = film.imaging_ratio();
    Film other(settings, key, film.exponent());
    std::ranges::copy(film.sums(), other.sums().begin());
    std::ranges::copy(film.counts(), other.counts().begin());
    write_film(partial_, other, progress);
  }

  TemporaryDirectory directory_;
  std::filesystem::path film_ = directory_ / "a.film", partial_ = directory_ / "a.film.partial";
};

TEST_F(Checkpoint, OfTheSameProgramAndOptionsIsResumed) {
  const CommandResult resumed = render("--resume");
  EXPECT_EQ(resumed.status, 0) << resumed.output;
}

TEST_F(Checkpoint, LiesBesideTheFileThatALinkStandsFor) {
  const auto disk = directory_ / "disk";
  std::filesystem::create_directory(disk);
  std::filesystem::rename(partial_, disk / "real.film.partial");
  std::filesystem::create_symlink("disk/real.film", film_);
  const CommandResult resumed = render("--resume");
  EXPECT_EQ(resumed.status, 0) << resumed.output;
  EXPECT_TRUE(std::filesystem::is_symlink(film_));
  EXPECT_TRUE(std::filesystem::is_regular_file(disk / "real.film"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(disk), {}), 1) << "nothing else stays";
}

// What is gone on with is in memory once, though a film and a checkpoint lie there.
TEST_F(Checkpoint, GoingOnKeepsWithinItsMemory) {
  const auto large = directory_ / "large.film", stats = directory_ / "stats.json";
  const auto render = [&](const std::string& more) {
    return run(fmt::format("{} '{}' -o '{}' --width 900 --height 900 --max-depth 1 --threads 1 --quiet {}",
                           vitrail("render"), (directory_ / "box.vit").string(), large.string(), more));
  };
  ASSERT_EQ(render("--spp 1").status, 0);
  std::filesystem::copy_file(large, directory_ / "large.film.partial");
  const double film = static_cast<double>(std::filesystem::file_size(large));
  const auto budget = static_cast<std::uint64_t>(1.5 * film) + (40u << 20);
  const CommandResult done = render(fmt::format("--spp 2 --memory {} --stats '{}'", budget, stats.string()));
  ASSERT_EQ(done.status, 0) << done.output;
  EXPECT_EQ(read_json(stats)["samples"], 2 * 900 * 900);
  EXPECT_LE(read_json(stats)["peak_rss_bytes"].get<std::uint64_t>(), budget);
}

TEST_F(Checkpoint, OfAnotherProgramIsRefused) {
  FilmKey key = read_film(partial_, nullptr).key();
  for (const RendererVersion& older :
       {RendererVersion{"0.0.9", this_renderer().revision},
        RendererVersion{this_renderer().number, this_renderer().revision - 1}}) {
    key.renderer = older;
    rewrite(key);
    const CommandResult refused = render("--resume");
    EXPECT_EQ(refused.status, 3);
    EXPECT_THAT(refused.output, HasSubstr("a.film.partial: this checkpoint cannot be resumed"));
    EXPECT_THAT(refused.output, HasSubstr(to_string(older)));
    EXPECT_THAT(refused.output, HasSubstr(to_string(this_renderer())));
  }
}

TEST_F(Checkpoint, OfOtherOptionsIsRefused) {
  const CommandResult refused = render("--resume", 4);
  EXPECT_EQ(refused.status, 3);
  EXPECT_THAT(refused.output, HasSubstr("depth: 3, this command has 4"));
  EXPECT_EQ(render("--seed 5 --resume").status, 3);
}

TEST_F(Checkpoint, SaysWhatMadeIt) {
  const CommandResult told = run(fmt::format("{} '{}'", vitrail("inspect"), partial_.string()));
  EXPECT_EQ(told.status, 0);
  EXPECT_THAT(told.output, HasSubstr(to_string(this_renderer())));
  EXPECT_THAT(told.output, HasSubstr("max depth: 3"));
  EXPECT_THAT(told.output, HasSubstr("integrator: path"));
}

}  // namespace
}  // namespace vitrail::test::checkpoint_test
