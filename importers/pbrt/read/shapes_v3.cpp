// SPDX-License-Identifier: Apache-2.0
// Shapes "heightfield", "hyperboloid" and "nurbs", which v4 has no more.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numbers>

#include "importers/pbrt/read/shapes.h"
#include "importers/shapes/grid_surfaces.h"

namespace vitrail::pbrt {

namespace {

std::vector<double> numbers(ParameterSet& parameters, std::string_view name, std::size_t count) {
  const Parameter* parameter = parameters.find_numbers(name);
  if (!parameter || parameter->numbers.size() != count)
    fail(fmt::format("{} needs {} numbers in a parameter \"{}\", and has {}", parameters.owner(), count, name,
                     parameter ? parameter->numbers.size() : 0),
         parameter ? parameter->place : parameters.place());
  for (const double value : parameter->numbers)
    if (!(std::abs(value) <= std::numeric_limits<float>::max()))
      fail(fmt::format("a value of parameter \"{}\" is too large", name), parameter->place);
  return parameter->numbers;
}

int count(ParameterSet& parameters, const char* name) {
  constexpr int most = 1 << 15;
  const int value = parameters.integer(name, -1);
  if (value < 2 || value > most)
    fail(fmt::format("{} needs a parameter \"{}\" of 2 to {}", parameters.owner(), name, most),
         parameters.place());
  return value;
}

Spline spline(ParameterSet& parameters, const std::string& axis) {
  Spline s;
  s.points = count(parameters, ("n" + axis).c_str());
  s.order = count(parameters, (axis + "order").c_str());
  s.knots = numbers(parameters, axis + "knots",
                    static_cast<std::size_t>(s.points) + static_cast<std::size_t>(s.order));
  s.begin = parameters.number(axis + "0", s.knots[static_cast<std::size_t>(s.order - 1)]);
  s.end = parameters.number(axis + "1", s.knots[static_cast<std::size_t>(s.points)]);
  return s;
}

// What of a surface cannot be is said where it stands.
template <class Make>
TriangleMesh made(const ParameterSet& parameters, Make&& make) {
  try {
    return make();
  } catch (const Error& error) {
    fail(error.what(), parameters.place());
  }
}

}  // namespace

ShapeGeometry ShapeMaker::heightfield(ParameterSet& parameters) {
  const int columns = count(parameters, "nu"), rows = count(parameters, "nv");
  const auto size = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  TriangleMesh mesh = vitrail::heightfield(columns, rows, numbers(parameters, "Pz", size));
  const std::size_t parts = mesh.triangles.size();
  return {add(std::move(mesh)), false, {}, parts};
}

ShapeGeometry ShapeMaker::hyperboloid(ParameterSet& parameters) {
  const auto p1 = parameters.triple("p1").value_or(std::array{0.0, 0.0, 0.0});
  const auto p2 = parameters.triple("p2").value_or(std::array{1.0, 1.0, 1.0});
  const double phimax_rad = std::clamp(parameters.number("phimax", 360), 0.0, 360.0) * std::numbers::pi / 180;
  if (!(phimax_rad > 0) || p1 == p2) fail("a hyperboloid of which nothing is left", parameters.place());
  context_.report.approximated("a hyperboloid becomes triangles, 256 for a full turn", parameters.place());
  return {add(made(parameters,
                   [&] {
                     return vitrail::hyperboloid({p1[0], p1[1], p1[2]}, {p2[0], p2[1], p2[2]}, phimax_rad);
                   })),
          true,
          {},
          1};
}

ShapeGeometry ShapeMaker::nurbs(ParameterSet& parameters) {
  const Spline u = spline(parameters, "u"), v = spline(parameters, "v");
  const auto size = static_cast<std::size_t>(u.points) * static_cast<std::size_t>(v.points);
  const bool weighted = parameters.find_numbers("P") == nullptr;
  const std::size_t each = weighted ? 4 : 3;
  const std::vector<double> values = numbers(parameters, weighted ? "Pw" : "P", each * size);
  std::vector<std::array<double, 4>> points(size);
  for (std::size_t i = 0; i < size; ++i)
    for (std::size_t c = 0; c < 4; ++c) points[i][c] = c < each ? values[i * each + c] : 1;
  TriangleMesh mesh = made(parameters, [&] { return vitrail::nurbs(u, v, points); });
  const std::size_t parts = mesh.triangles.size();
  return {add(std::move(mesh)), false, {}, parts};
}

}  // namespace vitrail::pbrt
