// SPDX-License-Identifier: Apache-2.0
// Which things a pixel shows: the same however its samples are put together, and by names as Cryptomatte has
// them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <numeric>
#include <random>
#include <thread>

#include "film/cryptomatte.h"
#include "film/develop.h"
#include "film/film_progress.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::mattes_test {
namespace {

struct Seen {
  std::uint32_t id;
  std::int64_t sum;
};

std::vector<Seen> samples(int things, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Seen> seen;
  for (int i = 0; i < 300; ++i)
    seen.push_back(
        {(1 + static_cast<std::uint32_t>(random()) % static_cast<std::uint32_t>(things)) * 77777777u,
         static_cast<std::int64_t>(random() % 1000) - 100});
  return seen;
}

TEST(Mattes, AreTheSameInAnyOrderAndCutAnywhere) {
  for (const int things : {1, 3, 8, 9, 40}) {
    std::vector<Seen> seen = samples(things, 5);
    MattePixel whole;
    for (const Seen& s : seen) add(whole, s.id, s.sum);
    std::mt19937 random(1);
    for (int time = 0; time < 50; ++time) {
      std::ranges::shuffle(seen, random);
      std::array<MattePixel, 5> parts;
      for (const Seen& s : seen) add(parts[random() % 5], s.id, s.sum);
      std::ranges::shuffle(parts, random);
      MattePixel sum = std::accumulate(parts.begin() + 1, parts.end(), parts[0],
                                       [](MattePixel a, const MattePixel& b) { return a += b; });
      ASSERT_EQ(sum, whole) << things;
    }
  }
}

TEST(Mattes, KeepAllOfWhatTheyKeep) {
  for (const int things : {8, 40}) {
    std::map<std::uint32_t, std::int64_t> expected;
    std::int64_t all = 0;
    MattePixel pixel;
    for (const Seen& s : samples(things, 9)) {
      add(pixel, s.id, s.sum);
      expected[s.id] += s.sum, all += s.sum;
    }
    ASSERT_EQ(expected.size(), static_cast<std::size_t>(things));
    EXPECT_EQ(pixel.covered, all);
    EXPECT_TRUE(std::ranges::is_sorted(pixel.ids));
    for (std::size_t i = 0; i < most_mattes; ++i) EXPECT_EQ(pixel.sums[i], expected.at(pixel.ids[i])) << i;
  }
}

TEST(Mattes, FromManyThreads) {
  MattePixel shared, alone;
  for (int t = 0; t < 4; ++t)
    for (const Seen& s : samples(12, static_cast<unsigned>(t))) add(alone, s.id, s.sum);
  {
    std::vector<std::jthread> threads;
    for (int t = 0; t < 4; ++t)
      threads.emplace_back([&shared, t] {
        for (const Seen& s : samples(12, static_cast<unsigned>(t))) add_shared(shared, s.id, s.sum);
      });
  }
  EXPECT_EQ(shared, alone);
}

TEST(Mattes, OfFilesMakeSense) {
  MattePixel pixel;
  EXPECT_TRUE(makes_sense(pixel));
  for (const Seen& s : samples(20, 3)) add(pixel, s.id, s.sum);
  EXPECT_TRUE(makes_sense(pixel));
  const auto with = [&](auto&& change) {
    MattePixel changed = pixel;
    change(changed);
    return makes_sense(changed);
  };
  EXPECT_FALSE(with([](MattePixel& p) { std::swap(p.ids[2], p.ids[5]); })) << "out of order";
  EXPECT_FALSE(with([](MattePixel& p) { p.ids[3] = p.ids[4]; })) << "twice";
  EXPECT_FALSE(with([](MattePixel& p) { p.ids[3] = 0; })) << "a gap";
  EXPECT_FALSE(with([](MattePixel& p) { p.sums[1] = std::int64_t{1} << 61; })) << "too much";
  EXPECT_FALSE(with([](MattePixel& p) { p.covered = std::numeric_limits<std::int64_t>::min(); }));
}

// Values of other programs' MurmurHash3_32; "bunny" is in Cryptomatte's specification.
TEST(Cryptomatte, HashesAsOthersDo) {
  EXPECT_EQ(murmur_hash(""), 0u);
  EXPECT_EQ(murmur_hash("a"), 0x3c2569b2u);
  EXPECT_EQ(murmur_hash("test"), 0xba6bd213u);
  EXPECT_EQ(murmur_hash("bunny"), 0x13851a76u);
  EXPECT_EQ(murmur_hash("hello, world"), 0x149bbb7fu);
  EXPECT_EQ(murmur_hash("The quick brown fox jumps over the lazy dog"), 0x2e4ff723u);
}

TEST(Cryptomatte, IdsAreOrdinaryFloats) {
  EXPECT_EQ(matte_id(""), 1u << 23) << "of an exponent of 0 a bit is turned";
  int turned = 0;
  for (int i = 0; i < 5000; ++i) {
    const std::string name = "shape-" + std::to_string(i);
    EXPECT_TRUE(std::isnormal(std::bit_cast<float>(matte_id(name)))) << name;
    turned += matte_id(name) != murmur_hash(name);
  }
  EXPECT_NEAR(turned, 5000 * 2 / 256, 30);
}

Film film_of(bool splats = false) {
  FilmSettings settings;
  settings.width = 4, settings.height = 3;
  settings.crop = {0, 4, 0, 3};
  settings.layers.add(Layer::shape), settings.layers.add(Layer::crypto_material);
  FilmKey key{.scene_hash = 1};
  key.splats = splats;
  return Film(settings, key);
}

TEST(Cryptomatte, TheGreatestCoverageComesFirst) {
  Film film = film_of();
  for (std::uint32_t s = 0; s < 8; ++s) {
    film.count_sample(5, s);
    if (s < 7) film.put_matte(5, Layer::crypto_material, s < 1 ? 300u : s < 5 ? 200u : 100u, 1);
  }
  EXPECT_EQ(survey_of(film).mattes[static_cast<std::size_t>(Layer::crypto_material)].most, 3u);
  const std::vector<PictureChannel> channels = matte_channels(film, Layer::crypto_material, 3);
  ASSERT_EQ(channels.size(), 8u);
  const std::vector<std::string> names{"00.R", "00.G", "00.B", "00.A", "01.R", "01.G", "01.B", "01.A"};
  const std::vector<float> values{std::bit_cast<float>(200u),
                                  0.5f,
                                  std::bit_cast<float>(100u),
                                  0.25f,
                                  std::bit_cast<float>(300u),
                                  0.125f,
                                  0.0f,
                                  0.0f};
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(channels[i].name, "CryptoMaterial" + names[i]);
    EXPECT_EQ(channels[i].values[5], values[i]) << names[i];
    EXPECT_EQ(channels[i].values[6], 0);
  }
  EXPECT_EQ(share_without_matte(survey_of(film), Layer::crypto_material), 0);
  for (std::uint32_t id = 1; id <= 9; ++id) film.put_matte(6, Layer::crypto_material, id, 1);
  EXPECT_EQ(share_without_matte(survey_of(film), Layer::crypto_material), 1.0 / 16);
}

