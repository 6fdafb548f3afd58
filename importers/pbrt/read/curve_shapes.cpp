// SPDX-License-Identifier: Apache-2.0
// Shape "curve".
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "importers/pbrt/read/shapes.h"
#include "scene/shapes/curve_meshes.h"

namespace vitrail::pbrt {

namespace {

std::vector<Vector3d> triples(ParameterSet& parameters, std::string_view name) {
  Parameter* parameter = parameters.find_numbers(name);
  if (!parameter) return {};
  const std::vector<double>& values = parameter->numbers;
  if (values.size() % 3 != 0)
    fail(fmt::format("parameter \"{}\" has {} numbers, which is not a multiple of 3", name, values.size()),
         parameter->place);
  std::vector<Vector3d> result;
  for (std::size_t i = 0; i < values.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k)
      if (!(std::abs(values[i + k]) <= std::numeric_limits<float>::max()))
        fail(fmt::format("value {} of parameter \"{}\" is too large", i + k, name), parameter->place);
    result.push_back({values[i], values[i + 1], values[i + 2]});
  }
  return result;
}

std::string choice(ParameterSet& parameters, std::string_view name, const std::string& otherwise,
                   const std::vector<std::string>& choices) {
  std::string value = parameters.text(name, otherwise);
  if (std::ranges::count(choices, value) == 0)
    fail(fmt::format("the {} of a curve is \"{}\", but has to be \"{}\"", name, value,
                     fmt::join(choices, "\" or \"")),
         parameters.place());
  return value;
}

double width(ParameterSet& parameters, std::string_view name, double otherwise) {
  const double value = parameters.number(name, otherwise);
  if (!(value >= 0 && value <= std::numeric_limits<float>::max()))
    fail(fmt::format("\"{}\" of a curve is {}, but has to be finite and not negative", name, value),
         parameters.place());
  return value;
}

std::vector<CurveSegment> segments_of(ParameterSet& parameters) {
  const std::vector<Vector3d> points = triples(parameters, "P");
  const bool bezier = choice(parameters, "basis", "bezier", {"bezier", "bspline"}) == "bezier";
  const int degree = parameters.integer("degree", 3);
  if (degree != 2 && degree != 3)
    fail(fmt::format("the degree of a curve is {}, but has to be 2 or 3", degree), parameters.place());
  const auto d = static_cast<std::size_t>(degree);
  if (points.size() <= d || (bezier && (points.size() - 1) % d != 0))
    fail(fmt::format("{} control points make no {} curve of degree {}", points.size(),
                     bezier ? "Bézier" : "B-spline", degree),
         parameters.place());
  std::vector<CurvePoint> curve;
  for (const Vector3d& p : points) curve.push_back({Point3d{} + p, 0});
  return bezier        ? degree == 2 ? quadratic_bezier_segments(curve) : bezier_segments(curve)
                : degree == 2 ? quadratic_bspline_segments(curve)
                       : bspline_segments(curve);
}

// pbrt's widths are linear in the parameter of the whole curve.
void set_widths(std::vector<CurveSegment>& segments, double width0, double width1) {
  const auto thirds = 3 * static_cast<double>(segments.size());
  for (std::size_t i = 0; i < segments.size(); ++i)
    for (std::size_t k = 0; k < 4; ++k)
      segments[i][k].radius = std::lerp(width0, width1, static_cast<double>(3 * i + k) / thirds) / 2;
}

bool has_length(const std::vector<CurveSegment>& segments) {
  const Point3d start = segments.front()[0].position;
  return std::ranges::any_of(segments, [&](const CurveSegment& s) {
    return std::ranges::any_of(s, [&](const CurvePoint& p) { return !(p.position == start); });
  });
}

std::vector<Vector3d> ribbon_normals(ParameterSet& parameters, std::size_t segments) {
  std::vector<Vector3d> normals = triples(parameters, "N");
  if (normals.size() != segments + 1)
    fail(fmt::format("a ribbon of {} segments needs {} normals \"N\", but has {}", segments, segments + 1,
                     normals.size()),
         parameters.place());
  return normals;
}

// Steps a segment in which normals turn by at most an eighth of half a turn.
int steps_of_turns(const std::vector<Vector3d>& normals) {
  double most_rad = 0;
  for (std::size_t i = 0; i + 1 < normals.size(); ++i)
    most_rad = std::max(
        most_rad, std::atan2(length(cross(normals[i], normals[i + 1])), dot(normals[i], normals[i + 1])));
  return static_cast<int>(std::ceil(8 * most_rad / std::numbers::pi));
}

}  // namespace

std::optional<ShapeGeometry> ShapeMaker::curve(ParameterSet& parameters) {
  std::vector<CurveSegment> segments = segments_of(parameters);
  const double common = width(parameters, "width", 1);
  const double width0 = width(parameters, "width0", common), width1 = width(parameters, "width1", common);
  set_widths(segments, width0, width1);
  const std::string type = choice(parameters, "type", "flat", {"flat", "ribbon", "cylinder"});
  parameters.ignore({"splitdepth"});
  if (type == "ribbon") return ribbon(parameters, segments, std::max(width0, width1));
  parameters.ignore({"N"});
  if (!has_length(segments) || !(std::max(width0, width1) > 0)) {
    context_.report.dropped("a curve without length or width", parameters.place());
    return std::nullopt;
  }
  if (type == "flat")
    context_.report.approximated("flat curves, which face the ray, are round ones of their width",
                                 parameters.place());
  KeptCurves curves(QuadricUv::pbrt, context_.mesh_memory.limit_bytes() / 4);
  try {
    curves.add(placed_curves(segments, 0, 1, false, false));
  } catch (const Error& error) {
    fail(error.what(), parameters.place());
  }
  meshes_.push_back(std::move(curves.mesh));
  return ShapeGeometry{{static_cast<std::uint32_t>(meshes_.size() - 1)}, true, {}, 1, true};
}

std::optional<ShapeGeometry> ShapeMaker::ribbon(ParameterSet& parameters,
                                                const std::vector<CurveSegment>& segments, double width) {
  // Scenes have very many curves: a fortieth of the width is as near as their edges are seen.
  constexpr int most_steps = 32;
  const std::vector<Vector3d> normals = ribbon_normals(parameters, segments.size());
  TriangleMesh mesh;
  try {
    const int steps = std::max(steps_within(segments, width / 40, most_steps), steps_of_turns(normals));
    append_ribbon(segments, normals, steps, mesh);
  } catch (const Error& error) {
    fail(error.what(), parameters.place());
  }
  if (mesh.triangles.empty()) {
    context_.report.dropped("a curve without length", parameters.place());
    return std::nullopt;
  }
  context_.report.approximated("ribbons become triangles", parameters.place());
  return ShapeGeometry{add(std::move(mesh)), true, {}, 1};
}

}  // namespace vitrail::pbrt
