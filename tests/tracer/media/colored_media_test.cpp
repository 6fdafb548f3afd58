// SPDX-License-Identifier: Apache-2.0
// Grids of colours in media, against what Mitsuba 3.9.1 evaluates (gridvolume in scalar_spectral).
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "partitioner/appearance/bake_media.h"
#include "tracer/media/free_flight.h"
#include "tracer/media/grid.h"

namespace vitrail::colored_media_test {
namespace {

using Values = std::array<double, 4>;
constexpr Values lambda_nm{450, 500, 550, 620};

// Two cells along x of the unit cube.
Grid two_cells(std::array<float, 3> left, std::array<float, 3> right) {
  Grid grid;
  grid.nx = 2, grid.ny = grid.nz = 1, grid.channels = 3;
  grid.values = {left[0], left[1], left[2], right[0], right[1], right[2]};
  return grid;
}

Medium baked(const Grid& sigma_t) {
  Medium medium;
  medium.coefficients = ExtinctionAlbedo{sigma_t, ConstantSpectrum{0}};
  std::vector<std::string> notes;
  const Medium result = bake_medium(medium, RgbMethod::jakob_hanika, notes).value();
  EXPECT_TRUE(notes.empty()) << notes.at(0);
  return result;
}

void expect_at(const Medium& medium, double x, const Values& expected) {
  const Grid& grid = std::get<Grid>(std::get<ExtinctionAlbedo>(medium.coefficients).sigma_t);
  ASSERT_TRUE(has_colors(grid));
  Values found;
  look_up_colors(grid, {x, 0.5, 0.5}, lambda_nm, found);
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 4e-3) << x << ' ' << i;
}

TEST(ColoredMedia, AreWhatMitsubaEvaluates) {
  const Medium medium = baked(two_cells({1, 0.2f, 0.1f}, {0.1f, 0.3f, 2}));
  expect_at(medium, 0.25, {0.121788, 0.14661, 0.236584, 0.886333});
  expect_at(medium, 0.5, {0.803713, 0.387307, 0.29881, 0.718743});
  expect_at(medium, 0.75, {1.89966, 0.739597, 0.32366, 0.143982});
}

// In bands a cell keeps its three numbers: 450 nm is blue, 500 and 550 nm are green, 620 nm is red.
TEST(ColoredMedia, OfBandsAreBlendedNumbers) {
  Medium medium;
  medium.coefficients = ExtinctionAlbedo{two_cells({1, 0.2f, 0.1f}, {0.1f, 0.3f, 2}), ConstantSpectrum{0}};
  std::vector<std::string> notes;
  const Medium result = bake_medium(medium, RgbMethod::bands, notes).value();
  EXPECT_TRUE(notes.empty());
  expect_at(result, 0.25, {0.1, 0.2, 0.2, 1});
  expect_at(result, 0.5, {1.05, 0.25, 0.25, 0.55});
  const Grid& grid = std::get<Grid>(std::get<ExtinctionAlbedo>(result.coefficients).sigma_t);
  EXPECT_EQ(greatest_value(grid), 2);
  const std::vector<GridRange> ranges = value_ranges(grid, Planes{{{0, 0.25, 1}, {0, 1}, {0, 1}}});
  EXPECT_EQ(ranges[0].low, 0.1f);
  EXPECT_EQ(ranges[1].high, 2.0f);
}

// A density has one number a cell.
TEST(ColoredMedia, DensitiesOfColorsAreTheirMeans) {
  Medium medium;
  medium.density = two_cells({1, 0.2f, 0.3f}, {0.1f, 0.3f, 2});
  std::vector<std::string> notes;
  const Medium result = bake_medium(medium, RgbMethod::jakob_hanika, notes).value();
  const Grid& density = std::get<Grid>(result.density);
  EXPECT_EQ(density.channels, 1);
  EXPECT_EQ(density.values, (std::vector{0.5f, 0.8f}));
  EXPECT_EQ(notes.size(), 1u);
}

TEST(ColoredMedia, FadeToBlack) {
  const Medium medium = baked(two_cells({1, 0.2f, 0.1f}, {0, 0, 0}));
  expect_at(medium, 0.3, {0.0986485, 0.118754, 0.191633, 0.71793});
  expect_at(medium, 0.5, {0.0304471, 0.0366526, 0.059146, 0.221583});
  expect_at(medium, 0.75, {0, 0, 0, 0});
}

// pbrt's are 0 outside of their cells, and average spectra.
TEST(ColoredMedia, OfPbrtFadeAtTheirEdges) {
  Grid cells = two_cells({1, 0.2f, 0.1f}, {0.1f, 0.3f, 2});
  cells.edge = GridEdge::zero;
  const Medium medium = baked(cells);
  const Values left{0.121788, 0.14661, 0.236584, 0.886333}, right{1.89966, 0.739597, 0.32366, 0.143982};
  const auto sum = [&](double of_left, double of_right) {
    Values v;
    for (std::size_t i = 0; i < v.size(); ++i) v[i] = of_left * left[i] + of_right * right[i];
    return v;
  };
  expect_at(medium, 0.25, left);
  expect_at(medium, 0.5, sum(0.5, 0.5));
  expect_at(medium, 0, sum(0.5, 0));
  expect_at(medium, 0.9375, sum(0, 0.625));
  expect_at(medium, -0.3, {0, 0, 0, 0});
}

// Of one channel, too: an eighth in the corners.
TEST(Grids, OfPbrtFadeAtTheirEdges) {
  Grid cell;
  cell.nx = cell.ny = cell.nz = 1, cell.values = {8}, cell.edge = GridEdge::zero;
  EXPECT_EQ(look_up(cell, {0.5, 0.5, 0.5}, 0), 8);
  EXPECT_EQ(look_up(cell, {0.5, 0.5, 0}, 0), 4);
  EXPECT_EQ(look_up(cell, {0.75, 0.5, 0.5}, 0), 6);
  EXPECT_EQ(look_up(cell, {0, 1, 0}, 0), 1);
  EXPECT_EQ(look_up(cell, {1.5, 0.5, 0.5}, 0), 0);
  cell.edge = GridEdge::held;
  EXPECT_EQ(look_up(cell, {0, 1, 7}, 0), 8);
}

// No colour is denser than the majorant that flights are sampled by.
TEST(ColoredMedia, AreBoundedByTheirScale) {
  const Medium medium = baked(two_cells({1, 0.2f, 0.1f}, {0.1f, 0.3f, 2}));
  EXPECT_EQ(greatest_value(std::get<Grid>(std::get<ExtinctionAlbedo>(medium.coefficients).sigma_t)), 4);
}

// Over a length of 1.
TEST(ColoredMedia, AttenuateEachWavelengthByItself) {
  const Medium medium = baked(two_cells({1, 0.2f, 0.1f}, {1, 0.2f, 0.1f}));
  const PreparedMedium prepared = prepare(medium);
  const SampledWavelengths wavelengths{{450, 500, 550, 620}, {1, 1, 1, 1}};
  const Values sigma_t{0.121788, 0.14661, 0.236584, 0.886333};
  Values mean{};
  constexpr int count = 20000;
  for (int i = 0; i < count; ++i) {
    RandomStream random(stream_seed({}, static_cast<std::uint64_t>(i), 0));
    const SampledSpectrum through =
        transmittance(prepared, {{0, 0.5, 0.5}, {1, 0, 0}, 1}, wavelengths, random);
    for (std::size_t k = 0; k < 4; ++k) mean[k] += static_cast<double>(through.v[k]) / count;
  }
  // The variance of a factor 1 − σ/majorant a collision is below that of e^{-majorant}: 0.5 a sample at most.
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(mean[k], std::exp(-sigma_t[k]), 5 * 0.5 / std::sqrt(count));
}

}  // namespace
}  // namespace vitrail::colored_media_test
