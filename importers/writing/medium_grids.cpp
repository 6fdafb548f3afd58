// SPDX-License-Identifier: Apache-2.0
#include "importers/writing/medium_grids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>

#include "images/nanovdb.h"
#include "importers/writing/export_colors.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

constexpr std::streamoff volume_header_bytes = 48;

std::size_t count_of(const Grid& g) {
  return static_cast<std::size_t>(g.nx) * static_cast<std::size_t>(g.ny) * static_cast<std::size_t>(g.nz);
}

// What a coefficient is at a place: one or three numbers.
class Values {
 public:
  explicit Values(const VolumeParameter& value) {
    if (const auto* grid = std::get_if<Grid>(&value)) {
      grid_ = with_values(*grid);
      return;
    }
    const auto& spectrum = std::get<Spectrum>(value);
    const RGB color = factor_rgb(spectrum);
    everywhere_ = {color.r, color.g, color.b};
  }

  const std::optional<Grid>& grid() const { return grid_; }
  int channels() const {
    if (grid_) return grid_->channels;
    return everywhere_[0] == everywhere_[1] && everywhere_[1] == everywhere_[2] ? 1 : 3;
  }

  double at(Point3d p, std::size_t channel) const {
    if (!grid_) return everywhere_[channel];
    const Vector3d size = grid_->bounds.upper - grid_->bounds.lower, from = p - grid_->bounds.lower;
    const std::array<Axis, 3> axes{axis(from.x / size.x, grid_->nx), axis(from.y / size.y, grid_->ny),
                                   axis(from.z / size.z, grid_->nz)};
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
      double share = 1;
      std::array<int, 3> cell{};
      for (std::size_t i = 0; i < 3; ++i) {
        const bool upper = (corner >> i) & 1;
        share *= upper ? axes[i].share : 1 - axes[i].share;
        cell[i] = upper ? axes[i].upper : axes[i].lower;
      }
      if (share > 0) sum += share * value(cell[0], cell[1], cell[2], channel);
    }
    return sum;
  }

 private:
  struct Axis {
    int lower = 0, upper = 0;
    double share = 0;  // of the upper one
  };
  static Axis axis(double at, int count) {
    const double x = std::clamp(at * count - 0.5, 0.0, count - 1.0), lower = std::floor(x);
    const int first = static_cast<int>(lower);
    return {first, std::min(first + 1, count - 1), x - lower};
  }
  double value(int x, int y, int z, std::size_t channel) const {
    const std::size_t cell =
        (static_cast<std::size_t>(z) * static_cast<std::size_t>(grid_->ny) + static_cast<std::size_t>(y)) *
            static_cast<std::size_t>(grid_->nx) +
        static_cast<std::size_t>(x);
    const auto channels = static_cast<std::size_t>(grid_->channels);
    return static_cast<double>(grid_->values[cell * channels + std::min(channel, channels - 1)]);
  }

  std::optional<Grid> grid_;
  std::array<double, 3> everywhere_{};
};

}  // namespace

Grid with_values(const Grid& grid) {
  Grid result = grid;
  const std::size_t wanted = count_of(grid) * static_cast<std::size_t>(grid.channels);
  if (grid.values.size() == wanted && wanted > 0) return result;
  if (wanted == 0) throw Error("the file " + grid.filename + " of a grid is not there");
  if (!grid.field.empty()) {
    result.values = read_nanovdb_values(grid);
    result.filename.clear();
    result.field.clear();
    return result;
  }
  if (!grid.filename.ends_with(".vol")) throw Error("a grid of a file that is no volume of Mitsuba's");
  std::ifstream file(grid.filename, std::ios::binary);
  file.seekg(volume_header_bytes);
  result.values.resize(wanted);
  file.read(reinterpret_cast<char*>(result.values.data()),
            static_cast<std::streamsize>(wanted * sizeof(float)));
  if (!file) throw Error("the volume " + grid.filename + " is too short");
  result.filename.clear();
  return result;
}

Grid combined_cells(const VolumeParameter& a, const VolumeParameter& b,
                    const std::function<double(double, double)>& f) {
  const Values first(a), second(b);
  const bool of_second =
      !first.grid() || (second.grid() && count_of(*second.grid()) > count_of(*first.grid()));
  const Grid& cells = *(of_second ? second : first).grid();
  Grid result = cells;
  result.channels = std::max(first.channels(), second.channels());
  result.values.clear();
  const auto channels = static_cast<std::size_t>(result.channels);
  result.values.reserve(count_of(cells) * channels);
  const Vector3d size = cells.bounds.upper - cells.bounds.lower;
  for (int z = 0; z < cells.nz; ++z)
    for (int y = 0; y < cells.ny; ++y)
      for (int x = 0; x < cells.nx; ++x) {
        const Point3d p =
            cells.bounds.lower + Vector3d{size.x * (x + 0.5) / cells.nx, size.y * (y + 0.5) / cells.ny,
                                          size.z * (z + 0.5) / cells.nz};
        for (std::size_t c = 0; c < channels; ++c)
          result.values.push_back(static_cast<float>(f(first.at(p, c), second.at(p, c))));
      }
  return result;
}

Grid with_cells_around(const Grid& grid, bool zero) {
  Grid wide = grid;
  wide.nx += 2, wide.ny += 2, wide.nz += 2;
  const Vector3d size = grid.bounds.upper - grid.bounds.lower,
                 cell{size.x / grid.nx, size.y / grid.ny, size.z / grid.nz};
  wide.bounds = {grid.bounds.lower - cell, grid.bounds.upper + cell};
  const auto channels = static_cast<std::size_t>(grid.channels);
  wide.values.clear();
  wide.values.reserve(count_of(wide) * channels);
  const auto inside = [](int i, int count) { return std::clamp(i - 1, 0, count - 1); };
  for (int z = 0; z < wide.nz; ++z)
    for (int y = 0; y < wide.ny; ++y)
      for (int x = 0; x < wide.nx; ++x) {
        const int ix = inside(x, grid.nx), iy = inside(y, grid.ny), iz = inside(z, grid.nz);
        const bool beyond = ix != x - 1 || iy != y - 1 || iz != z - 1;
        const std::size_t from = ((static_cast<std::size_t>(iz) * static_cast<std::size_t>(grid.ny) +
                                   static_cast<std::size_t>(iy)) *
                                      static_cast<std::size_t>(grid.nx) +
                                  static_cast<std::size_t>(ix)) *
                                 channels;
        for (std::size_t c = 0; c < channels; ++c)
          wide.values.push_back(zero && beyond ? 0.0f : grid.values[from + c]);
      }
  return wide;
}

bool becomes_color(const VolumeParameter& value) {
  const auto* spectrum = std::get_if<Spectrum>(&value);
  return spectrum && !is_rgb(*spectrum);
}

}  // namespace vitrail
