// SPDX-License-Identifier: Apache-2.0
#include "tracer/lights/direction_table.h"

#include <algorithm>
#include <cmath>

#include "scene/geometry/portable_math.h"

namespace vitrail {

DirectionTable::DirectionTable(SphereProjection projection, int width, int height,
                               const std::function<double(int, int)>& density)
    : projection_(projection), width_(std::max(1, width)), height_(std::max(1, height)) {
  const auto w = static_cast<std::size_t>(width_), h = static_cast<std::size_t>(height_);
  row_z_.resize(h + 1);
  for (std::size_t y = 0; y <= h; ++y)
    row_z_[y] = portable_cos(pi * static_cast<double>(y) / static_cast<double>(h));
  rows_.assign(h + 1, 0);
  columns_.assign(h * (w + 1), 0);
  for (std::size_t y = 0; y < h; ++y) {
    double* sums = &columns_[y * (w + 1)];
    for (std::size_t x = 0; x < w; ++x) {
      const double d = density(static_cast<int>(x), static_cast<int>(y));
      sums[x + 1] = sums[x] + (d > 0 && std::isfinite(d) ? d : 0);
    }
    const double total = sums[w];
    for (std::size_t x = 1; x <= w; ++x)
      sums[x] = total > 0 ? sums[x] / total : static_cast<double>(x) / static_cast<double>(w);
    rows_[y + 1] = rows_[y] + total * cell_solid_angle(static_cast<int>(y));
  }
  const double total = rows_[h];
  for (std::size_t y = 1; y <= h; ++y)
    rows_[y] = total > 0                                     ? rows_[y] / total
               : projection_ == SphereProjection::equal_area ? static_cast<double>(y) / static_cast<double>(h)
                                                             : (1 - row_z_[y]) / 2;
  row_guide_ = GuideTable(rows_, h);
  for (std::size_t y = 0; y < h; ++y)
    column_guides_.emplace_back(std::span(columns_).subspan(y * (w + 1), w + 1), w);
}

double DirectionTable::cell_solid_angle(int row) const {
  if (projection_ == SphereProjection::equal_area) return 4 * pi / width_ / height_;
  const auto y = static_cast<std::size_t>(row);
  return 2 * pi / width_ * (row_z_[y] - row_z_[y + 1]);
}

namespace {

struct Step {
  std::size_t index = 0;
  double fraction = 0;
};

// The step of a cumulative sum from 0 to 1 that holds u in [0,1); never one of height 0.
Step find_step(std::span<const double> sums, const GuideTable& guide, double u) {
  std::size_t i = guide.bin(sums, u);
  while (i > 0 && !(sums[i + 1] > sums[i])) --i;
  const double height = sums[i + 1] - sums[i];
  return {i, height > 0 ? std::clamp((u - sums[i]) / height, 0.0, 1.0) : 0.5};
}

}  // namespace

Vector3d DirectionTable::sample(double u, double v) const {
  const auto w = static_cast<std::size_t>(width_);
  const Step row = find_step(rows_, row_guide_, v);
  const Step column =
      find_step(std::span(columns_).subspan(row.index * (w + 1), w + 1), column_guides_[row.index], u);
  const double x = (static_cast<double>(column.index) + column.fraction) / width_;
  if (projection_ == SphereProjection::equal_area)
    return sphere_direction(projection_, {x, (static_cast<double>(row.index) + row.fraction) / height_});
  const double z = row_z_[row.index] + (row_z_[row.index + 1] - row_z_[row.index]) * row.fraction;
  const double across = safe_sqrt(1 - z * z);
  return {across * portable_cos(2 * pi * x), across * portable_sin(2 * pi * x), z};
}

double DirectionTable::pdf(Point2d at) const {
  if (rows_.empty()) return 0;
  const auto column = static_cast<std::size_t>(std::clamp(static_cast<int>(at.x * width_), 0, width_ - 1));
  const auto row = static_cast<std::size_t>(std::clamp(static_cast<int>(at.y * height_), 0, height_ - 1));
  const double* sums = &columns_[row * (static_cast<std::size_t>(width_) + 1)];
  return (rows_[row + 1] - rows_[row]) * (sums[column + 1] - sums[column]) /
         cell_solid_angle(static_cast<int>(row));
}

}  // namespace vitrail
