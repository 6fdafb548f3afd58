// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "tracer/lights/sphere_map.h"

namespace vitrail {

// It is a density of directions that is constant per solid angle in each cell of a grid over a sphere's
// picture.
class DirectionTable {
 public:
  DirectionTable() = default;
  // density(x, y) ≥ 0 is that of a cell, per solid angle, in any unit. A table of zeros counts as one of
  // ones.
  DirectionTable(SphereProjection projection, int width, int height,
                 const std::function<double(int, int)>& density);

  int width() const { return width_; }
  int height() const { return height_; }
  double cell_solid_angle(int row) const;

  Vector3d sample(double u, double v) const;  // u, v in [0,1)
  double pdf(Point2d point) const;            // solid angle; by the sphere's picture
  double pdf(Vector3d direction) const {
    return pdf(sphere_point(projection_, direction));
  }  // `direction` unit

  // direction_table_lanes.h reads these.
  struct Data {
    SphereProjection projection;
    int width, height;
    const double *row_z, *rows, *columns;  // null: of no table
    const std::uint32_t *row_guide, *column_guides;
  };
  Data data() const {
    return {projection_,  width_,          height_,           row_z_.data(),
            rows_.data(), columns_.data(), row_guide_.data(), column_guides_.data()};
  }

 private:
  SphereProjection projection_ = SphereProjection::equal_area;
  int width_ = 1, height_ = 1;
  std::vector<double>
      row_z_;  // of latitude_longitude: the z of the rows' upper edges, and of the last lower one
  std::vector<double> rows_;     // cumulative, 0 … 1, height + 1
  std::vector<double> columns_;  // of each row: cumulative, 0 … 1, width + 1
  // It is GuideTable::first of the rows, and of the columns of each row, with as many cells as there are of
  // these.
  std::vector<std::uint32_t> row_guide_, column_guides_;
};

}  // namespace vitrail
