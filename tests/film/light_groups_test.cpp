// SPDX-License-Identifier: Apache-2.0
// Light that a film keeps apart: parts of a deposit add up to it in quanta.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "film/film_progress.h"
#include "film/group_mix.h"
#include "scene/system/diagnostics.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::light_groups_test {
namespace {

FilmSettings settings() {
  FilmSettings s;
  s.width = 3, s.height = 2;
  s.crop = {0, 3, 0, 2};
  return s;
}

Film film_of(const std::vector<std::string>& names, std::uint64_t seed = 0) {
  FilmKey key{.scene_hash = 1, .seed = seed};
  key.groups = {names, 77};
  return Film(settings(), key);
}

// One deposit of several groups a sample.
Film filled(const std::vector<std::string>& names, std::uint64_t seed = 0) {
  Film film = film_of(names, seed);
  std::mt19937 random(static_cast<unsigned>(seed));
  std::uniform_real_distribution<double> value(0, 1e-3);
  for (std::uint32_t p = 0; p < film.pixels(); ++p)
    for (std::uint32_t s = 0; s < 16; ++s) {
      std::vector<GroupLight> parts;
      XYZ all;
      for (std::size_t g = 0; g < names.size(); ++g) {
        parts.push_back({g, {value(random), value(random), value(random)}});
        all = {all.x + parts[g].value.x, all.y + parts[g].value.y, all.z + parts[g].value.z};
      }
      film.count_sample(p, s);
      EXPECT_TRUE(film.deposit(p, s, all, nullptr, parts));
    }
  return film;
}

TEST(LightGroups, PartsAddUpToTheDeposit) {
  const Film film = filled({"a", "b", "c"});
  for (std::uint32_t p = 0; p < film.pixels(); ++p) {
    XYZ sum;
    for (std::size_t g = 0; g < 3; ++g) {
      const XYZ c = film.mean_of_group(p, g);
      sum = {sum.x + c.x, sum.y + c.y, sum.z + c.z};
      EXPECT_NEAR(c.y, 5e-4, 3e-4);
    }
    // Of sums of 2⁻⁴⁵, which doubles add exactly.
    EXPECT_EQ(sum.x, film.mean(p).x);
    EXPECT_EQ(sum.y, film.mean(p).y);
    EXPECT_EQ(sum.z, film.mean(p).z);
  }
}

TEST(LightGroups, AreKeptInTheFile) {
  const test::TemporaryDirectory directory;
  const std::filesystem::path file = directory / "a.film";
  const Film film = filled({"day", "lamps of the hall"});
  write_film(file, film, {});
  const Film read = read_film(file, nullptr);
  EXPECT_EQ(read.key(), film.key());
  EXPECT_EQ(read.hash(), film.hash());
  EXPECT_EQ(read.mean_of_group(4, 1), film.mean_of_group(4, 1));
  // A byte of a name.
  std::fstream damaged(file, std::ios::in | std::ios::out | std::ios::binary);
  damaged.seekp(184 + 16 + 8 + 1);
  damaged.put('x');
  damaged.close();
  EXPECT_THROW(read_film(file, nullptr), Error);
}

TEST(LightGroups, OfOtherLightsDoNotMerge) {
  Film film = filled({"a", "b"}, 1);
  film.merge(filled({"a", "b"}, 2));
  EXPECT_THROW(film.merge(filled({"a", "c"}, 3)), Error);
  EXPECT_THROW(film.merge(film_of({}, 3)), Error);
  EXPECT_EQ(film_bytes(settings(), film.key()) - film_bytes(settings()), 6u * 2 * 48);
}

TEST(LightGroups, AreWeighed) {
  const Film film = filled({"a", "b"});
  const Image plain = develop(film).rgb, same = mixed_groups(film, {});
  for (std::size_t i = 0; i < plain.values.size(); ++i) EXPECT_FLOAT_EQ(same.values[i], plain.values[i]);
  const auto weights = parse_group_weights("*=0,b=2:1:0");
  const Image mixed = mixed_groups(film, weights);
  for (std::uint32_t p = 0; p < film.pixels(); ++p) {
    const RGB b = xyz_to_srgb(film.mean_of_group(p, 1));
    EXPECT_FLOAT_EQ(mixed.values[3 * p], static_cast<float>(2 * b.r));
    EXPECT_FLOAT_EQ(mixed.values[3 * p + 1], static_cast<float>(b.g));
    EXPECT_EQ(mixed.values[3 * p + 2], 0);
  }
  EXPECT_THROW(mixed_groups(film, parse_group_weights("c=1")), Error);
  for (const char* wrong : {"a", "a=", "a=1:2", "a=x", "a=1:2:3:4", "a=nan"})
    EXPECT_THROW(parse_group_weights(wrong), UsageError) << wrong;
}

TEST(LightGroups, AreChannelsOfThePicture) {
  std::vector<std::string> names;
  for (const PictureChannel& c : develop(filled({"a", "b"})).layers) names.push_back(c.name);
  EXPECT_THAT(names, testing::ElementsAre("Light.a.R", "Light.a.G", "Light.a.B", "Light.b.R", "Light.b.G",
                                          "Light.b.B"));
}

}  // namespace
}  // namespace vitrail::light_groups_test
