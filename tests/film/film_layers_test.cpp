// SPDX-License-Identifier: Apache-2.0
// What a film keeps of first surfaces: sums and ids that merge in any order, beside colours that do not know
// of them.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <random>
#include <thread>

#include "film/develop.h"
#include "film/film_progress.h"
#include "scene/system/diagnostics.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::film_layers_test {
namespace {

FilmSettings settings(const FilmLayers& layers) {
  FilmSettings s;
  s.width = 4, s.height = 3;
  s.crop = {0, 4, 0, 3};
  s.layers = layers;
  return s;
}

const FilmLayers everything{all_layers};

Film film_of(std::uint64_t seed, const FilmLayers& layers = everything) {
  return Film(settings(layers), {1, seed}, default_exponent, -40);
}

// n samples a pixel from `first` on, of values that are random numbers of `seed`.
void fill(Film& film, std::uint32_t first, std::uint32_t n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(-2, 3);
  for (std::uint32_t p = 0; p < film.pixels(); ++p)
    for (std::uint32_t s = first; s < first + n; ++s) {
      film.count_sample(p, s);
      ASSERT_TRUE(film.deposit(p, s, {1, 2, 3}));
      for (std::size_t i = 0; i < layer_count; ++i) {
        const auto layer = static_cast<Layer>(i);
        const std::array values{value(random), value(random), value(random)};
        if (!film.layers().has(layer)) continue;
        if (kind_of(layer).is_matte)
          film.put_matte(p, layer, 1 + static_cast<std::uint32_t>(random() % 12), 1);
        else if (kind_of(layer).is_id())
          film.put_id(p, s, layer, static_cast<std::uint32_t>(random()) & 0xffff);
        else
          film.deposit_layer(p, s, layer, std::span(values).first(kind_of(layer).sums));
      }
    }
}

Film sum(Film a, const Film& b) {
  a.merge(b);
  return a;
}

TEST(FilmLayers, MeansAreOfAllSamples) {
  Film film = film_of(0);
  for (std::uint32_t i = 0; i < 4; ++i) film.count_sample(5, i);
  film.deposit_layer(5, 0, Layer::position, std::array{1.0, -2.0, 0.5});
  film.deposit_layer(5, 2, Layer::position, std::array{3.0, -4.0, 0.5});
  film.deposit_layer(5, 1, Layer::depth, std::array{6.0});
  film.deposit_layer(5, 3, Layer::uv, std::array{0.25, 8.0});
  EXPECT_EQ(film.mean_of_layer(5, Layer::position, 0), 1);
  EXPECT_EQ(film.mean_of_layer(5, Layer::position, 1), -1.5);
  EXPECT_EQ(film.mean_of_layer(5, Layer::position, 2), 0.25);
  EXPECT_EQ(film.mean_of_layer(5, Layer::depth, 0), 1.5);
  EXPECT_EQ(film.mean_of_layer(5, Layer::uv, 0), 0.0625);
  EXPECT_EQ(film.mean_of_layer(5, Layer::uv, 1), 2);
  EXPECT_EQ(film.mean_of_layer(4, Layer::position, 0), 0);
  EXPECT_EQ(film.mean_of_layer(5, Layer::albedo, 0), 0);
  EXPECT_EQ(film.mean(5), XYZ{});
}

TEST(FilmLayers, TheIdIsThatOfTheFirstSample) {
  Film film = film_of(0);
  EXPECT_EQ(film.id(3, Layer::shape), 0u);
  film.put_id(3, 7, Layer::shape, 20);
  EXPECT_EQ(film.id(3, Layer::shape), 21u);
  film.put_id(3, 2, Layer::shape, 0xfffffffe);
  EXPECT_EQ(film.id(3, Layer::shape), 0xffffffffu);
  film.put_id(3, 4, Layer::shape, 3);
  EXPECT_EQ(film.id(3, Layer::shape), 0xffffffffu);
  film.put_id(3, 0, Layer::material, 0);
  EXPECT_EQ(film.id(3, Layer::material), 1u);
  EXPECT_EQ(film.id(3, Layer::primitive), 0u);
  // Of another seed's first sample as well: the lesser.
  Film other = film_of(1);
  other.put_id(3, 2, Layer::shape, 5);
  other.put_id(3, 1, Layer::material, 8);
  EXPECT_EQ(sum(film, other).id(3, Layer::shape), 6u);
  EXPECT_EQ(sum(other, film).id(3, Layer::shape), 6u);
  EXPECT_EQ(sum(film, other).id(3, Layer::material), 1u);
}

TEST(FilmLayers, MergeInAnyOrderAndDepositFromAnyThread) {
  Film whole = film_of(0), parts[3] = {film_of(0), film_of(0), film_of(0)};
  for (unsigned i = 0; i < 3; ++i) {
    fill(whole, 8 * i, 8, 100 + i);
    fill(parts[i], 8 * i, 8, 100 + i);
  }
  EXPECT_EQ(sum(sum(parts[0], parts[1]), parts[2]).hash(), whole.hash());
  EXPECT_EQ(sum(sum(parts[2], parts[0]), parts[1]).hash(), whole.hash());
  Film shared = film_of(0);
  {
    std::vector<std::jthread> threads;
    for (unsigned i = 0; i < 3; ++i) threads.emplace_back([&, i] { fill(shared, 8 * i, 8, 100 + i); });
  }
  EXPECT_EQ(shared.hash(), whole.hash());
  EXPECT_NE(parts[0].hash(), whole.hash());
}

TEST(FilmLayers, WhatCannotBeCountedIsCountedAsNotFinite) {
  Film film = film_of(0);
  film.count_sample(0, 0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  film.deposit_layer(0, 0, Layer::position, std::array{1.0, nan, 1.0});
  film.deposit_layer(0, 0, Layer::position, std::array{nan, 1.0, 1.0});
  film.deposit_layer(0, 0, Layer::uv, std::array{1.0, 0x1p41});
  film.deposit_layer(0, 0, Layer::depth, std::array{0x1p44});
  EXPECT_EQ(film.refused(), (Refused{3, 0}));
  EXPECT_FALSE(film.saturated());
  EXPECT_EQ(film.mean_of_layer(0, Layer::position, 0), 0);
  EXPECT_EQ(film.mean_of_layer(0, Layer::depth, 0), 0x1p44) << "lengths have the quantum that they ask for";
}

TEST(FilmLayers, ColoursDoNotKnowOfThem) {
  Film with = film_of(0), without = film_of(0, {});
  fill(with, 0, 16, 1);
  fill(without, 0, 16, 1);
  for (std::uint32_t p = 0; p < with.pixels(); ++p) {
    EXPECT_EQ(with.mean(p), without.mean(p));
    EXPECT_EQ(with.variance_of_mean(p), without.variance_of_mean(p));
  }
  EXPECT_EQ(without.sums().size() * sizeof(WideSum) + without.counts().size_bytes(),
            film_bytes(settings({})));
  EXPECT_EQ(std::as_const(with).sums().size_bytes() + with.counts().size_bytes() + with.ids().size_bytes() +
                with.mattes().size_bytes(),
            film_bytes(settings(everything)));
  EXPECT_EQ(film_bytes(settings(everything)) - film_bytes(settings({})), 12u * (18 * 16 + 3 * 8 + 2 * 104));
}

TEST(FilmLayers, FilesKeepThem) {
  const test::TemporaryDirectory directory;
  for (const FilmLayers& layers :
       {everything, FilmLayers{1u << static_cast<int>(Layer::shape), true}, FilmLayers{}}) {
    Film film = film_of(3, layers);
    fill(film, 0, 5, 9);
    write_film(directory / "a.film", film, {});
    const Film back = read_film(directory / "a.film", nullptr);
    EXPECT_EQ(back.hash(), film.hash());
    EXPECT_EQ(back.layers(), layers);
    EXPECT_EQ(back.length_exponent(), -40);
    EXPECT_EQ(difference(back, film), "");
  }
}

TEST(FilmLayers, AFlippedBitIsNoticed) {
  const test::TemporaryDirectory directory;
  constexpr int all_mattes = 12 * 2 * sizeof(MattePixel) + 8;  // with their checksum
  for (const auto& [what, from_end] : {std::pair("mattes", 20), {"ids", 20 + all_mattes}}) {
    Film film = film_of(3);
    fill(film, 0, 5, 9);
    write_film(directory / "a.film", film, {});
    std::fstream file(directory / "a.film", std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(-from_end, std::ios::end);
    file.put('x');
    file.close();
    try {
      read_film(directory / "a.film", nullptr);
      FAIL();
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find(what), std::string::npos) << e.what();
    }
  }
}

TEST(FilmLayers, OthersDoNotMerge) {
  const Film film = film_of(0);
  EXPECT_NE(difference(film, film_of(0, {})).find("none"), std::string::npos);
  EXPECT_NE(difference(film, film_of(0, {all_layers, true})).find("camera space"), std::string::npos);
  EXPECT_NE(difference(film, Film(settings(everything), {1}, default_exponent, -41)), "");
}

TEST(FilmLayers, DevelopIntoNamedChannels) {
  Film film = film_of(0);
  film.count_sample(2, 0);
  const XYZ white = srgb_to_xyz({1, 0.5, 0.25});
  film.deposit_layer(2, 0, Layer::albedo, std::array{white.x, white.y, white.z});
  film.deposit_layer(2, 0, Layer::position, std::array{1.0, 2.0, 3.0});
  film.deposit_layer(2, 0, Layer::depth, std::array{7.0});
  film.put_id(2, 0, Layer::material, 40);
  const Picture picture = develop(film);
  const auto channel = [&](const std::string& name) -> const PictureChannel& {
    for (const PictureChannel& c : picture.layers)
      if (c.name == name) return c;
    throw std::out_of_range(name);
  };
  EXPECT_EQ(picture.layers.size(), 29u);
  EXPECT_NEAR(channel("Albedo.R").values[2], 1, 1e-6);
  EXPECT_NEAR(channel("Albedo.G").values[2], 0.5, 1e-6);
  EXPECT_NEAR(channel("Albedo.B").values[2], 0.25, 1e-6);
  EXPECT_EQ(channel("P.Z").values[2], 3);
  EXPECT_EQ(channel("Z").values[2], 7);
  EXPECT_EQ(channel("Id.material").ids[2], 41u);
  EXPECT_EQ(channel("Id.shape").ids[2], 0u);
  EXPECT_EQ(channel("P.Z").values[1], 0);
  EXPECT_TRUE(develop(film_of(0, {})).layers.empty());
}

}  // namespace
}  // namespace vitrail::film_layers_test
