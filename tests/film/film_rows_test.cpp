// SPDX-License-Identifier: Apache-2.0
// A film that stays in its file is the film, row by row.
#include "film/film_rows.h"

#include <gtest/gtest.h>

#include <fstream>
#include <vector>

#include "film/develop.h"
#include "film/picture_extent.h"
#include "scene/system/diagnostics.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::film_rows_test {
namespace {

class RowsOfAFilm : public testing::Test {
 protected:
  // Everything that a film keeps, in 7 of 11 rows; no two pixels are alike.
  Film film_of(std::uint64_t seed) const {
    FilmSettings settings{.width = 9, .height = 11, .crop = {1, 6, 2, 9}};
    settings.spectrum = {3, 400, 700};
    settings.layers.bits = all_layers;
    FilmKey key{.scene_hash = 11, .seed = seed};
    key.photons = {1000, 0.1, 0.7};
    key.clamp = 2;
    Film film(settings, key);
    for (std::uint32_t p = 0; p < film.pixels(); ++p)
      for (std::uint32_t s = 0; s < 2 + p % 3; ++s) {
        const double light = 0.1 * (p + 1) * static_cast<double>(s + seed);
        film.count_sample(p, s);
        film.deposit(p, s, {light, film.clamp(p, s, {light, light, light}) * light, 2 * light});
        film.deposit_bin(p, s, p % 3, light);
        film.deposit_layer(p, s, Layer::depth, std::array{3 * light});
        film.put_id(p, s, Layer::shape, p + s);
        // Pixel 30 has the most things.
        for (std::uint32_t id = 1; id <= 1 + (p == 30 ? 9 : p % 3); ++id)
          film.put_matte(p, Layer::crypto_object, 10 * id + p, 1);
      }
    return film;
  }
  FilmRows in_file(const Film& film, const char* name) const {
    write_film(directory_ / name, film, {});
    return FilmRows(directory_ / name, nullptr);
  }

