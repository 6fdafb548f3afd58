// SPDX-License-Identifier: Apache-2.0
// Bounds of extinction hold, walks over them leave no gap, and flights by them have the means of closed
// forms.
#include "tracer/media/majorants.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "partitioner/appearance/bake_media.h"
#include "scene/geometry/portable_math.h"
#include "tracer/media/free_flight.h"
#include "tracer/media/grid.h"

namespace vitrail::majorants_test {
namespace {

constexpr SampledWavelengths wavelengths{{450, 500, 550, 620}, {1, 1, 1, 1}};

double number(RandomStream& random, double low, double high) { return low + (high - low) * random.next(); }

// Most cells thin, some dense, some of the least value.
Grid random_grid(std::array<int, 3> cells, int channels, GridEdge edge, std::uint64_t seed,
                 double least = 0) {
  Grid grid;
  grid.nx = cells[0], grid.ny = cells[1], grid.nz = cells[2], grid.channels = channels, grid.edge = edge;
  grid.bounds = {{-1, -2, 3}, {2, -1, 5}};
  RandomStream random(seed);
  for (int i = 0; i < cells[0] * cells[1] * cells[2] * channels; ++i) {
    const double kind = random.next(), value = random.next();
    grid.values.push_back(static_cast<float>(least + (kind < 0.2   ? 0
                                                      : kind < 0.9 ? 0.1 * value
                                                                   : 4 * value)));
  }
  return grid;
}

Medium baked(Medium medium) {
  std::vector<std::string> notes;
  return bake_medium(medium, RgbMethod::jakob_hanika, notes).value();
}

Point3d point_in(const Bounds3d& box, RandomStream& random) {
  return {number(random, box.lower.x, box.upper.x), number(random, box.lower.y, box.upper.y),
          number(random, box.lower.z, box.upper.z)};
}

// ---- Ranges of values

GridRange range_in(const Grid& grid, const Bounds3d& box) {
  Planes planes;
  for (int axis = 0; axis < 3; ++axis)
    planes[static_cast<std::size_t>(axis)] = {box.lower[axis], box.upper[axis]};
  return value_ranges(grid, planes).at(0);
}

TEST(GridRange, HoldsEveryLookUp) {
  constexpr std::array lambda_nm{360.0, 470.0, 595.0, 700.0, 830.0};
  for (const GridEdge edge : {GridEdge::repeated, GridEdge::held, GridEdge::zero})
    for (const int channels : {1, 3}) {
      Medium medium;
      medium.coefficients = ExtinctionAlbedo{random_grid({7, 1, 5}, channels, edge, 3), ConstantSpectrum{0}};
      const Medium ready = baked(medium);
      const Grid& grid = std::get<Grid>(std::get<ExtinctionAlbedo>(ready.coefficients).sigma_t);
      RandomStream random(17);
      const Bounds3d around{{-3, -4, 1}, {4, 1, 7}};
      for (int i = 0; i < 300; ++i) {
        Bounds3d box;
        extend(box, point_in(around, random));
        extend(box, box.lower + Vector3d{random.next(), random.next(), random.next()} * (i % 2 ? 1.0 : 0.1));
        const GridRange range = range_in(grid, box);
        for (int k = 0; k < 40; ++k) {
          const Point3d p = k == 0 ? box.lower : k == 1 ? box.upper : point_in(box, random);
          std::array<double, lambda_nm.size()> values;
          if (has_colors(grid))
            look_up_colors(grid, p, lambda_nm, values);
          else
            values.fill(look_up(grid, p, 0));
          for (const double v : values) {
            ASSERT_GE(v, static_cast<double>(range.low) * (1 - 1e-6)) << channels << " channels, box " << i;
            ASSERT_LE(v, static_cast<double>(range.high) * (1 + 1e-6)) << channels << " channels, box " << i;
          }
        }
      }
    }
}

TEST(GridRange, OfManyBoxesIsThatOfEach) {
  for (const GridEdge edge : {GridEdge::repeated, GridEdge::held, GridEdge::zero})
    for (const int channels : {1, 3}) {
      Medium medium;
      medium.coefficients = ExtinctionAlbedo{random_grid({9, 5, 8}, channels, edge, 4), ConstantSpectrum{0}};
      const Medium ready = baked(medium);
      const Grid& grid = std::get<Grid>(std::get<ExtinctionAlbedo>(ready.coefficients).sigma_t);
      const Planes planes{{{-2, -0.7, 0.1, 1.9, 2.5}, {-2.2, -1.6, -1.5, -0.9}, {3, 3.3, 4.5, 5, 8}}};
      const std::vector<GridRange> ranges = value_ranges(grid, planes);
      ASSERT_EQ(ranges.size(), 4u * 3u * 4u);
      std::size_t box = 0;
      for (std::size_t z = 0; z < 4; ++z)
        for (std::size_t y = 0; y < 3; ++y)
          for (std::size_t x = 0; x < 4; ++x, ++box) {
            const GridRange one = range_in(grid, {{planes[0][x], planes[1][y], planes[2][z]},
                                                  {planes[0][x + 1], planes[1][y + 1], planes[2][z + 1]}});
            EXPECT_EQ(ranges[box].low, one.low) << box;
            EXPECT_EQ(ranges[box].high, one.high) << box;
          }
    }
}

// Where a grid is the same everywhere, nothing is left to chance: its range has no width.
TEST(GridRange, OfOneGreyIsNarrow) {
  Grid grid = random_grid({4, 4, 4}, 3, GridEdge::held, 1);
  std::ranges::fill(grid.values, 0.7f);
  Medium medium;
  medium.coefficients = ExtinctionAlbedo{grid, ConstantSpectrum{0}};
  const Medium ready = baked(medium);
  const GridRange range =
      range_in(std::get<Grid>(std::get<ExtinctionAlbedo>(ready.coefficients).sigma_t), grid.bounds);
  EXPECT_NEAR(range.low, 0.7, 2e-3);
  EXPECT_NEAR(range.high, 0.7, 2e-3);
}

// ---- Walks

// Cells follow each other without a gap, each holds the middle of its stretch, and the last ends the way.
void expect_whole_walk(const ExtinctionGrid& grid, Point3d p, Vector3d d, double first, double last) {
  CellWalk walk(grid, p, d, first, last);
  double end = first;
  for (int steps = 0;; ++steps) {
    ASSERT_LT(steps, 100);
    EXPECT_EQ(walk.begin(), end);
    EXPECT_LE(walk.begin(), walk.end());
    end = walk.end();
    const Point3d middle = p + d * ((walk.begin() + walk.end()) / 2);
    std::size_t expected = 0, stride = 1;
    bool at_a_plane = false;
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      const double at = (middle[axis] - grid.bounds.lower[axis]) / extent(grid.bounds)[axis] * grid.cells[a];
      at_a_plane |= std::abs(at - std::round(at)) < 1e-6;
      expected += static_cast<std::size_t>(std::clamp(at, 0.0, grid.cells[a] - 1.0)) * stride;
      stride *= static_cast<std::size_t>(grid.cells[a]);
    }
    if (!at_a_plane) {
      EXPECT_EQ(static_cast<std::size_t>(&walk.range() - grid.ranges.data()), expected);
    }
    if (!walk.advance()) break;
  }
  EXPECT_EQ(end, last);
}

TEST(CellWalk, LeavesNoGap) {
  ExtinctionGrid grid{{{-1, -2, 3}, {2, -1, 5}}, {7, 1, 5}, std::vector<ExtinctionRange>(35)};
  RandomStream random(5);
  const Vector3d size = extent(grid.bounds);
  for (int i = 0; i < 3000; ++i) {
    const Point3d a = point_in(grid.bounds, random);
    Point3d b = point_in(grid.bounds, random);
    // Along one or two axes, and nearly so.
    for (int axis = 0; axis < 3; ++axis)
      if (random.next() < 0.3) b[axis] = a[axis] + (i % 3 ? 0 : size[axis] * 1e-14);
    const double far = i % 5 ? 0 : 1e6;  // the ray begins there
    const Vector3d d = normalize(b - a);
    if (!(length(b - a) > 1e-9)) continue;
    const double beyond = i % 7 ? 1 : 5;  // the way ends in the grid's last cell, however long it is
    expect_whole_walk(grid, a - d * far, d, far, far + length(b - a) * beyond);
  }
}

TEST(CellWalk, OfAMediumWithoutEndIsOneCell) {
  const ExtinctionGrid grid{{}, {1, 1, 1}, std::vector<ExtinctionRange>(1)};
  CellWalk walk(grid, {1e9, 0, 0}, {0, 1, 0}, 0, std::numeric_limits<double>::infinity());
  EXPECT_EQ(walk.end(), std::numeric_limits<double>::infinity());
  EXPECT_FALSE(walk.advance());
}

// ---- Means

struct Way {
  Point3d p;
  Vector3d d;
};

// ∫ σ_t along the way to t_max at each wavelength, and σ_t at a point.
std::array<double, 4> extinction_at(const Medium& m, Point3d p) {
  std::array<double, 4> sum{};
  const auto add = [&](const VolumeParameter& v) {
    std::array<double, 4> values{};
    std::array<double, 4> lambda{};
    for (std::size_t i = 0; i < 4; ++i) lambda[i] = static_cast<double>(wavelengths.lambda_nm[i]);
    if (const auto* grid = std::get_if<Grid>(&v)) {
      if (has_colors(*grid))
        look_up_colors(*grid, p, lambda, values);
      else
        values.fill(look_up(*grid, p, 0));
    } else {
      for (std::size_t i = 0; i < 4; ++i) values[i] = evaluate(std::get<Spectrum>(v), lambda[i]);
    }
    for (std::size_t i = 0; i < 4; ++i) sum[i] += values[i];
  };
  if (const auto* e = std::get_if<ExtinctionAlbedo>(&m.coefficients)) {
    add(e->sigma_t);
  } else {
    const auto& k = std::get<AbsorptionScattering>(m.coefficients);
    add(k.sigma_a), add(k.sigma_s);
  }
  double scale = static_cast<double>(m.scale);
  if (const auto* grid = std::get_if<Grid>(&m.density)) scale *= look_up(*grid, p, 0);
  for (double& s : sum) s *= scale;
  return sum;
}

// The mean transmittance and the mean share of flights that arrive are e^{−∫σ_t}.
void expect_attenuation(const Medium& raw, const Bounds3d& bounds, const Way& way, double t_max,
                        const char* name) {
  const Medium medium = baked(raw);
  const PreparedMedium prepared = prepare(medium);
  std::array<double, 4> depth{};
  constexpr int steps = 10000;
  for (int i = 0; i < steps; ++i) {
    const Point3d p = way.p + way.d * (t_max * (i + 0.5) / steps);
    bool inside = true;
    for (int axis = 0; axis < 3; ++axis)
      inside &= p[axis] >= bounds.lower[axis] && p[axis] <= bounds.upper[axis];
    if (!inside) continue;
    const auto sigma = extinction_at(medium, p);
    for (std::size_t k = 0; k < 4; ++k) depth[k] += sigma[k] * t_max / steps;
  }
  std::array<double, 4> through{}, through2{}, arrived{}, arrived2{};
  constexpr int count = 12000;
  for (int i = 0; i < count; ++i) {
    RandomStream random(stream_seed({}, static_cast<std::uint64_t>(i), 0)),
        other(stream_seed({}, static_cast<std::uint64_t>(i), 1));
    const Flight flight{way.p, way.d, t_max};
    const SampledSpectrum t = transmittance(prepared, flight, wavelengths, random);
    const FlightSample s = sample_flight(prepared, flight, wavelengths, hero_count, filled(1), other);
    for (std::size_t k = 0; k < 4; ++k) {
      const auto x = static_cast<double>(t.v[k]), y = s.scattered_at ? 0 : static_cast<double>(s.weight.v[k]);
      through[k] += x / count, through2[k] += x * x / count, arrived[k] += y / count,
          arrived2[k] += y * y / count;
    }
  }
  for (std::size_t k = 0; k < 4; ++k) {
    const double expected = std::exp(-depth[k]);
    const auto error = [&](double mean, double square) {
      return std::sqrt(std::max(square - mean * mean, 0.0) / count);
    };
    EXPECT_NEAR(through[k], expected, 4.5 * error(through[k], through2[k]) + 1e-4) << name << ' ' << k;
    EXPECT_NEAR(arrived[k], expected, 4.5 * error(arrived[k], arrived2[k]) + 1e-4) << name << ' ' << k;
    // Chance decides on the difference to the least extinction alone: never more than whether a flight
    // arrives.
    EXPECT_LE(error(through[k], through2[k]), 1.05 * error(arrived[k], arrived2[k]) + 1e-5)
        << name << ' ' << k;
  }
}

Spectrum ramp() { return tabulate(std::vector<std::array<double, 2>>{{400, 0.3}, {700, 1.5}}, true); }

TEST(Flights, HaveTheTransmittanceOfTheirGrids) {
  const Way along{{-1.5, -1.6, 3.2}, normalize(Vector3d{3.2, 0.3, 1.4})}, axis{{2.5, -1.31, 4.2}, {-1, 0, 0}};
  for (const GridEdge edge : {GridEdge::repeated, GridEdge::held, GridEdge::zero})
    for (const Way& way : {along, axis}) {
      const double least = edge == GridEdge::held ? 0.2 : 0;
      const Grid one = random_grid({13, 6, 9}, 1, edge, 11, least),
                 colors = random_grid({10, 3, 8}, 3, edge, 12, least);
      Medium m;
      m.coefficients = AbsorptionScattering{ConstantSpectrum{0.4f}, ramp()};
      m.density = one, m.scale = 1.5f;
      expect_attenuation(m, one.bounds, way, 4, "density");
      m.density = std::monostate{};
      m.coefficients = ExtinctionAlbedo{one, ConstantSpectrum{0.5f}};
      expect_attenuation(m, one.bounds, way, 4, "σt");
      m.coefficients = AbsorptionScattering{one, colors};
      expect_attenuation(m, one.bounds, way, 4, "σa and σs");
      m.coefficients = AbsorptionScattering{ramp(), colors};
      m.density = one;
      expect_attenuation(m, one.bounds, way, 4, "density, σa and a grid of σs");
    }
}

// A cloud is as far from the origin as a city is wide, and a ray grazes its face.
TEST(Flights, FarAwayAndGrazing) {
  Grid grid = random_grid({16, 16, 16}, 1, GridEdge::held, 9);
  grid.bounds = {{1e6, 1e6, 1e6}, {1e6 + 4, 1e6 + 4, 1e6 + 4}};
  Medium m;
  m.coefficients = AbsorptionScattering{ConstantSpectrum{1}, ConstantSpectrum{1}};
  m.density = grid;
  expect_attenuation(m, grid.bounds, {{1e6 - 1, 1e6, 1e6 + 2}, {1, 0, 0}}, 7, "on a face");
  expect_attenuation(m, grid.bounds, {{1e6 - 1, 1e6 + 1e-9, 1e6 + 2}, normalize(Vector3d{1, 1e-12, 1e-3})}, 7,
                     "grazing");
}

// What is empty is crossed without a collision, and what is the same everywhere without chance.
TEST(Flights, NeedNoChanceWhereNothingVaries) {
  Grid grid = random_grid({64, 64, 64}, 1, GridEdge::held, 2);
  std::ranges::fill(grid.values, 0.5f);
  Medium m;
  m.coefficients = AbsorptionScattering{ConstantSpectrum{1}, ConstantSpectrum{2}};
  m.density = grid;
  const Medium medium = baked(m);
  const PreparedMedium prepared = prepare(medium);
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    RandomStream random(seed);
    const SampledSpectrum t = transmittance(prepared, {{-1, -1.5, 4}, {1, 0, 0}, 3}, wavelengths, random);
    for (const float v : t.v) EXPECT_NEAR(static_cast<double>(v), std::exp(-0.5 * 3 * 3), 1e-4);
  }
}

}  // namespace
}  // namespace vitrail::majorants_test
