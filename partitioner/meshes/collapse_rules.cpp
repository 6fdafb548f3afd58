// SPDX-License-Identifier: Apache-2.0
#include "partitioner/meshes/collapse_rules.h"

#include <algorithm>
#include <cmath>

#include "scene/geometry/bounds.h"

namespace vitrail {

namespace {

using Point = HalfEdges::Point;
using PlaneQuadric = OpenMesh::Geometry::QuadricT<double>;

// Of a component's diagonal; of the ratio of volume to area of a closed one, which is half of a sheet's
// thickness and of a rod's radius. But 1/2000 of the mesh's diagonal, half a pixel where it fills a picture,
// is nothing.
constexpr double greatest_error = 0.005, greatest_border_shift = 0.001, greatest_error_of_thickness = 0.1,
                 error_that_is_nothing = 0.0005;
constexpr double least_turn_cosine = 0.2;  // of a triangle's normal, in one collapse
constexpr double least_shape = 0.02;       // twice the area over the longest edge squared
constexpr double length_weight = 1e-6;     // prefers short edges where all lie in one plane

PlaneQuadric plane(const Point& normal, const Point& through, double weight) {
  PlaneQuadric q(normal[0], normal[1], normal[2], -(normal | through));
  q *= weight;
  return q;
}

double distance_to_segment(const Point& p, const Point& a, const Point& b) {
  const Point along = b - a;
  const double squared = along.sqrnorm();
  const double s = squared > 0 ? std::clamp(((p - a) | along) / squared, 0.0, 1.0) : 0;
  return (a + along * s - p).norm();
}

double shape(const Point& normal, const Point& a, const Point& b, const Point& c) {
  const double longest = std::max({(b - a).sqrnorm(), (c - b).sqrnorm(), (a - c).sqrnorm()});
  return longest > 0 ? normal.norm() / longest : 0;
}

}  // namespace

void CollapseRules::Error::add(const PlaneQuadric& plane_quadric, double area) {
  quadric += plane_quadric;
  weight += area;
}

CollapseRules::CollapseRules(HalfEdges& mesh, const TriangleMesh& source, const MeshSurface& surface)
    : mesh_(mesh),
      source_(source),
      vertices_(surface.triangles),
      wedges_(surface.wedges),
      errors_(mesh.n_vertices()),
      shifts_(mesh.n_vertices()) {
  if (const auto classes = first_equal_face(source); !classes.empty())
    for (const std::uint32_t t : surface.sources) face_class_.push_back(classes[t]);
  for (const Vertex v : mesh_.vertices())
    kinds_.push_back(surface.held[index(v)] ? Kind::fixed : kind_of_vertex(v));
  add_planes();
  find_limits();
}

void CollapseRules::find_limits() {
  component_.resize(mesh_.n_vertices());
  std::vector<bool> seen(mesh_.n_vertices());
  std::vector<Vertex> reached;
  for (const Vertex start : mesh_.vertices()) {
    if (seen[index(start)]) continue;
    reached.assign(1, start);
    seen[index(start)] = true;
    Bounds3d bounds;
    bool closed = true;
    double area = 0, volume = 0;  // 6 and 18 times, each triangle seen from its three corners
    for (std::size_t i = 0; i < reached.size(); ++i) {
      const Point p = mesh_.point(reached[i]), origin = mesh_.point(start);
      extend(bounds, Point3d{p[0], p[1], p[2]});
      component_[index(reached[i])] = static_cast<std::uint32_t>(limits_.size());
      for (const Edge h : mesh_.voh_range(reached[i])) {
        const Vertex next = mesh_.to_vertex_handle(h);
        if (!seen[index(next)]) reached.push_back(next);
        seen[index(next)] = true;
        if (mesh_.is_boundary(h)) {
          closed = false;
          continue;
        }
        const Point a = mesh_.point(next) - origin,
                    b = mesh_.point(mesh_.to_vertex_handle(mesh_.next_halfedge_handle(h))) - origin;
        area += ((a - (p - origin)) % (b - (p - origin))).norm();
        volume += (p - origin) | (a % b);
      }
    }
    const double diagonal = length(extent(bounds));
    Limits& limits =
        limits_.emplace_back(Limits{greatest_error * diagonal, greatest_border_shift * diagonal});
    if (closed && area > 0)
      limits.error = std::min(limits.error, greatest_error_of_thickness * std::abs(volume) / (3 * area));
    limits.error = std::max(limits.error, error_that_is_nothing);
  }
}

std::size_t CollapseRules::corner(Face f, Vertex v) const {
  const Triangle& t = vertices_[index(f)];
  const auto number = static_cast<std::uint32_t>(v.idx());
  return t[0] == number ? 0 : t[1] == number ? 1 : 2;
}

CollapseRules::Kind CollapseRules::kind_of_edge(Edge h) {
  const Face left = mesh_.face_handle(h), right = mesh_.opposite_face_handle(h);
  if (!left.is_valid() || !right.is_valid()) return Kind::border;
  const Vertex a = mesh_.from_vertex_handle(h), b = mesh_.to_vertex_handle(h);
  const bool same = wedge(left, a) == wedge(right, a) && wedge(left, b) == wedge(right, b) &&
                    (face_class_.empty() || face_class_[index(left)] == face_class_[index(right)]);
  return same ? Kind::smooth : Kind::seam;
}

CollapseRules::Kind CollapseRules::kind_of_vertex(Vertex v) {
  int seams = 0, borders = 0;
  for (const Edge h : mesh_.voh_range(v)) {
    const Kind kind = kind_of_edge(h);
    seams += kind == Kind::seam;
    borders += kind == Kind::border;
  }
  if (seams + borders == 0) return Kind::smooth;
  if (seams == 2 && borders == 0) return Kind::seam;
  if (borders == 2 && seams == 0) return Kind::border;
  return Kind::fixed;
}

// Faces by a third of their area at each corner; features by planes through them across each of their faces.
void CollapseRules::add_planes() {
  for (const Face f : mesh_.faces()) {
    const Triangle& t = vertices_[index(f)];
    const auto at = [&](std::size_t k) { return mesh_.point(Vertex(static_cast<int>(t[k]))); };
    const Point scaled = (at(1) - at(0)) % (at(2) - at(0));
    const double length = scaled.norm();
    if (!(length > 0)) continue;
    const Point normal = scaled / length;
    const double area = length / 6;
    for (const std::uint32_t v : t) errors_[v].add(plane(normal, at(0), area), area);
    for (const Edge h : mesh_.fh_range(f)) {
      if (kind_of_edge(h) == Kind::smooth) continue;
      const Vertex a = mesh_.from_vertex_handle(h), b = mesh_.to_vertex_handle(h);
      const Point along = mesh_.point(b) - mesh_.point(a), across = normal % along;
      if (!(across.norm() > 0)) continue;
      const PlaneQuadric q = plane(across / across.norm(), mesh_.point(a), along.sqrnorm() / 2);
      errors_[index(a)].add(q, 0);
      errors_[index(b)].add(q, 0);
    }
  }
}

// The faces on one side of v0's features get the wedge that v1 has on that side.
void CollapseRules::find_changes(const Collapse& c) {
  changes_.clear();
  const auto note = [&](Face f, std::uint32_t w) { changes_.push_back({f, corner(f, c.v0), w}); };
  if (c.fl.is_valid()) {
    const std::uint32_t w = wedge(c.fl, c.v1);
    for (Edge h = mesh_.ccw_rotated_halfedge_handle(c.v0v1); kind_of_edge(h) == Kind::smooth;
         h = mesh_.ccw_rotated_halfedge_handle(h)) {
      const Face f = mesh_.face_handle(h);
      if (f == c.fr) return;  // all the way round
      note(f, w);
    }
  }
  if (c.fr.is_valid()) {
    const std::uint32_t w = wedge(c.fr, c.v1);
    for (Edge h = mesh_.cw_rotated_halfedge_handle(c.v0v1); kind_of_edge(h) == Kind::smooth;
         h = mesh_.cw_rotated_halfedge_handle(h))
      note(mesh_.opposite_face_handle(h), w);
  }
}

bool CollapseRules::stays_sound(const Change& change, const Point& to) {
  const std::size_t k = change.corner;
  const Triangle& t = vertices_[index(change.face)];
  const auto at = [&](std::size_t i) { return mesh_.point(Vertex(static_cast<int>(t[i % 3]))); };
  const Point a = at(k + 1), b = at(k + 2), before = (a - at(k)) % (b - at(k)), after = (a - to) % (b - to);
  const double shape_before = shape(before, at(k), a, b), shape_after = shape(after, to, a, b);
  if (shape_after < least_shape && shape_after <= shape_before) return false;
  if ((before | after) < least_turn_cosine * before.norm() * after.norm()) return false;

  const Triangle& old_wedges = wedges_[index(change.face)];
  Triangle new_wedges = old_wedges;
  new_wedges[k] = change.wedge;
  const auto uv_area = [&](const Triangle& w) {
    const auto uv = [&](std::size_t i) { return Point(source_.uvs[w[i]].x, source_.uvs[w[i]].y, 0); };
    return ((uv(1) - uv(0)) % (uv(2) - uv(0)))[2];
  };
  if (!source_.uvs.empty())
    if (const double area = uv_area(old_wedges); area != 0 && !(area * uv_area(new_wedges) > 0)) return false;
  const auto facing = [&](const Triangle& w, const Point& normal) {
    double sum = 0;
    for (const std::uint32_t i : w) {
      const Normal3f n = source_.normals[i];
      sum += normal | Point(n.x, n.y, n.z);
    }
    return sum;
  };
  return source_.normals.empty() || facing(old_wedges, before) * facing(new_wedges, after) >= 0;
}

CollapseRules::Edge CollapseRules::other_feature(const Collapse& c, Kind kind) {
  for (const Edge h : mesh_.voh_range(c.v0))
    if (h != c.v0v1 && kind_of_edge(h) == kind) return h;
  return Edge();
}

// How far the border has moved at most once v0 is gone and its other neighbour on it follows v1.
double CollapseRules::border_shift(const Collapse& c, Vertex other) {
  const double before = std::max({shifts_[index(c.v0)], shifts_[index(c.v1)], shifts_[index(other)]});
  return before + distance_to_segment(c.p0, mesh_.point(other), c.p1);
}

std::optional<double> CollapseRules::cost(const Collapse& c) {
  const Kind kind = kinds_[index(c.v0)];
  if (kind == Kind::fixed || (kind != Kind::smooth && kind_of_edge(c.v0v1) != kind)) return {};
  const Error &e0 = errors_[index(c.v0)], &e1 = errors_[index(c.v1)];
  const double error = std::max(0.0, e0.quadric(c.p1) + e1.quadric(c.p1)), weight = e0.weight + e1.weight;
  const Limits& limits = limits_[component_[index(c.v0)]];
  if (error > weight * limits.error * limits.error) return {};
  if (kind != Kind::smooth) {
    const Vertex other = mesh_.to_vertex_handle(other_feature(c, kind));
    if (other == c.vl || other == c.vr) return {};
    if (kind == Kind::border && border_shift(c, other) > limits.border_shift) return {};
  }
  return error + length_weight * weight * (c.p1 - c.p0).sqrnorm();
}

bool CollapseRules::is_sound(const Collapse& c) {
  const bool one_face = mesh_.cw_rotated_halfedge_handle(mesh_.cw_rotated_halfedge_handle(c.v0v1)) == c.v0v1;
  if (one_face || !mesh_.is_collapse_ok(c.v0v1)) return false;
  const bool tetrahedron = c.vl.is_valid() && c.vr.is_valid() && mesh_.valence(c.vl) == 3 &&
                           mesh_.valence(c.vr) == 3 && mesh_.find_halfedge(c.vl, c.vr).is_valid();
  if (tetrahedron) return false;
  find_changes(c);
  return std::ranges::all_of(changes_, [&](const Change& change) { return stays_sound(change, c.p1); });
}

void CollapseRules::apply(const Collapse& c) {
  if (const Kind kind = kinds_[index(c.v0)]; kind == Kind::border) {
    const Vertex other = mesh_.to_vertex_handle(other_feature(c, kind));
    shifts_[index(c.v1)] = shifts_[index(other)] = static_cast<float>(border_shift(c, other));
  }
  find_changes(c);
  for (const Change& change : changes_) {
    vertices_[index(change.face)][change.corner] = static_cast<std::uint32_t>(c.v1.idx());
    wedges_[index(change.face)][change.corner] = change.wedge;
  }
  errors_[index(c.v1)].add(errors_[index(c.v0)].quadric, errors_[index(c.v0)].weight);
  mesh_.collapse(c.v0v1);
}

}  // namespace vitrail
