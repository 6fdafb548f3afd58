// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

#include "film/film_progress.h"
#include "scene/system/diagnostics.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::film_file_test {
namespace {

class FilmFile : public testing::Test {
 protected:
  FilmFile() {
    FilmSettings settings;
    settings.width = 10, settings.height = 8;
    settings.crop = {2, 7, 1, 4};
    settings.imaging_ratio = 0.25;
    settings.spectrum = {3, 400, 700};
    settings.layers.add(Layer::depth);
    settings.layers.add(Layer::shape);
    film_ = Film(settings, {11, 33, 7, true, false}, -61);
    for (std::uint32_t p = 0; p < 15; ++p) {
      film_.count_sample(p, p);
      film_.deposit(p, p, {0.1 * p, 0.2 * p, 0.3 * p});
      film_.deposit_bin(p, p, p % 3, 0.5 * p);
      film_.deposit_layer(p, p, Layer::depth, std::array{0.3 * p});
      film_.put_id(p, p, Layer::shape, p);
    }
    film_.deposit(0, 0, {1e30, 0, 0});
    progress_ = {70, 16, {0xff, 0x3f}, 1.5, {4, 8}, "{\"scene\":\"a.pbrt\"}"};
    write_film(file_, film_, progress_);
  }

  std::string bytes() const {
    std::ifstream in(file_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void overwrite(const std::string& bytes) const {
    std::filesystem::remove(file_);  // a file system may sync a file that is truncated
    std::ofstream(file_, std::ios::binary) << bytes;
  }
  void expect_error(const std::string& message) const {
    try {
      read_film(file_, nullptr);
      ADD_FAILURE() << "no error";
    } catch (const Error& e) {
      EXPECT_THAT(e.what(), testing::HasSubstr(message));
      EXPECT_EQ(e.location.file, file_.string());
    }
  }

  test::TemporaryDirectory directory_;
  std::filesystem::path file_ = directory_ / "a.film";
  Film film_;
  FilmProgress progress_;
  std::vector<std::uint64_t> all_done_{(1ull << 40) - 1};
};

TEST_F(FilmFile, ComesBackAsItWas) {
  FilmProgress progress;
  const Film film = read_film(file_, &progress);
  EXPECT_EQ(film.hash(), film_.hash());
  EXPECT_EQ(film.key(), film_.key());
  EXPECT_EQ(film.key().renderer, this_renderer());
  EXPECT_EQ(film.exponent(), -61);
  EXPECT_EQ(film.refused(), (Refused{0, 1}));
  EXPECT_EQ(film.crop(), film_.crop());
  EXPECT_EQ(film.full_width(), 10);
  EXPECT_EQ(film.full_height(), 8);
  EXPECT_EQ(film.imaging_ratio(), 0.25);
  EXPECT_EQ(progress.items, 70u);
  EXPECT_EQ(progress.samples_per_pixel, 16u);
  EXPECT_EQ(progress.done, progress_.done);
  EXPECT_EQ(progress.render_time_s, 1.5);
  EXPECT_EQ(progress.earlier_ends, (std::vector<std::uint32_t>{4, 8}));
  EXPECT_EQ(progress.about, "{\"scene\":\"a.pbrt\"}");
  EXPECT_FALSE(progress.complete());
}

TEST_F(FilmFile, OfPhotonsComesBackToo) {
  for (const double clamp : {0.0, 4.0}) {
    FilmSettings settings;
    settings.width = settings.height = 3;
    settings.crop = {0, 3, 0, 3};
    Film film(settings, {.scene_hash = 2, .clamp = clamp, .photons = {1000, 0.25, 0.75}});
    for (std::uint32_t i = 0; i < 40; ++i)
      film.count_sample(i % 9, i), film.deposit(i % 9, i, {0, 1 + 0.1 * i, 0}), film.clamp(0, i, {0, 9, 0});
    EXPECT_GT(film.shared_error(), 0);
    write_film(file_, film, {40, 40, all_done_, 1, {}, {}});
    const Film read = read_film(file_, nullptr);
    EXPECT_EQ(read.hash(), film.hash());
    EXPECT_EQ(read.key(), film.key());
    EXPECT_EQ(read.shared_error(), film.shared_error());
    EXPECT_EQ(read.clamped_share(), film.clamped_share());
  }
}

TEST_F(FilmFile, OfSamplesThatSplatComesBackToo) {
  FilmSettings settings;
  settings.width = settings.height = 3;
  settings.crop = {0, 3, 0, 3};
  const Film plain(settings, {.scene_hash = 2});
  Film film(settings, {.scene_hash = 2, .clamp = 4, .splats = true});
  // Half to the pixel, a quarter to the one at its right, if that is in the picture.
  constexpr std::int32_t one = 1 << weight_bits;
  const Footprint print{0, 0, 2, 1, {one / 2, one / 4}};
  for (std::uint32_t p = 0; p < 9; ++p)
    for (std::uint32_t s = 0; s < 2; ++s) {
      film.count_sample(p, s, &print);
      ASSERT_TRUE(film.deposit(p, s, {0, 1.0 + p, 0}, &print));
    }
  film.clamp(0, 0, {0, 8, 0});
  EXPECT_DOUBLE_EQ(film.mean(0).y, 1);
  EXPECT_DOUBLE_EQ(film.mean(4).y, (5 * 2 + 4) / 3.0);
  EXPECT_EQ(film.variance_of_mean(4), 0);
  EXPECT_DOUBLE_EQ(film.clamped_share(), 4 / (4 + 2 * (0.5 * 45 + 0.25 * 27)));
  write_film(file_, film, {9, 2, {511}, 1, {}, {}});
  const Film read = read_film(file_, nullptr);
  EXPECT_EQ(read.key(), film.key());
  EXPECT_EQ(read.hash(), film.hash());
  EXPECT_EQ(read.mean(4), film.mean(4));
  EXPECT_EQ(read.clamped_share(), film.clamped_share());
  EXPECT_NE(difference(film, plain), "");
}

// Two groups of one sequence tell nothing of the error, also where they differ.
TEST_F(FilmFile, OfOneSequenceComesBackToo) {
  const auto filled = [](bool one) {
    FilmSettings settings;
    settings.width = settings.height = 1;
    settings.crop = {0, 1, 0, 1};
    Film film(settings, {.scene_hash = 2, .one_sequence = one});
    for (std::uint32_t s = 0; s < 4; ++s) {
      film.count_sample(0, s);
      EXPECT_TRUE(film.deposit(0, s, {0, 1.0 + s % 2, 0}));
    }
    return film;
  };
  const Film film = filled(true), two = filled(false);
  EXPECT_GT(two.variance_of_mean(0), 0);
  write_film(file_, film, {1, 4, {1}, 1, {}, {}});
  const Film read = read_film(file_, nullptr);
  EXPECT_EQ(read.key(), film.key());
  EXPECT_EQ(read.variance_of_mean(0), 0);
  EXPECT_NE(difference(read, two).find("one sequence"), std::string::npos);
}

// Within an adaptive round a film has the round's map, and between rounds none.
TEST_F(FilmFile, OfAdaptiveSamplesComesBackToo) {
  for (const bool open : {true, false}) {
    progress_.adaptive = true;
    progress_.earlier_ends.clear();
    progress_.more.clear();
    if (open)
      for (std::uint32_t p = 0; p < 15; ++p) progress_.more.push_back(p * p);
    write_film(file_, film_, progress_);
    FilmProgress progress;
    EXPECT_EQ(read_film(file_, &progress).hash(), film_.hash());
    EXPECT_TRUE(progress.adaptive);
    EXPECT_EQ(progress.more, progress_.more);
    const std::string good = bytes();
    for (std::size_t i = 0; i < good.size(); i += open ? 1 : 7) {
      std::string bad = good;
      bad[i] = static_cast<char>(bad[i] ^ 0x10);
      overwrite(bad);
      EXPECT_THROW(read_film(file_, nullptr), Error) << "byte " << i;
    }
    overwrite(good.substr(0, good.size() - 4));
    EXPECT_THROW(read_film(file_, nullptr), Error);
    std::filesystem::remove(file_);
  }
}

TEST_F(FilmFile, EqualFilmsGiveEqualFiles) {
  const std::string first = bytes();
  write_film(file_, film_, progress_);
  EXPECT_EQ(bytes(), first);
}

TEST_F(FilmFile, EveryChangedByteIsFound) {
  const std::string good = bytes();
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 0x10);
    overwrite(bad);
    EXPECT_THROW(read_film(file_, nullptr), Error) << "byte " << i;
  }
}

// A header whose checksum is right may still make no sense.
TEST_F(FilmFile, SenselessHeadersAreFound) {
  struct Field {
    std::size_t offset;
    std::uint32_t value;
  };
  const std::string good = bytes();
  for (const Field& f : {Field{16, 2000000}, Field{20, 1}, Field{36, 5000}, Field{116, 0x41414141},
                         Field{124, 0x80000000}, Field{128, 8}, Field{132, 901}, Field{132, 0x80000000},
                         Field{160, 1u << layer_count}, Field{160, all_layers}, Field{164, 901}}) {
    std::string bad = good;
    std::memcpy(bad.data() + f.offset, &f.value, sizeof f.value);
    if (f.offset == 116) bad.replace(104, 16, 16, 'A');
    const std::uint64_t sum = XXH3_64bits(bad.data(), 168);
    std::memcpy(bad.data() + 168, &sum, sizeof sum);
    overwrite(bad);
    EXPECT_THROW(read_film(file_, nullptr), Error) << "offset " << f.offset;
  }
}

TEST_F(FilmFile, EveryTruncationIsFound) {
  const std::string good = bytes();
  for (std::size_t length = 0; length < good.size(); ++length) {
    overwrite(good.substr(0, length));
    EXPECT_THROW(read_film(file_, nullptr), Error) << length << " bytes";
  }
  overwrite(good + '\0');
  EXPECT_THROW(read_film(file_, nullptr), Error);
}

TEST_F(FilmFile, SaysWhatIsWrong) {
  const std::string good = bytes();
  std::string other_version = good;
  other_version[8] = 9;
  overwrite(other_version);
  expect_error("version 9");
  overwrite(
      "not a film but long enough to hold a header, which is one hundred and seventy-six bytes long, and a "
      "little "
      "more, so that it is not found too short before anything of it is looked at: that takes a few words");
  expect_error("not a film file");
  std::string bad_sum = good;
  bad_sum[good.size() - 20] ^= 1;
  overwrite(bad_sum);
  expect_error("corrupt");
  std::filesystem::remove(file_);
  expect_error("cannot open");
}

TEST_F(FilmFile, RefusesWorkBeyondItsItems) {
  progress_.done[1] = 0x40;
  write_film(file_, film_, progress_);
  expect_error("beyond");
}

TEST_F(FilmFile, RefusesNumbersThatAreNotFinite) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  FilmKey key = film_.key();
  key.clamp = infinity;
  write_film(file_, Film(film_.settings(), key), progress_);
  expect_error("its header makes no sense");
  key.clamp = 0, key.threshold = std::numeric_limits<float>::infinity();
  write_film(file_, Film(film_.settings(), key), progress_);
  expect_error("its header makes no sense");
  progress_.render_time_s = infinity;
  write_film(file_, film_, progress_);
  expect_error("its header makes no sense");
}

TEST_F(FilmFile, RefusesToGoOnFromMoreThanItHas) {
  for (const std::vector<std::uint32_t>& ends : {std::vector<std::uint32_t>{8, 8}, {8, 16}}) {
    progress_.earlier_ends = ends;
    write_film(file_, film_, progress_);
    expect_error("continues from more samples");
  }
}

TEST_F(FilmFile, UnwritableFolderIsTheMachinesFault) {
  EXPECT_THROW(write_film(directory_ / "nowhere/a.film", film_, progress_), MachineError);
}

TEST(FilmProgress, IsCompleteWhenAllItemsAre) {
  EXPECT_TRUE((FilmProgress{66, 1, {~0ull, 3}, 0}.complete()));
  EXPECT_FALSE((FilmProgress{66, 1, {~0ull, 1}, 0}.complete()));
}

}  // namespace
}  // namespace vitrail::film_file_test
