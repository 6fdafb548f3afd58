// SPDX-License-Identifier: Apache-2.0
#include "tracer/media/grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "scene/spectra/rgb_bands.h"
#include "tracer/simd/lanes.h"

namespace vitrail {

namespace {

// The two cells that `x` (in cells, their centres at ½) lies between, and how much each counts.
struct Between {
  int first, second;
  double of_first, of_second;
};
Between between(double x, int cells, GridEdge edge) {
  const double limit = 4.0 * cells + 4;  // far outside is as far as this
  const double at = std::clamp(x - 0.5, -limit, limit), below = std::floor(at);
  const int i = static_cast<int>(below);
  const auto there = [&](int k) {
    return edge == GridEdge::repeated ? ((k % cells) + cells) % cells : std::clamp(k, 0, cells - 1);
  };
  const auto counts = [&](int k, double weight) {
    return edge == GridEdge::zero && (k < 0 || k >= cells) ? 0 : weight;
  };
  const double weight = at - below;
  return {there(i), there(i + 1), counts(i, 1 - weight), counts(i + 1, weight)};
}

// The eight cells around a point, as the first of their values, and how much each of them counts.
struct Corner {
  const float* values;
  double weight;
};
std::array<Corner, 8> corners(const Grid& grid, Point3d p) {
  const Vector3d size = extent(grid.bounds), from = p - grid.bounds.lower;
  const auto axis = [&](int a, int cells) {
    return between(size[a] > 0 ? from[a] / size[a] * cells : 0.5, cells, grid.edge);
  };
  const Between x = axis(0, grid.nx), y = axis(1, grid.ny), z = axis(2, grid.nz);
  std::array<Corner, 8> all;
  for (std::size_t i = 0; i < 8; ++i) {
    const auto side = [&](const Between& b, std::size_t bit) {
      return i & bit ? std::pair{b.second, b.of_second} : std::pair{b.first, b.of_first};
    };
    const auto [cx, wx] = side(x, 1);
    const auto [cy, wy] = side(y, 2);
    const auto [cz, wz] = side(z, 4);
    const auto cell =
        (static_cast<std::size_t>(cz) * static_cast<std::size_t>(grid.ny) + static_cast<std::size_t>(cy)) *
            static_cast<std::size_t>(grid.nx) +
        static_cast<std::size_t>(cx);
    all[i] = {&grid.values[cell * static_cast<std::size_t>(grid.channels)], wx * wy * wz};
  }
  return all;
}

double sigmoid(double x) { return 0.5 + x / (2 * std::sqrt(1 + x * x)); }

// x(t) = constant + t·(linear + t·square) through the nodes at 360, 595 and 830 nm, t from −1 to 1.
struct Parabola {
  float constant, linear, square;
  float at(float t) const { return constant + t * (linear + t * square); }
};
Parabola parabola(const float* nodes) {
  return {nodes[1], (nodes[2] - nodes[0]) / 2, (nodes[0] + nodes[2]) / 2 - nodes[1]};
}
float parameter_at(double lambda_nm) { return static_cast<float>((lambda_nm - 595) / 235); }

// The spectra of the eight corners side by side, each with a weight.
class CornerSpectra {
 public:
  CornerSpectra(const std::array<Corner, 8>& corners, bool weigh_by_scale) {
    for (std::size_t half = 0; half < 2; ++half)
      for (int j = 0; j < 4; ++j) {
        const Corner& corner = corners[4 * half + static_cast<std::size_t>(j)];
        const Parabola p = parabola(corner.values);
        constant_[half][j] = p.constant, linear_[half][j] = p.linear, square_[half][j] = p.square;
        weight_[half][j] = static_cast<float>(corner.weight) * (weigh_by_scale ? corner.values[3] : 1);
      }
  }
  // Returns Σ weightⱼ·Sⱼ(λ).
  double sum(double lambda_nm) const {
    const float t = parameter_at(lambda_nm);
    Four s{};
    for (std::size_t half = 0; half < 2; ++half) {
      const Four x = constant_[half] + t * (linear_[half] + t * square_[half]);
      s += weight_[half] * (0.5f + x / (2 * lanes::sqrt(1 + x * x)));
    }
    return static_cast<double>((s[0] + s[1]) + (s[2] + s[3]));
  }