  const test::TemporaryDirectory directory_;
};

template <class T>
std::vector<T> rows_of(std::span<const T> all, const Film& film, int y0, int y1, std::size_t single = 0) {
  const auto width = static_cast<std::size_t>(film.width());
  const std::size_t planes = (all.size() - single) / film.pixels();
  std::vector<T> rows;
  for (std::size_t plane = 0; plane < planes; ++plane)
    for (std::size_t i = width * static_cast<std::size_t>(y0); i < width * static_cast<std::size_t>(y1); ++i)
      rows.push_back(all[plane * film.pixels() + i]);
  rows.insert(rows.end(), all.end() - static_cast<std::ptrdiff_t>(single), all.end());
  return rows;
}
template <class T>
std::vector<T> values(std::span<T> of) {
  return {of.begin(), of.end()};
}

TEST_F(RowsOfAFilm, AreThoseOfTheFilm) {
  Film film = film_of(1);
  const FilmRows rows = in_file(film, "a.film");
  EXPECT_EQ(rows.settings(), film.settings());
  EXPECT_EQ(rows.samples(), film.samples());
  EXPECT_EQ(rows.pixels(), film.pixels());
  for (const auto& [y0, y1] : {std::pair{0, 7}, {0, 1}, {3, 5}, {6, 7}}) {
    Film some = rows.rows(y0, y1);
    EXPECT_EQ(some.crop(), (PixelRect{1, 6, 2 + y0, 2 + y1}));
    EXPECT_EQ(values(some.sums()), rows_of<WideSum>(film.sums(), film, y0, y1, single_sums(film.key())));
    EXPECT_EQ(values(some.counts()), rows_of<std::uint32_t>(film.counts(), film, y0, y1));
    EXPECT_EQ(values(some.ids()), rows_of<std::int64_t>(film.ids(), film, y0, y1));
    EXPECT_EQ(values(some.mattes()), rows_of<MattePixel>(film.mattes(), film, y0, y1));
    EXPECT_EQ(some.shared_error(), film.shared_error());
    const Film counts = rows.rows(y0, y1, false);
    EXPECT_EQ(counts.mean(0).y, 0);
    EXPECT_EQ(counts.samples(), some.samples());
  }
}

TEST_F(RowsOfAFilm, MergeAsTheFilmsDo) {
  Film sum = film_of(1);
  std::vector<FilmRows> files;
  files.push_back(in_file(sum, "1.film"));
  EXPECT_EQ(hash_of(files), sum.hash());
  for (const std::uint64_t seed : {2, 3}) {
    const Film more = film_of(seed);
    sum.merge(more);
    files.push_back(in_file(more, seed == 2 ? "2.film" : "3.film"));
    EXPECT_EQ(hash_of(files), sum.hash()) << seed;
  }
  Film rows = files[0].rows(2, 5);
  for (const std::size_t i : {1, 2}) rows.merge(files[i].rows(2, 5));
  EXPECT_EQ(values(rows.sums()), rows_of<WideSum>(sum.sums(), sum, 2, 5, single_sums(sum.key())));
  EXPECT_EQ(values(rows.mattes()), rows_of<MattePixel>(sum.mattes(), sum, 2, 5));
  EXPECT_EQ(difference(files[0], files[1]), "");
  FilmSettings other = sum.settings();
  other.crop.y1 = 10;
  EXPECT_EQ(difference(files[0], in_file(Film(other, sum.key()), "other.film")),
            difference(sum, Film(other, sum.key())));
}

TEST_F(RowsOfAFilm, MakeThePictureOfTheFilm) {
  const Film film = film_of(1);
  const FilmRows rows = in_file(film, "a.film");
  FilmSurvey whole;
  for (int y = 0; y < rows.height(); y += 2) add_rows(whole, rows.rows(y, std::min(y + 2, rows.height())));
  whole.hash = hash_of(std::span(&rows, 1));
  EXPECT_EQ(clamped_share(whole, rows.rows(0, 1)), film.clamped_share());
  EXPECT_EQ(share_without_matte(whole, Layer::crypto_object),
            share_without_matte(survey_of(film), Layer::crypto_object));
  EXPECT_GT(share_without_matte(whole, Layer::crypto_object), 0);
  const Picture all = develop(film);
  Picture joined;
  for (int y = 0; y < rows.height(); ++y) {
    const Picture row = develop(rows.rows(y, y + 1), whole);
    append_rows(joined, row, rows.height());
    ASSERT_EQ(row.layers.size(), all.layers.size());
    const auto expect_part = [&](const auto& part, const auto& of) {
      const auto first = of.begin() + static_cast<std::ptrdiff_t>(part.size()) * y;
      EXPECT_TRUE(std::equal(part.begin(), part.end(), first)) << y;
    };
    expect_part(row.rgb.values, all.rgb.values);
    expect_part(row.variance.values, all.variance.values);
    expect_part(row.spectrum.values, all.spectrum.values);
    for (std::size_t i = 0; i < all.layers.size(); ++i) {
      EXPECT_EQ(row.layers[i].name, all.layers[i].name);
      expect_part(row.layers[i].is_id ? std::vector<float>() : row.layers[i].values, all.layers[i].values);
      expect_part(row.layers[i].ids, all.layers[i].ids);
    }
    EXPECT_EQ(row.samples_per_pixel, all.samples_per_pixel);
    EXPECT_EQ(row.shared_error, all.shared_error);
    EXPECT_EQ(row.origin.film_hash, all.origin.film_hash);
    EXPECT_EQ(row.origin.least_samples, all.origin.least_samples);
  }
  for (const Picture& picture : {joined, develop(rows)}) {
    for (const auto image : {&Picture::rgb, &Picture::variance, &Picture::spectrum}) {
      EXPECT_EQ((picture.*image).values, (all.*image).values);
      EXPECT_EQ((picture.*image).height, (all.*image).height);
    }
    ASSERT_EQ(picture.layers.size(), all.layers.size());
    for (std::size_t i = 0; i < all.layers.size(); ++i) {
      EXPECT_EQ(picture.layers[i].ids, all.layers[i].ids);
      EXPECT_EQ(picture.layers[i].values.size(), all.layers[i].values.size());
    }
    EXPECT_EQ(picture.window, all.window);
    EXPECT_EQ(picture.mattes.size(), all.mattes.size());
    EXPECT_EQ(picture.origin.film_hash, all.origin.film_hash);
  }
  const Picture colours = develop_colors(rows);
  EXPECT_EQ(colours.rgb.values, all.rgb.values);
  EXPECT_EQ(colours.window, all.window);
  EXPECT_EQ(colours.layers.at(0).values, develop_colors(film).layers.at(0).values);
}

// Pixel p of the 35 has 2 + p mod 3 samples; an empty survey has none.
TEST_F(RowsOfAFilm, AreCountedWithTheirSamples) {
  const Film film = film_of(1);
  const FilmRows rows = in_file(film, "a.film");
  FilmSurvey parts;
  for (int y = 0; y < rows.height(); y += 3) add_rows(parts, rows.rows(y, std::min(y + 3, rows.height())));
  for (const FilmSurvey& survey : {survey_of(film), parts}) {
    EXPECT_EQ(survey.samples, 35u * 2 + 11 * (0 + 1 + 2) + (0 + 1));
    EXPECT_EQ(survey.least_samples, 2u);
    EXPECT_EQ(survey.most_samples, 4u);
  }
  EXPECT_EQ(FilmSurvey().samples, 0u);
}

// All of it is read before anything is made of it.
TEST_F(RowsOfAFilm, AreRefusedWhereTheFileIsDamaged) {
  write_film(directory_ / "a.film", film_of(1), {});
  std::fstream file(directory_ / "a.film", std::ios::binary | std::ios::in | std::ios::out);
  const auto size = static_cast<std::streamoff>(std::filesystem::file_size(directory_ / "a.film"));
  for (const std::streamoff at : {size / 4, size / 2, size - 100}) {
    file.seekg(at);
    const char byte = static_cast<char>(file.get());
    const auto put = [&](char c) { file.seekp(at), file.put(c).flush(); };
    put(static_cast<char>(byte ^ 4));
    EXPECT_THROW(FilmRows(directory_ / "a.film", nullptr), Error) << at;
    put(byte);
    EXPECT_NO_THROW(FilmRows(directory_ / "a.film", nullptr)) << at;
  }
}

}  // namespace
}  // namespace vitrail::film_rows_test
