// SPDX-License-Identifier: Apache-2.0
// Mitsuba's files of curves: a line "x y z radius" a control point, an empty line between curves.
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "importers/mitsuba/shape_geometry.h"
#include "importers/ply/input_bytes.h"
#include "importers/ply/text_cursor.h"
#include "importers/shapes/curve.h"

namespace vitrail::mitsuba {

namespace {

struct CurveFile {
  std::vector<CurvePoint> points;
  std::vector<std::size_t> ends;  // of each curve, in points
};

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
  if (point.radius < 0) cursor.fail(fmt::format("the radius {} is negative", point.radius));
  if (!cursor.at_line_end()) cursor.fail("unexpected text behind the radius");
  return point;
}

void end_curve(CurveFile& file, std::size_t least, const TextCursor& cursor) {
  const std::size_t begin = file.ends.empty() ? 0 : file.ends.back(), count = file.points.size() - begin;
  if (count == 0) return;
  if (count < least)
    cursor.fail(fmt::format("the curve before this has {} control points, but needs {}", count, least));
  file.ends.push_back(file.points.size());
}

CurveFile read_curves(const std::filesystem::path& path, std::size_t least) {
  InputBytes bytes(path);
  const std::string name = path.string();
  TextCursor cursor(name, bytes.begin(), bytes.end());
  CurveFile file;
  while (cursor.at() != cursor.end()) {
    if (cursor.at_line_end())
      end_curve(file, least, cursor);
    else
      file.points.push_back(read_point(cursor));
    cursor.skip_line();
    bytes.release_before(cursor.at());
  }
  end_curve(file, least, cursor);
  if (file.ends.empty()) cursor.fail("the file has no curves");
  return file;
}

TriangleMesh tubes(const CurveFile& file, bool linear) {
  const std::size_t fewer = linear ? 1 : 3;  // segments than points
  const std::size_t total = file.points.size() - fewer * file.ends.size();
  const CurveDetail detail = curve_detail(total, linear);
  TriangleMesh mesh;
  std::size_t begin = 0, done = 0;
  for (const std::size_t end : file.ends) {
    const std::span points(file.points.data() + begin, end - begin);
    const auto segments = linear ? linear_segments(points) : bspline_segments(points);
    const auto v = [&](std::size_t segment) {
      return static_cast<double>(segment) / static_cast<double>(total);
    };
    append_tube(segments, detail, v(done), v(done + segments.size()), linear, mesh);
    done += segments.size();
    begin = end;
  }
  return mesh;
}

}  // namespace

std::optional<ShapeGeometry> curve_shape(Builder& builder, const Object& shape) {
  const std::string kind = kind_of(shape);
  const bool linear = kind == "linearcurve";
  if (!linear && kind != "bsplinecurve") return std::nullopt;
  const std::filesystem::path path = shape_file(builder, shape);
  const Id<TriangleMesh> mesh = shared_mesh(builder, shape, {path.string(), linear, 0},
                                            [&] { return tubes(read_curves(path, linear ? 2 : 4), linear); });
  builder.report.approximated("curves become tubes of triangles", shape.origin);
  return ShapeGeometry{mesh, {}, true};
}

}  // namespace vitrail::mitsuba