 private:
  using Four = lanes::Floats<4>;
  std::array<Four, 2> constant_, linear_, square_, weight_;
};

// The cells that look-ups between `lower` and `upper` read along an axis, in the grid's coordinates: as
// `between` has it, and one in a million of a cell more.
struct CellRange {
  int first, last;
  bool whole;  // nothing outside of the grid counts as 0
  bool holds(int cell) const { return first <= cell && cell <= last; }
};
CellRange cells_between(double lower, double upper, int cells, GridEdge edge) {
  constexpr double slack = 1e-6;
  const double limit = 4.0 * cells + 4;
  const auto index = [&](double x) {
    return static_cast<int>(std::floor(std::clamp(x - 0.5, -limit, limit)));
  };
  const int first = index(lower - slack), last = index(upper + slack) + 1;
  const bool whole = edge != GridEdge::zero || (first >= 0 && last < cells);
  if (edge == GridEdge::repeated && (first < 0 || last >= cells)) return {0, cells - 1, whole};
  return {std::clamp(first, 0, cells - 1), std::clamp(last, 0, cells - 1), whole};
}

// What the cells of one number that were added have between them.
struct NumberRange {
  float low = std::numeric_limits<float>::infinity(), high = 0;
  void add(const float* cell) { low = std::min(low, *cell), high = std::max(high, *cell); }
  void add(const NumberRange& r) { low = std::min(low, r.low), high = std::max(high, r.high); }
  GridRange values() const { return {low, high}; }
};

// The same of cells of bands.
struct BandRange : NumberRange {
  using NumberRange::add;
  void add(const float* cell) {
    for (int k = 0; k < band_channels; ++k) NumberRange::add(cell + k);
  }
};

// The same of cells of colours: x(t) and the scale.
struct ColorRange {
  float x_low = std::numeric_limits<float>::infinity(), x_high = -std::numeric_limits<float>::infinity();
  NumberRange scale;
  void add(const float* cell) {
    const Parabola p = parabola(cell);
    add_x(p.at(-1)), add_x(p.at(1));
    if (std::abs(p.linear) < 2 * std::abs(p.square)) add_x(p.at(-p.linear / (2 * p.square)));
    scale.add(cell + 3);
  }
  void add(const ColorRange& r) {
    x_low = std::min(x_low, r.x_low), x_high = std::max(x_high, r.x_high);
    scale.add(r.scale);
  }
  GridRange values() const {
    constexpr double slack = 1e-5;  // floats round x, S and their products by less
    const double low = sigmoid(static_cast<double>(x_low)), high = sigmoid(static_cast<double>(x_high));
    return {static_cast<float>(std::max(low - slack, 0.0) * static_cast<double>(scale.low)),
            static_cast<float>((high + slack) * static_cast<double>(scale.high))};
  }

