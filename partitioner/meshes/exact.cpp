// SPDX-License-Identifier: Apache-2.0
#include "partitioner/meshes/exact.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>

#include <cmath>
#include <limits>

namespace vitrail {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_3 point(Point3f p) { return {p.x, p.y, p.z}; }

template <class Number>
Number determinant(const std::array<Point3f, 3>& p) {
  const auto at = [&](std::size_t i, int axis) { return Number(static_cast<double>(p[i][axis])); };
  return at(0, 0) * (at(1, 1) * at(2, 2) - at(1, 2) * at(2, 1)) +
         at(0, 1) * (at(1, 2) * at(2, 0) - at(1, 0) * at(2, 2)) +
         at(0, 2) * (at(1, 0) * at(2, 1) - at(1, 1) * at(2, 0));
}

double permanent(const std::array<Point3f, 3>& p) {  // of the absolute values: it bounds the determinant
  const auto a = [&](std::size_t i, int axis) { return std::abs(static_cast<double>(p[i][axis])); };
  return a(0, 0) * (a(1, 1) * a(2, 2) + a(1, 2) * a(2, 1)) +
         a(0, 1) * (a(1, 2) * a(2, 0) + a(1, 0) * a(2, 2)) +
         a(0, 2) * (a(1, 0) * a(2, 1) + a(1, 1) * a(2, 0));
}

}  // namespace

bool is_degenerate(Point3f a, Point3f b, Point3f c) { return CGAL::collinear(point(a), point(b), point(c)); }

int volume_sign(const TriangleMesh& mesh, const std::vector<std::uint32_t>& triangles) {
  const auto corners = [&](std::uint32_t t) {
    const auto [a, b, c] = mesh.triangles[t];
    return std::array{mesh.positions[a], mesh.positions[b], mesh.positions[c]};
  };
  double volume = 0, magnitude = 0;
  for (const std::uint32_t t : triangles) {
    volume += determinant<double>(corners(t));
    magnitude += permanent(corners(t));
  }
  // Products of floats are exact; each of the n + 5 operations on a term rounds once (Higham 2002, §4.2).
  const double error =
      (static_cast<double>(triangles.size()) + 8) * std::numeric_limits<double>::epsilon() * magnitude;
  if (std::abs(volume) > error) return volume > 0 ? 1 : -1;
  CGAL::Exact_rational exact = 0;
  for (const std::uint32_t t : triangles) exact += determinant<CGAL::Exact_rational>(corners(t));
  return static_cast<int>(CGAL::sign(exact));
}

}  // namespace vitrail
