// SPDX-License-Identifier: Apache-2.0
// Spectral bins of films: kept, merged, developed, written and read.
#include <gtest/gtest.h>

#include "film/image_io.h"
#include "scene/system/diagnostics.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::spectrum_test {
namespace {

const SpectralBins bins{4, 380, 780};

Film film(std::uint64_t seed, const SpectralBins& kept = bins) {
  FilmSettings settings;
  settings.width = 3, settings.height = 2;
  settings.crop = {0, 3, 0, 2};
  settings.imaging_ratio = 0.5;
  settings.spectrum = kept;
  return Film(settings, {1, seed});
}

TEST(SpectralFilm, KeepsMeansBesideXyz) {
  Film f = film(1);
  for (std::uint32_t i = 0; i < 4; ++i) f.count_sample(5, i);
  EXPECT_TRUE(f.deposit_bin(5, 0, 3, 6));
  EXPECT_TRUE(f.deposit_bin(5, 0, 3, -2));
  EXPECT_TRUE(f.deposit_bin(5, 1, 0, 8));
  EXPECT_FALSE(f.deposit_bin(5, 2, 0, std::numeric_limits<double>::infinity()));
  EXPECT_EQ(f.mean_of_bin(5, 3), 0.5);
  EXPECT_EQ(f.mean_of_bin(5, 0), 1);
  EXPECT_EQ(f.mean_of_bin(4, 0), 0);
  EXPECT_EQ(f.mean(5).y, 0);
  EXPECT_EQ(f.sums().size_bytes() + f.counts().size_bytes(),
            6u * ((2 + sample_groups + 4) * 16 + sample_groups * 4));
}

TEST(SpectralFilm, MergesExactlyAndOnlyWithItsLike) {
  Film a = film(1), b = film(2);
  a.count_sample(0, 0), b.count_sample(0, 0);
  a.deposit_bin(0, 0, 1, 1), b.deposit_bin(0, 0, 1, 3);
  a.merge(b);
  EXPECT_EQ(a.mean_of_bin(0, 1), 1);
  EXPECT_THROW(a.merge(film(3, {4, 380, 770})), Error);
  EXPECT_THROW(a.merge(film(3, {})), Error);
}

TEST(SpectralFilm, HasAHashOfItsBins) {
  Film a = film(1);
  const std::uint64_t before = a.hash();
  a.deposit_bin(0, 0, 1, 1);
  EXPECT_NE(a.hash(), before);
  EXPECT_EQ(film(1, {}).hash(), film(1, SpectralBins{0, 1, 2}).hash());
}

TEST(SpectralFilm, RefusesBinsThatAreNone) {
  EXPECT_THROW(film(1, {4, 700, 700}), Error);
  EXPECT_THROW(film(1, {max_spectral_bins + 1, 360, 830}), Error);
}

TEST(SpectralPicture, IsWrittenAndReadByTheNamesOfItsWavelengths) {
  Film f = film(1);
  for (std::uint32_t p = 0; p < 6; ++p) {
    f.count_sample(p, 0);
    for (std::size_t b = 0; b < 4; ++b) f.deposit_bin(p, 0, b, static_cast<double>(p + 10 * b));
  }
  Picture picture = develop(f);
  expose(picture, 1);
  const test::TemporaryDirectory directory;
  write_picture(directory / "a.exr", picture);
  const Picture read = read_picture(directory / "a.exr");
  EXPECT_EQ(read.bins, bins);
  EXPECT_EQ(read.spectrum, picture.spectrum);
  EXPECT_EQ(read.spectrum.values[4 * 5 + 2], 25);
  EXPECT_EQ(read.rgb, picture.rgb);
  EXPECT_EQ(read.variance, picture.variance);
}

}  // namespace
}  // namespace vitrail::spectrum_test