 private:
  void add_x(float x) { x_low = std::min(x_low, x), x_high = std::max(x_high, x); }
};

using CellRanges = std::vector<CellRange>;

// Axis by axis: the cells of a row, the rows of a slice, the slices.
template <class Range>
std::vector<Range> ranges_of(const Grid& grid, const std::array<CellRanges, 3>& boxes) {
  const auto& [xs, ys, zs] = boxes;
  const auto nx = static_cast<std::size_t>(grid.nx), ny = static_cast<std::size_t>(grid.ny);
  std::vector<Range> row(nx), slice, all(xs.size() * ys.size() * zs.size());
  for (int k = 0; k < grid.nz; ++k) {
    slice.assign(xs.size() * ys.size(), {});
    for (int j = 0; j < grid.ny; ++j) {
      const std::size_t first = (static_cast<std::size_t>(k) * ny + static_cast<std::size_t>(j)) * nx;
      for (std::size_t i = 0; i < nx; ++i)
        row[i] = {}, row[i].add(&grid.values[(first + i) * static_cast<std::size_t>(grid.channels)]);
      std::vector<Range> reduced(xs.size());
      for (std::size_t x = 0; x < xs.size(); ++x)
        for (int i = xs[x].first; i <= xs[x].last; ++i) reduced[x].add(row[static_cast<std::size_t>(i)]);
      for (std::size_t y = 0; y < ys.size(); ++y)
        if (ys[y].holds(j))
          for (std::size_t x = 0; x < xs.size(); ++x) slice[y * xs.size() + x].add(reduced[x]);
    }
    for (std::size_t z = 0; z < zs.size(); ++z)
      if (zs[z].holds(k))
        for (std::size_t i = 0; i < slice.size(); ++i) all[z * slice.size() + i].add(slice[i]);
  }
  return all;
}

template <class Range>
std::vector<GridRange> value_ranges(const Grid& grid, const std::array<CellRanges, 3>& boxes) {
  const std::vector<Range> ranges = ranges_of<Range>(grid, boxes);
  std::vector<GridRange> values;
  values.reserve(ranges.size());
  for (const CellRange& z : boxes[2])
    for (const CellRange& y : boxes[1])
      for (const CellRange& x : boxes[0]) {
        GridRange range = ranges[values.size()].values();
        if (!(x.whole && y.whole && z.whole)) range.low = 0;
        values.push_back(range);
      }
  return values;
}

}  // namespace

void look_up_colors(const Grid& grid, Point3d p, std::span<const double> lambda_nm,
                    std::span<double> values) {
  const std::array<Corner, 8> around = corners(grid, p);
  if (grid.channels == band_channels) {
    std::array<double, band_channels> sums{};
    for (const Corner& c : around)
      for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += c.weight * static_cast<double>(c.values[k]);
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = sums[band_of(static_cast<float>(lambda_nm[i]))];
    return;
  }
  // pbrt's edges: Σ wᵢ·scaleᵢ·Sᵢ; Mitsuba's: Σ wᵢ·scaleᵢ times Σ wᵢ·Sᵢ.
  const bool scaled = grid.edge == GridEdge::zero;
  const CornerSpectra spectra(around, scaled);
  double scale = scaled ? 1 : 0;
  if (!scaled)
    for (const Corner& c : around) scale += c.weight * static_cast<double>(c.values[3]);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = scale > 0 ? scale * spectra.sum(lambda_nm[i]) : 0;
}

double look_up(const Grid& grid, Point3d p, int channel) {
  const Vector3d size = extent(grid.bounds), from = p - grid.bounds.lower;
  const auto axis = [&](int a, int cells) {
    return between(size[a] > 0 ? from[a] / size[a] * cells : 0.5, cells, grid.edge);
  };
  const Between x = axis(0, grid.nx), y = axis(1, grid.ny), z = axis(2, grid.nz);
  const auto value = [&](int i, int j, int k) {
    const auto at =
        (static_cast<std::size_t>(k) * static_cast<std::size_t>(grid.ny) + static_cast<std::size_t>(j)) *
            static_cast<std::size_t>(grid.nx) +
        static_cast<std::size_t>(i);
    return static_cast<double>(
        grid.values[at * static_cast<std::size_t>(grid.channels) + static_cast<std::size_t>(channel)]);
  };
  const auto row = [&](int j, int k) {
    return value(x.first, j, k) * x.of_first + value(x.second, j, k) * x.of_second;
  };
  const auto slice = [&](int k) { return row(y.first, k) * y.of_first + row(y.second, k) * y.of_second; };
  return slice(z.first) * z.of_first + slice(z.second) * z.of_second;
}

double greatest_value(const Grid& grid) {
  if (grid.values.empty()) return 0;
  if (grid.channels != color_channels)
    return static_cast<double>(*std::max_element(grid.values.begin(), grid.values.end()));
  float greatest = 0;  // of the scales: no sigmoid is above 1
  for (std::size_t i = 3; i < grid.values.size(); i += color_channels)
    greatest = std::max(greatest, grid.values[i]);
  return static_cast<double>(greatest);
}

std::vector<GridRange> value_ranges(const Grid& grid, const Planes& planes) {
  const std::array<int, 3> counts{grid.nx, grid.ny, grid.nz};
  std::array<CellRanges, 3> boxes;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const double size = extent(grid.bounds)[axis];
    const auto place = [&](double at) {
      return size > 0 ? (at - grid.bounds.lower[axis]) / size * counts[a] : 0.5;
    };
    for (std::size_t i = 0; i + 1 < planes[a].size(); ++i)
      boxes[a].push_back(cells_between(place(planes[a][i]), place(planes[a][i + 1]), counts[a], grid.edge));
  }
  if (grid.channels == band_channels) return value_ranges<BandRange>(grid, boxes);
  return has_colors(grid) ? value_ranges<ColorRange>(grid, boxes) : value_ranges<NumberRange>(grid, boxes);
}

}  // namespace vitrail
