// SPDX-License-Identifier: Apache-2.0
#include "tests/laws/exact/exact_oracle.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>

namespace vitrail::test {
namespace {

using Exact = CGAL::Exact_rational;
using Geometry = CGAL::Exact_predicates_inexact_constructions_kernel;
using Primitive = CGAL::AABB_triangle_primitive<Geometry, std::vector<Geometry::Triangle_3>::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Geometry, Primitive>>;

Vector3<Exact> exact(Vector3f v) { return {Exact(v.x), Exact(v.y), Exact(v.z)}; }
Vector3<Exact> exact_difference(Point3f a, Point3f b) {
  return {Exact(a.x) - Exact(b.x), Exact(a.y) - Exact(b.y), Exact(a.z) - Exact(b.z)};
}
bool is_exact_sum(double a, double b, double sum) { return sum - a == b && sum - b == a; }

}  // namespace

struct ExactOracle::Implementation {
  const Triangles& triangles;
  std::vector<Geometry::Triangle_3> with_area{};
  std::vector<std::uint32_t> id{};  // of those with area
  Tree tree{};
};

ExactOracle::ExactOracle(const Triangles& triangles) : implementation_(new Implementation{triangles}) {
  Implementation& self = *implementation_;
  const auto point = [](Point3f p) { return Geometry::Point_3(p.x, p.y, p.z); };
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const Geometry::Triangle_3 triangle(point(triangles[i][0]), point(triangles[i][1]),
                                        point(triangles[i][2]));
    if (triangle.is_degenerate()) continue;
    self.with_area.push_back(triangle);
    self.id.push_back(i);
  }
  self.tree.insert(self.with_area.cbegin(), self.with_area.cend());
  self.tree.build();
}

ExactOracle::~ExactOracle() = default;

std::optional<std::vector<ExactCrossing>> ExactOracle::crossings(const Ray& ray) const {
  const Implementation& self = *implementation_;
  const Point3d origin = cast<double>(ray.origin), second = origin + cast<double>(ray.direction);
  for (int axis = 0; axis < 3; ++axis) {
    if (!is_exact_sum(origin[axis], double{ray.direction[axis]}, second[axis])) return {};
  }
  std::vector<Primitive::Id> met;
  const Geometry::Point_3 from(origin.x, origin.y, origin.z), through(second.x, second.y, second.z);
  self.tree.all_intersected_primitives(Geometry::Ray_3(from, through), std::back_inserter(met));
  std::vector<ExactCrossing> result;
  for (const Primitive::Id triangle : met) {
    const auto at = static_cast<std::size_t>(triangle - self.with_area.cbegin());
    if (const auto c = crossing(ray, self.id[at])) result.push_back(*c);
  }
  return result;
}

std::optional<ExactCrossing> ExactOracle::crossing(const Ray& ray, std::uint32_t triangle) const {
  const auto& [a, b, c] = implementation_->triangles[triangle];
  const Vector3<Exact> ab = exact_difference(b, a), ac = exact_difference(c, a),
                       ao = exact_difference(ray.origin, a);
  const Vector3<Exact> d = exact(ray.direction), n = cross(ab, ac);
  const Exact slope = dot(n, d), area = dot(n, n);
  if (slope == 0 || area == 0) return {};
  const Exact t = -dot(n, ao) / slope;
  const Vector3<Exact> ap = ao + d * t;
  const Exact u = dot(cross(ap, ac), n) / area, v = dot(cross(ab, ap), n) / area, w = 1 - u - v;
  const double sine =
      std::abs(CGAL::to_double(slope)) / std::sqrt(CGAL::to_double(area) * CGAL::to_double(Exact(dot(d, d))));
  return ExactCrossing{triangle, CGAL::to_double(t), CGAL::to_double(std::min({u, v, w})), sine};
}

}  // namespace vitrail::test