TEST(Cryptomatte, FilmsKeepThem) {
  const test::TemporaryDirectory directory;
  Film film = film_of();
  const std::uint64_t empty = film.hash();
  for (std::uint32_t p = 0; p < film.pixels(); ++p) {
    film.count_sample(p, 0);
    film.put_matte(p, Layer::crypto_material, 1 + p, 0.5);
  }
  EXPECT_NE(film.hash(), empty);
  write_film(directory / "a.film", film, {.items = 64, .samples_per_pixel = 1, .done = {~std::uint64_t{0}}});
  Film read = read_film(directory / "a.film", nullptr);
  EXPECT_EQ(read.hash(), film.hash());
  read.merge(film);
  EXPECT_EQ(read.coverage(3, read.matte(3, Layer::crypto_material).sums[0]), 0.5);
  Film other = film_of();
  other.count_sample(3, 0);
  other.put_matte(3, Layer::crypto_material, 4, 0.25);
  const std::uint64_t before = film.hash();
  film.merge(other);
  EXPECT_NE(film.hash(), before);
}

// Splatted, a sample covers all pixels that it adds to, as its light does.
TEST(Cryptomatte, SplatsCoverAsTheirLight) {
  Film film = film_of(true);
  const Footprint spread{-1, -1, 3, 3, {1000, 2000, 1000, 2000, 50000, 2000, 1000, 2000, -536}};
  film.count_sample(5, 0, &spread);
  film.put_matte(5, Layer::crypto_material, 9, 1, &spread);
  for (const std::uint32_t p : {0u, 1u, 5u, 6u, 10u})
    EXPECT_EQ(film.coverage(p, film.matte(p, Layer::crypto_material).covered), p == 10 ? 0 : 1) << p;
  EXPECT_EQ(film.matte(3, Layer::crypto_material), MattePixel{});
}

TEST(Cryptomatte, TheManifestIsJson) {
  EXPECT_EQ(
      matte_manifest(std::vector<std::string>{"bunny", "a \"b\"", "bunny"}), "{\"a \\\"b\\\"\":\"" + [] {
        char digits[9];
        std::snprintf(digits, sizeof digits, "%08x", matte_id("a \"b\""));
        return std::string(digits);
      }() + "\",\"bunny\":\"13851a76\"}");
}

}  // namespace
}  // namespace vitrail::mattes_test
