// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/read/curve_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string_view>

#include "importers/bytes/input_bytes.h"
#include "importers/bytes/text_cursor.h"

namespace vitrail::mitsuba {

namespace {

double finite_number(TextCursor& cursor, const char* what) {
  cursor.at_line_end();
  const char* const begin = cursor.at();
  const double value = cursor.number(what);
  if (!(std::abs(value) <= std::numeric_limits<float>::max()))
    cursor.fail(fmt::format("{} is not a finite single-precision number", what), begin);
  return value;
}

CurvePoint read_point(TextCursor& cursor) {
  CurvePoint point;
  for (int axis = 0; axis < 3; ++axis) point.position[axis] = finite_number(cursor, "a coordinate");
  point.radius = finite_number(cursor, "the radius");
  if (!cursor.at_line_end()) cursor.fail("unexpected text behind the radius");
  return point;
}

// Of the curve so far. Control points of a B-spline may have negative radii where the curve does not, as
// those of its Bézier points tell, of which 0 may be rounded.
void require_radii(std::span<const CurvePoint> points, bool bspline, const TextCursor& cursor) {
  double least = points.back().radius, tolerance = 0;
  if (bspline) {
    if (points.size() < 4) return;
    const CurveSegment segment = bspline_segments(points.last(4))[0];
    const auto radius = [](const CurvePoint& p) { return p.radius; };
    least = std::ranges::min(segment, {}, radius).radius;
    tolerance = 1e-6 * std::abs(std::ranges::max(points.last(4), {}, radius).radius);
  }
  if (least < -tolerance) cursor.fail(fmt::format("the radius {} is negative", least));
}

void end_curve(CurveFile& file, std::size_t least, const TextCursor& cursor) {
  const std::size_t begin = file.ends.empty() ? 0 : file.ends.back(), count = file.points.size() - begin;
  if (count == 0) return;
  if (count < least)
    cursor.fail(fmt::format("the curve before this has {} control points, but needs {}", count, least));
  file.ends.push_back(file.points.size());
}

}  // namespace

CurveFile read_curve_file(const std::filesystem::path& path, std::size_t least) {
  InputBytes bytes(path);
  const std::string name = path.string();
  TextCursor cursor(name, bytes.begin(), bytes.end());
  CurveFile file;
  while (cursor.at() != cursor.end()) {
    if (cursor.at_line_end()) {
      end_curve(file, least, cursor);
    } else {
      file.points.push_back(read_point(cursor));
      const std::size_t begin = file.ends.empty() ? 0 : file.ends.back();
      require_radii(std::span(file.points).subspan(begin), least == 4, cursor);
    }
    cursor.skip_line();
    bytes.release_before(cursor.at());
  }
  end_curve(file, least, cursor);
  if (file.ends.empty()) cursor.fail("the file has no curves");
  return file;
}

namespace {

constexpr std::string_view hair_mark = "BINARY_HAIR";

// Points alone are left out.
void end_hair(CurveFile& file) {
  const std::size_t begin = file.ends.empty() ? 0 : file.ends.back();
  if (file.points.size() > begin + 1)
    file.ends.push_back(file.points.size());
  else
    file.points.resize(begin);
}

void read_binary_hair(const std::string& name, const InputBytes& bytes, double radius, CurveFile& file) {
  const char* at = bytes.begin() + hair_mark.size();
  const auto next = [&](auto value) {
    if (static_cast<std::size_t>(bytes.end() - at) < sizeof value)
      throw Error("the file ends within its points", {name});
    std::memcpy(&value, at, sizeof value);
    at += sizeof value;
    return static_cast<double>(value);
  };
  const auto count = static_cast<std::uint32_t>(next(std::uint32_t{}));
  for (std::uint32_t i = 0; i < count; ++i) {
    double x = next(float{});
    if (std::isinf(x)) {
      end_hair(file);
      x = next(float{});
    }
    const Point3d p{x, next(float{}), next(float{})};
    if (!is_finite(p)) throw Error(fmt::format("point {} is not finite", i), {name});
    file.points.push_back({p, radius});
  }
}

void read_hair_text(const std::string& name, InputBytes& bytes, double radius, CurveFile& file) {
  TextCursor cursor(name, bytes.begin(), bytes.end());
  while (cursor.at() != cursor.end()) {
    if (cursor.at_line_end() || cursor.sees('#')) {
      end_hair(file);
    } else {
      CurvePoint point{{}, radius};
      for (int axis = 0; axis < 3; ++axis) point.position[axis] = finite_number(cursor, "a coordinate");
      file.points.push_back(point);
    }
    cursor.skip_line();
    bytes.release_before(cursor.at());
  }
}

}  // namespace

CurveFile read_hair_file(const std::filesystem::path& path, double radius) {
  InputBytes bytes(path);
  const std::string name = path.string();
  CurveFile file;
  if (std::string_view(bytes.begin(), bytes.size()).starts_with(hair_mark))
    read_binary_hair(name, bytes, radius, file);
  else
    read_hair_text(name, bytes, radius, file);
  end_hair(file);
  if (file.ends.empty()) throw Error("the file has no hair", {name});
  return file;
}

}  // namespace vitrail::mitsuba
