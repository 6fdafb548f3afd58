// SPDX-License-Identifier: Apache-2.0
// Curves.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "importers/mitsuba/read/curve_files.h"
#include "importers/mitsuba/read/shape_geometry.h"
#include "scene/shapes/curve_meshes.h"

namespace vitrail::mitsuba {

namespace {

TriangleMesh curves_of(const Builder& builder, const CurveFile& file, bool linear, bool round_ends) {
  const std::size_t fewer = linear ? 1 : 3;  // segments than points
  const std::size_t total = file.points.size() - fewer * file.ends.size();
  KeptCurves curves(QuadricUv::mitsuba, builder.mesh_memory.limit_bytes() / 4);
  std::size_t begin = 0, done = 0;
  for (const std::size_t end : file.ends) {
    const std::span points(file.points.data() + begin, end - begin);
    auto segments = linear ? linear_segments(points) : bspline_segments(points);
    for (CurveSegment& s : segments)
      for (CurvePoint& p : s) p.radius = std::max(p.radius, 0.0);  // of 0, rounded
    const auto v = [&](std::size_t segment) {
      return static_cast<double>(segment) / static_cast<double>(total);
    };
    curves.add(placed_curves(segments, v(done), v(done + segments.size()), linear, round_ends));
    done += segments.size();
    begin = end;
  }
  return std::move(curves.mesh);
}

// Mitsuba 0.6's. Its lengths are the object's. It joins segments that turn by less than an angle, for speed.
ShapeGeometry hair_shape(Builder& builder, const Object& shape) {
  const auto radius = static_cast<float>(shape.number("radius", 0.025, builder.report));
  if (!(radius > 0 && radius <= std::numeric_limits<float>::max()))
    builder.report.fail(fmt::format("the radius of hair is {}", radius), shape.origin);
  shape.ignore({"angle_threshold"});
  if (shape.number("reduction", 0, builder.report) != 0)
    builder.report.approximated("hair is not thinned: all of it is there, as wide as it is", shape.origin);
  const std::filesystem::path path = shape_file(builder, shape);
  const Id<TriangleMesh> mesh = shared_mesh(
      builder, shape, {path.string(), 2, std::bit_cast<int>(radius)},
      [&] { return curves_of(builder, read_hair_file(path, static_cast<double>(radius)), true, false); });
  return {mesh, {}, true};
}

}  // namespace

std::optional<ShapeGeometry> curve_shape(Builder& builder, const Object& shape) {
  const std::string kind = kind_of(shape);
  const bool linear = kind == "linearcurve";
  if (kind == "hair") return hair_shape(builder, shape);
  if (!linear && kind != "bsplinecurve") return std::nullopt;
  const std::filesystem::path path = shape_file(builder, shape);
  // Mitsuba's to_world takes the control points along and leaves radii as they are.
  const Transform to_world =
      shape.keyframes("to_world").empty() ? shape.transform("to_world", builder.report) : Transform{};
  const bool keeps_radii = is_similarity(to_world) && std::abs(std::abs(determinant3(to_world)) - 1) < 1e-6;
  const std::string own = keeps_radii ? "" : fmt::format(" {}", builder.scene.meshes.size());
  const Id<TriangleMesh> mesh = shared_mesh(builder, shape, {path.string() + own, linear, 0}, [&] {
    CurveFile file = read_curve_file(path, linear ? 2 : 4);
    if (!keeps_radii)
      for (CurvePoint& p : file.points) p.position = transform_point(to_world, p.position);
    return curves_of(builder, file, linear, linear);
  });
  return ShapeGeometry{mesh, {}, true, !keeps_radii};
}

}  // namespace vitrail::mitsuba
