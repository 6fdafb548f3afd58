// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/read/image_values.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "images/image_files.h"
#include "importers/povray/read/reader.h"
#include "importers/povray/read/whole.h"
#include "scene/spectra/color.h"

namespace vitrail::pov {

namespace {

enum MapType { planar = 0, spherical = 1, cylindrical = 2, toroidal = 5 };

Numbers beyond() {
  Numbers clear = Finish::grey(1);
  clear.v[4] = 1;
  return clear;
}

}  // namespace

bool keeps_numbers(const Reader& reader, const ImageMap& map) {
  const std::string suffix = std::filesystem::path(map.filename).extension().string();
  const bool has_no_curve = suffix == ".ppm" || suffix == ".pgm" || suffix == ".tif" || suffix == ".tiff";
  return !map.gamma && !map.gamma_srgb && (reader.version < 3.7 || has_no_curve);
}

ImageValues::ImageValues(Reader& reader, const ImageMap& map, const Place& place)
    : map_(map), gamma_(reader.has_no_gamma() ? 1 : reader.gamma()) {
  try {
    StoredImage stored = read_stored_image(map.filename);
    image_ = std::move(stored.image);
    decoded_ = stored.integer && gamma_.has_value() && !keeps_numbers(reader, map);
  } catch (const Error& error) {
    reader.fail(error.what(), place);
  }
}

// From the lower left; nothing: beyond an image that is there once.
std::optional<Point2d> ImageValues::square_of(Point3d p) const {
  using std::numbers::pi;
  const auto turn = [](double y, double x) { return std::atan2(y, x) / (2 * pi); };
  double u = p.x, v = p.y;
  const double across = std::hypot(p.x, p.z);
  if (map_.map_type == spherical) {
    u = turn(p.z, p.x), v = 0.5 + std::atan2(p.y, across) / pi;
  } else if (map_.map_type == cylindrical) {
    u = turn(p.z, p.x);
  } else if (map_.map_type == toroidal) {
    u = turn(p.z, p.x), v = 0.5 + turn(p.y, across - 1);
  }
  const bool around = map_.map_type != planar;
  if (map_.once && ((!around && (u < 0 || u >= 1)) || v < 0 || v >= 1)) return std::nullopt;
  if (!std::isfinite(u) || !std::isfinite(v)) return std::nullopt;
  return Point2d{u - std::floor(u), v - std::floor(v)};
}

Numbers ImageValues::pixel(int column, int row) const {
  if (map_.once) {
    column = std::clamp(column, 0, image_.width - 1), row = std::clamp(row, 0, image_.height - 1);
  } else {
    column = (column + image_.width) % image_.width, row = (row + image_.height) % image_.height;
  }
  const auto channels = static_cast<std::size_t>(image_.channels);
  const float* const v = image_.values.data() +
                         channels * (static_cast<std::size_t>(row) * static_cast<std::size_t>(image_.width) +
                                     static_cast<std::size_t>(column));
  Numbers result = Finish::grey(0);
  for (std::size_t i = 0; i < 3; ++i) result.v[i] = static_cast<double>(v[channels < 3 ? 0 : i]);
  if (image_.has_alpha()) result.v[4] = 1 - static_cast<double>(v[channels - 1]);
  return result;
}

// As light, in the numbers of the scene.
Numbers ImageValues::decoded(Numbers c) const {
  if (!decoded_) return c;
  for (std::size_t i = 0; i < 3; ++i) {
    const double v = std::clamp(c.v[i], 0.0, 1.0);
    const double light = map_.gamma ? std::pow(v, *map_.gamma) : srgb_decode(v);
    c.v[i] = *gamma_ == 1 ? light : std::pow(light, 1 / *gamma_);
  }
  return c;
}

Numbers ImageValues::looked_up(Point2d at, bool as_light) const {
  const double x = at.x * image_.width, y = (1 - at.y) * image_.height;
  const auto one = [&](int column, int row) {
    return as_light ? decoded(pixel(column, row)) : pixel(column, row);
  };
  if (map_.interpolate == 0) return one(whole(x, 0, image_.width - 1), whole(y, 0, image_.height - 1));
  const double left = std::floor(x - 0.5), top = std::floor(y - 0.5);
  const double right_share = x - 0.5 - left, low_share = y - 0.5 - top;
  Numbers sum = Finish::grey(0);
  for (int k = 0; k < 4; ++k) {
    const int i = k & 1, j = k >> 1;
    const double weight = (i ? right_share : 1 - right_share) * (j ? low_share : 1 - low_share);
    const Numbers c = one(whole(left, -1, image_.width) + i, whole(top, -1, image_.height) + j);
    for (std::size_t n = 0; n < 5; ++n) sum.v[n] += weight * c.v[n];
  }
  return sum;
}

Numbers ImageValues::color(Point3d p) const {
  const std::optional<Point2d> at = square_of(p);
  if (!at) return beyond();
  Numbers c = looked_up(*at, true);
  c.v[3] += map_.filter_all;
  c.v[4] += map_.transmit_all;
  return c;
}

double ImageValues::grey(Point3d p) const {
  const std::optional<Point2d> at = square_of(p);
  if (!at) return 0;
  const Numbers c = looked_up(*at, false);
  return 0.297 * c.v[0] + 0.589 * c.v[1] + 0.114 * c.v[2];
}

}  // namespace vitrail::pov
