// SPDX-License-Identifier: Apache-2.0
#include "importers/solids/region.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>

#include <cmath>
#include <map>
#include <numeric>

namespace vitrail::solids {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
constexpr std::uint32_t none = 0xffffffff;

struct Face {
  enum { unknown, inside, outside } where = unknown;
  std::uint32_t number = none;  // of those inside
};
using VertexBase = CGAL::Triangulation_vertex_base_2<Kernel>;
using FaceBase =
    CGAL::Constrained_triangulation_face_base_2<Kernel,
                                                CGAL::Triangulation_face_base_with_info_2<Face, Kernel>>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>, CGAL::Exact_predicates_tag>;

// How often the contours run around a point, and how often they cross a ray from it.
bool encloses(std::span<const PlaneCurve> contours, Point2d p, FillRule rule) {
  int turns = 0, crossings = 0;
  for (const PlaneCurve& contour : contours)
    for (std::size_t i = 0; i < contour.points.size(); ++i) {
      const Point2d a = contour.points[i].place, b = contour.points[(i + 1) % contour.points.size()].place;
      if ((a.y <= p.y) == (b.y <= p.y)) continue;
      if (a.x + (b.x - a.x) * ((p.y - a.y) / (b.y - a.y)) <= p.x) continue;
      turns += b.y > a.y ? 1 : -1;
      ++crossings;
    }
  return rule == FillRule::even_odd ? crossings % 2 != 0 : turns != 0;
}

Point2d place(const Triangulation::Vertex_handle& v) { return {v->point().x(), v->point().y()}; }

class Builder {
 public:
  Builder(std::span<const PlaneCurve> contours, FillRule rule) : contours_(contours), rule_(rule) {}

  Region build() {
    for (const PlaneCurve& contour : contours_) insert(contour);
    for (const auto& face : triangulation_.finite_face_handles())
      if (face->info().where == Face::unknown) flood(face);
    std::uint32_t count = 0;
    for (const auto& face : triangulation_.finite_face_handles())
      if (face->info().where == Face::inside) face->info().number = count++;
    number_corners(count);
    for (const auto& face : triangulation_.finite_face_handles())
      if (face->info().where == Face::inside) take(face);
    return std::move(region_);
  }

 private:
  using FaceHandle = Triangulation::Face_handle;
  using VertexHandle = Triangulation::Vertex_handle;

  void insert(const PlaneCurve& contour) {
    std::vector<VertexHandle> vertices;
    for (const CurvePoint& p : contour.points)
      vertices.push_back(triangulation_.insert(Kernel::Point_2(p.place.x, p.place.y)));
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const std::size_t next = (i + 1) % vertices.size();
      if (vertices[i] == vertices[next]) continue;
      triangulation_.insert_constraint(vertices[i], vertices[next]);
      tangents_[{&*vertices[i], &*vertices[next]}] = {contour.points[i].leaving,
                                                      contour.points[next].arriving};
    }
  }

