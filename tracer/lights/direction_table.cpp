// SPDX-License-Identifier: Apache-2.0
#include "tracer/lights/direction_table.h"

#include <algorithm>
#include <cmath>

#include "scene/geometry/portable_math.h"
#include "tracer/lights/direction_table_lanes.h"
#include "tracer/sampling/guide_table.h"

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
  const auto add_guide = [](std::vector<std::uint32_t>& to, std::span<const double> sums) {
    const GuideTable guide(sums, sums.size() - 1);
    to.insert(to.end(), guide.first().begin(), guide.first().end());
  };
  add_guide(row_guide_, rows_);
  column_guides_.reserve(w * h);
  for (std::size_t y = 0; y < h; ++y)
    add_guide(column_guides_, std::span(columns_).subspan(y * (w + 1), w + 1));
}

double DirectionTable::cell_solid_angle(int row) const {
  if (projection_ == SphereProjection::equal_area) return 4 * pi / width_ / height_;
  const auto y = static_cast<std::size_t>(row);
  return 2 * pi / width_ * (row_z_[y] - row_z_[y + 1]);
}

Vector3d DirectionTable::sample(double u, double v) const {
  return lanes::lane(lanes::sample(*this, u, v), 0);
}

double DirectionTable::pdf(Point2d at) const { return lanes::pdf<double>(*this, {at.x, at.y}); }

}  // namespace vitrail
