// SPDX-License-Identifier: Apache-2.0
#include "tests/laws/exact/clipping.h"

#include <CGAL/Exact_rational.h>

#include <algorithm>
#include <cmath>

namespace vitrail::test {

namespace {

using Real = long double;
using Polygon = std::vector<Point3<Real>>;

// The part where (p[axis] − split)·side ≥ 0.
Polygon clipped(const Polygon& polygon, int axis, Real split, Real side) {
  Polygon out;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point3<Real> p = polygon[i], q = polygon[(i + 1) % polygon.size()];
    const Real a = (p[axis] - split) * side, b = (q[axis] - split) * side;
    if (a >= 0) out.push_back(p);
    if ((a < 0 && b > 0) || (a > 0 && b < 0)) out.push_back(p + (q - p) * (a / (a - b)));
  }
  return out;
}

Vector3<Real> vector_area(const Polygon& p) {
  Vector3<Real> sum;
  for (std::size_t i = 2; i < p.size(); ++i) sum = sum + cross(p[i - 1] - p[0], p[i] - p[0]);
  return sum * Real{0.5};
}

template <class T>
T squared_distance(Point3<T> p, Point3<T> a, Point3<T> b) {
  const Vector3<T> e = b - a, ap = p - a;
  const T square = dot(e, e), along = dot(ap, e);
  if (along <= 0 || square == 0) return dot(ap, ap);
  if (along >= square) return dot(p - b, p - b);
  const Vector3<T> aside = ap - e * T(along / square);
  return dot(aside, aside);
}

// Of a point from a triangle.
template <class T>
T squared_distance(Point3<T> p, const std::vector<Point3<T>>& t) {
  const Vector3<T> n = cross(t[1] - t[0], t[2] - t[0]);
  T least = dot(p - t[0], p - t[0]);
  bool above = !(n == Vector3<T>{});
  for (std::size_t i = 0; i < 3; ++i) {
    const Point3<T> a = t[i], b = t[(i + 1) % 3];
    least = std::min(least, squared_distance(p, a, b));
    above = above && dot(cross(b - a, p - a), n) >= 0;
  }
  const T height = dot(p - t[0], n);
  return above ? std::min(least, T(height * height / dot(n, n))) : least;
}

class Clipper {
 public:
  Clipper(const BundleGeometry& bundle, Problems& problems) : bundle_(bundle), problems_(problems) {
    for (const DomainGeometry& d : bundle.domains) {
      auto& pieces = pieces_.emplace_back();
      for (const Piece& p : d.pieces) {
        Polygon& polygon = pieces[p.triangle];
        for (std::uint32_t i = 0; i < p.vertex_count; ++i)
          polygon.push_back(cast<Real>(d.piece_vertices[p.first_vertex + i]));
        triangles_.try_emplace(p.triangle);
      }
    }
    for (const DomainGeometry& d : bundle.domains)
      for (const Face& f : d.parents())
        if (const auto at = triangles_.find(f.triangle); at != triangles_.end() && at->second.empty())
          for (const Point3d& p : f.polygon) at->second.push_back(cast<Real>(p));
  }

  void check() {
    for (const auto& [id, triangle] : triangles_) {
      Real greatest = 0, around = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const Point3<Real>& p = triangle[i];
        greatest = std::max({greatest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        around += length(triangle[(i + 1) % 3] - p);
      }
      tolerance_ = greatest * 0x1p-46L;
      area_ = 0;
      descend(0, id, triangle, triangle);
      if (std::abs(area_ - length(vector_area(triangle))) > around * tolerance_)
        problems_.add("the areas of pieces do not add up");
    }
  }

 private:
  void descend(std::uint32_t at, std::uint32_t id, const Polygon& triangle, const Polygon& part) {
    if (at & KdNode::leaf_bit) return compare(at & ~KdNode::leaf_bit, id, triangle, part);
    const KdNode& node = bundle_.manifest.kd_nodes[at];
    const auto axis = static_cast<int>(node.axis);
    descend(node.below, id, triangle, clipped(part, axis, node.split, -1));
    descend(node.above, id, triangle, clipped(part, axis, node.split, 1));
  }

  void compare(std::uint32_t domain, std::uint32_t id, const Polygon& triangle, const Polygon& expected) {
    const auto found = pieces_[domain].find(id);
    if (found == pieces_[domain].end()) {
      if (!is_negligible(expected, bundle_.domains[domain].sides)) problems_.add("a piece is missing");
      return;
    }
    area_ += length(vector_area(found->second));
    for (const Point3<Real>& p : found->second)
      if (squared_distance(p, triangle) > tolerance_ * tolerance_ && lies_off(p, triangle))
        problems_.add("a piece is not a part of its triangle");
  }

  // Decides for needles, whose normal long doubles do not have.
  bool lies_off(const Point3<Real>& point, const Polygon& triangle) const {
    using Exact = CGAL::Exact_rational;
    const auto exact = [](const Point3<Real>& p) {
      return Point3<Exact>{Exact(static_cast<double>(p.x)), Exact(static_cast<double>(p.y)),
                           Exact(static_cast<double>(p.z))};
    };
    std::vector<Point3<Exact>> corners;
    for (const Point3<Real>& p : triangle) corners.push_back(exact(p));
    return CGAL::to_double(squared_distance(exact(point), corners)) > tolerance_ * tolerance_;
  }

  // Within rounding of an interface.
  bool is_negligible(const Polygon& polygon, const std::vector<Side>& sides) const {
    return polygon.empty() || std::ranges::any_of(sides, [&](const Side& s) {
             return std::ranges::all_of(
                 polygon, [&](const auto& p) { return std::abs(p[s.axis] - Real{s.split}) <= tolerance_; });
           });
  }

  const BundleGeometry& bundle_;
  Problems& problems_;
  std::vector<std::map<std::uint32_t, Polygon>> pieces_;  // of each domain, by triangle
  std::map<std::uint32_t, Polygon> triangles_;            // that are cut
  Real tolerance_ = 0, area_ = 0;
};

}  // namespace

void check_clipping(const BundleGeometry& bundle, Problems& problems) { Clipper(bundle, problems).check(); }

}  // namespace vitrail::test