  // Where what is inside touches itself at a vertex, each side gets a vertex of its own: corners of triangles
  // share one if edges inside join them.
  void number_corners(std::uint32_t triangles) {
    std::vector<std::uint32_t> parent(3 * std::size_t{triangles});
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](std::uint32_t c) {
      while (parent[c] != c) c = parent[c] = parent[parent[c]];
      return c;
    };
    const auto corner = [](FaceHandle face, VertexHandle vertex) {
      return 3 * face->info().number + static_cast<std::uint32_t>(face->index(vertex));
    };
    for (const auto& face : triangulation_.finite_face_handles())
      for (int k = 0; k < 3 && face->info().where == Face::inside; ++k) {
        const FaceHandle next = face->neighbor(k);
        if (!is_inside(next)) continue;
        for (const VertexHandle& v : {face->vertex(face->ccw(k)), face->vertex(face->cw(k))})
          parent[root(corner(face, v))] = root(corner(next, v));
      }
    number_.assign(parent.size(), none);
    for (const auto& face : triangulation_.finite_face_handles())
      for (int k = 0; k < 3 && face->info().where == Face::inside; ++k) {
        const std::uint32_t own = corner(face, face->vertex(k)), shared = root(own);
        if (number_[shared] == none) {
          number_[shared] = static_cast<std::uint32_t>(region_.points.size());
          region_.points.push_back(place(face->vertex(k)));
        }
        number_[own] = number_[shared];
      }
  }

  bool is_inside(FaceHandle face) const {
    return !triangulation_.is_infinite(face) && face->info().where == Face::inside;
  }

  // All that is reached without crossing a contour is inside, or all is not: the greatest triangle decides.
  void flood(FaceHandle first) {
    std::vector<FaceHandle> reached{first};
    first->info().where = Face::outside;
    double greatest = -1;
    Point2d middle;
    bool infinite = false;
    for (std::size_t i = 0; i < reached.size(); ++i) {
      const FaceHandle face = reached[i];
      const Point2d a = place(face->vertex(0)), b = place(face->vertex(1)), c = place(face->vertex(2));
      const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
      if (area > greatest) {
        greatest = area;
        middle = {(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3};
      }
      for (int k = 0; k < 3; ++k) {
        if (face->is_constrained(k)) continue;
        const FaceHandle next = face->neighbor(k);
        if (triangulation_.is_infinite(next)) {
          infinite = true;
        } else if (next->info().where == Face::unknown) {
          next->info().where = Face::outside;
          reached.push_back(next);
        }
      }
    }
    if (infinite || !encloses(contours_, middle, rule_)) return;
    for (const FaceHandle& face : reached) face->info().where = Face::inside;
  }

  void take(FaceHandle face) {
    const auto number = [&](int k) {
      return number_[3 * face->info().number + static_cast<std::uint32_t>(k)];
    };
    region_.triangles.push_back({number(0), number(1), number(2)});
    for (int k = 0; k < 3; ++k) {
      if (is_inside(face->neighbor(k))) continue;
      const int from = face->ccw(k), to = face->cw(k);
      const auto [tangent_from, tangent_to] = tangents(face->vertex(from), face->vertex(to));
      region_.edges.push_back({number(from), number(to), tangent_from, tangent_to});
    }
  }

  // Of a part of a crossed edge, those of the part itself.
  std::pair<Point2d, Point2d> tangents(VertexHandle from, VertexHandle to) const {
    if (const auto known = tangents_.find({&*from, &*to}); known != tangents_.end()) return known->second;
    if (const auto back = tangents_.find({&*to, &*from}); back != tangents_.end()) {
      const auto& [first, second] = back->second;
      return {{-second.x, -second.y}, {-first.x, -first.y}};
    }
    const Point2d a = place(from), b = place(to);
    const double dx = b.x - a.x, dy = b.y - a.y, size = std::sqrt(dx * dx + dy * dy);
    const Point2d chord{dx / size, dy / size};
    return {chord, chord};
  }

  std::span<const PlaneCurve> contours_;
  FillRule rule_;
  Triangulation triangulation_;
  std::map<std::pair<const Triangulation::Vertex*, const Triangulation::Vertex*>, std::pair<Point2d, Point2d>>
      tangents_;
  std::vector<std::uint32_t> number_;  // of the vertex of each triangle's corner
  Region region_;
};

// Vertices of one end: all of a region, or one where it is a point.
struct End {
  std::uint32_t first;
  bool is_point;
  std::uint32_t operator()(std::uint32_t vertex) const { return is_point ? first : first + vertex; }
};

End add_end(Solid& solid, const Region& region, double z, double size) {
  const End end{static_cast<std::uint32_t>(solid.positions.size()), size == 0};
  if (end.is_point) {
    solid.positions.push_back({0, 0, z});
  } else {
    for (const Point2d p : region.points) solid.positions.push_back({p.x * size, p.y * size, z});
  }
  return end;
}

}  // namespace

Region region_of(std::span<const PlaneCurve> contours, FillRule rule) {
  return Builder(contours, rule).build();
}

Solid swept(const Region& region, double low, double scale_low, double high, double scale_high,
            std::uint32_t cap) {
  Solid solid;
  const End bottom = add_end(solid, region, low, scale_low), top = add_end(solid, region, high, scale_high);
  const auto add = [&](std::array<std::uint32_t, 3> t, std::array<Normal3f, 3> normals,
                       std::uint32_t surface) {
    solid.triangles.push_back(t);
    solid.normals.push_back(normals);
    solid.surfaces.push_back(surface);
  };
  constexpr Normal3f down{0, 0, -1}, up{0, 0, 1};
  for (const auto& [a, b, c] : region.triangles) {
    if (!bottom.is_point) add({bottom(a), bottom(c), bottom(b)}, {down, down, down}, cap);
    if (!top.is_point) add({top(a), top(b), top(c)}, {up, up, up}, cap);
  }
  const double growth = (scale_high - scale_low) / (high - low);
  const double sign = scale_low + scale_high < 0 ? -1 : 1;
  const auto normal = [&](std::uint32_t vertex, Point2d tangent) {
    const Point2d p = region.points[vertex];
    const Vector3d n{tangent.y, -tangent.x, -growth * (tangent.y * p.x - tangent.x * p.y)};
    return cast<float>(to_normal(normalize(n * sign)));
  };
  for (const RegionEdge& e : region.edges) {
    const Normal3f from = normal(e.from, e.tangent_from), to = normal(e.to, e.tangent_to);
    if (!bottom.is_point) add({bottom(e.from), bottom(e.to), top(e.to)}, {from, to, to}, 0);
    if (!top.is_point) add({bottom(e.from), top(e.to), top(e.from)}, {from, to, from}, 0);
  }
  return solid;
}

}  // namespace vitrail::solids
