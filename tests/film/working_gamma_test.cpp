// SPDX-License-Identifier: Apache-2.0
// Films of scenes that add up colours of a screen.
#include "film/working_gamma.h"

#include <gtest/gtest.h>

#include <cmath>

#include "film/develop.h"
#include "film/film_progress.h"
#include "film/group_mix.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::working_gamma_test {
namespace {

// Four pixels of a grey each, of two samples that differ by 2·`scatter`.
Film greys(double gamma, double scatter = 0, const FilmKey& key = {}) {
  FilmSettings settings;
  settings.width = 4, settings.height = 1, settings.crop = {0, 4, 0, 1};
  settings.working_gamma = gamma;
  Film film(settings, key);
  for (std::uint32_t p = 0; p < 4; ++p)
    for (std::uint32_t i = 0; i < 2; ++i) {
      const double grey = 0.25 * p + 0.1 + (i ? scatter : -scatter);
      film.count_sample(p, i);
      film.deposit(p, i, srgb_to_xyz({grey, grey, grey}));
    }
  return film;
}

// POV-Ray's pictures with assumed_gamma 2.2, 1.5 and srgb: 0.4 shows as 0.4^2.2 = 0.1332, 0.4^1.5 = 0.2530
// and 0.1329 of light.
TEST(WorkingGamma, LightIsThePowerOfTheSum) {
  EXPECT_NEAR(light_of({0.4, 0, -0.4}, 2.2).r, 0.1332, 5e-5);
  EXPECT_NEAR(light_of({0.4, 0, -0.4}, 2.2).b, -0.1332, 5e-5);
  EXPECT_NEAR(light_of({0.4, 0, 0}, 1.5).r, 0.2530, 5e-5);
  EXPECT_NEAR(light_of({0.4, 0, 0}, srgb_gamma).r, 0.1329, 5e-5);
  EXPECT_EQ(light_of({0.4, 2, 0}, 1), (RGB{0.4, 2, 0}));
}

TEST(WorkingGamma, PicturesShowLight) {
  for (const double gamma : {1.0, 2.2, srgb_gamma}) {
    const Picture picture = develop(greys(gamma));
    for (std::size_t p = 0; p < 4; ++p) {
      const double grey = 0.25 * static_cast<double>(p) + 0.1;
      const double light = gamma == srgb_gamma ? srgb_decode(grey) : std::pow(grey, gamma);
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(static_cast<double>(picture.rgb.values[3 * p + c]), light, 1e-5) << gamma;
    }
  }
}

// As far as the light of the two samples differs, for small differences.
TEST(WorkingGamma, ErrorsGrowByTheSlope) {
  constexpr double scatter = 1e-3;
  for (const double gamma : {1.0, 1.8, srgb_gamma}) {
    const Picture picture = develop(greys(gamma, scatter));
    for (std::size_t p = 0; p < 4; ++p) {
      const double grey = 0.25 * static_cast<double>(p) + 0.1;
      const double slope =
          (light_of({grey + scatter, 0, 0}, gamma).r - light_of({grey - scatter, 0, 0}, gamma).r) /
          (2 * scatter);
      EXPECT_NEAR(light_per_sum(grey, gamma), slope, 1e-4 * slope);
      EXPECT_NEAR(static_cast<double>(picture.variance.values[p]), scatter * scatter * slope * slope,
                  2e-3 * scatter * scatter * slope * slope);
    }
  }
}

TEST(WorkingGamma, LightGroupsAreSummedFirst) {
  FilmKey key;
  key.groups = {{"a", "b"}, 1};
  FilmSettings settings;
  settings.width = settings.height = 1, settings.crop = {0, 1, 0, 1};
  settings.working_gamma = 2;
  Film film(settings, key);
  film.count_sample(0, 0);
  const XYZ a = srgb_to_xyz({0.3, 0.3, 0.3}), b = srgb_to_xyz({0.2, 0.2, 0.2});
  const std::array parts{GroupLight{0, a}, GroupLight{1, b}};
  film.deposit(0, 0, {a.x + b.x, a.y + b.y, a.z + b.z}, nullptr, parts);
  EXPECT_NEAR(static_cast<double>(mixed_groups(film, {}).values[0]), 0.25, 1e-5);
  const std::vector<GroupWeight> twice{{"b", {2, 2, 2}}};
  EXPECT_NEAR(static_cast<double>(mixed_groups(film, twice).values[0]), 0.49, 1e-5);
}

TEST(WorkingGamma, FilesKeepIt) {
  const test::TemporaryDirectory folder;
  for (const double gamma : {1.0, 2.2, srgb_gamma}) {
    const Film film = greys(gamma, 0.1);
    write_film(folder / "a.film", film, {4, 2, {0xf}, 1, {}, {}});
    const Film read = read_film(folder / "a.film", nullptr);
    EXPECT_EQ(read.settings().working_gamma, gamma);
    EXPECT_EQ(read.hash(), film.hash());
    EXPECT_EQ(difference(read, film), "");
  }
}

}  // namespace
}  // namespace vitrail::working_gamma_test
