// SPDX-License-Identifier: Apache-2.0
// This file has samples and densities of a DirectionTable, for any number of lanes.
#pragma once

#include "tracer/lights/direction_table.h"
#include "tracer/lights/sphere_map_lanes.h"

namespace vitrail::lanes {
namespace {

namespace detail {

// They are steps of a cumulative sum.
template <class D>
struct Steps {
  IntsLike<D> index;
  D fraction;
};

// Returns the steps that hold u in [0,1), of sums from 0 to 1 in `count` steps; a step never has the height
// 0. sums(j) and first(j), which is GuideTable::first of `count` cells, are those of lane j.
template <class D, class SumsOf, class FirstOf>
VITRAIL_LANES Steps<D> find_steps(const SumsOf& sums, const FirstOf& first, int count, D u) {
  const IntsLike<D> cell = convert<std::int32_t>(u * static_cast<double>(count));
  Steps<D> steps;
  D low, high;
  for (int j = 0; j < width<D>; ++j) {
    const double* const of = sums(j);
    auto i = static_cast<int>(first(j)[lane(cell, j)]);
    while (i + 1 < count && of[i + 1] <= lane(u, j)) ++i;
    while (i > 0 && !(of[i + 1] > of[i])) --i;
    set_lane(steps.index, j, i);
    set_lane(low, j, of[i]), set_lane(high, j, of[i + 1]);
  }
  const D height = high - low;
  steps.fraction = select<D>(height > 0, lanes::clamp<D>((u - low) / height, 0.0, 1.0), fill<D>(0.5));
  return steps;
}

}  // namespace detail

// It is the place where a table puts a direction. A table by latitude and longitude gives its z at once.
template <class D>
struct TablePlace {
  PicturePoint<D> at;  // y of an equal-area table
  D z;                 // of the other
};

// u and v are in [0,1).
template <class D>
VITRAIL_LANES TablePlace<D> place_in_table(const DirectionTable& table, D u, D v) {
  const auto data = table.data();
  const detail::Steps<D> row = detail::find_steps<D>(
      [&](int) __attribute__((always_inline)) { return data.rows; },
      [&](int) __attribute__((always_inline)) { return data.row_guide; }, data.height, v);
  const detail::Steps<D> column = detail::find_steps<D>(
      [&](int j)
          __attribute__((always_inline)) { return data.columns + lane(row.index, j) * (data.width + 1); },
      [&](int j)
          __attribute__((always_inline)) { return data.column_guides + lane(row.index, j) * data.width; },
      data.width, u);
  TablePlace<D> place;
  place.at.x = (to_doubles(column.index) + column.fraction) / static_cast<double>(data.width);
  if (data.projection == SphereProjection::equal_area) {
    place.at.y = (to_doubles(row.index) + row.fraction) / static_cast<double>(data.height);
    place.z = fill<D>(0);
  } else {
    const D upper = lanes::at(data.row_z, row.index), lower = lanes::at(data.row_z + 1, row.index);
    place.at.y = fill<D>(0);
    place.z = upper + (lower - upper) * row.fraction;
  }
  return place;
}

// Returns a unit direction; u and v are in [0,1).
template <class D>
VITRAIL_LANES Vector<D> sample(const DirectionTable& table, D u, D v) {
  const TablePlace<D> place = place_in_table(table, u, v);
  if (table.data().projection == SphereProjection::equal_area) return equal_area_direction(place.at);
  const D across = safe_sqrt(1.0 - place.z * place.z), turn = 2 * pi * place.at.x;
  return {across * portable_cos(turn), across * portable_sin(turn), place.z};
}

// Returns the density per solid angle.
template <class D>
VITRAIL_LANES D pdf(const DirectionTable& table, PicturePoint<D> at) {
  using I = IntsLike<D>;
  const auto data = table.data();
  if (!data.rows) return fill<D>(0);
  const auto cell = [](D x, int count) __attribute__((always_inline)) {
    return lanes::clamp<I>(convert<std::int32_t>(x * static_cast<double>(count)), 0, count - 1);
  };
  const I column = cell(at.x, data.width), row = cell(at.y, data.height);
  const I place = row * (data.width + 1) + column;
  const D of_row = lanes::at(data.rows + 1, row) - lanes::at(data.rows, row);
  const D of_column = lanes::at(data.columns + 1, place) - lanes::at(data.columns, place);
  if (data.projection == SphereProjection::equal_area)
    return of_row * of_column / (4 * pi / data.width / data.height);
  return of_row * of_column /
         (2 * pi / data.width * (lanes::at(data.row_z, row) - lanes::at(data.row_z + 1, row)));
}

}  // namespace
}  // namespace vitrail::lanes
