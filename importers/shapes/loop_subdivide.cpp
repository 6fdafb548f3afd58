// SPDX-License-Identifier: Apache-2.0
// OpenMesh supplies the half-edge structure. Its own Loop subdivider is not used: its weights at irregular
// vertices are Loop's first ones, not Warren's, and it has no limit surface.
#include <fmt/format.h>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <algorithm>
#include <cmath>
#include <limits>

#include "importers/shapes/shapes.h"
#include "scene/geometry/unit_circle.h"

namespace vitrail {

namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

struct DoublePoints : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
};
using HalfEdges = OpenMesh::TriMesh_ArrayKernelT<DoublePoints>;
using Vec = OpenMesh::Vec3d;
using Vertex = OpenMesh::VertexHandle;

Vertex vertex(std::uint32_t i) { return Vertex(static_cast<int>(i)); }

HalfEdges connect(const std::vector<Vec>& positions, const Triangles& triangles) {
  ::omerr().disable();  // it would write of complex edges to standard error
  HalfEdges mesh;
  mesh.reserve(positions.size(), positions.size() + triangles.size(), triangles.size());
  for (const Vec& p : positions) mesh.add_vertex(p);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto [a, b, c] = triangles[i];
    const bool distinct = a != b && b != c && c != a;
    if (!distinct || !mesh.add_face(vertex(a), vertex(b), vertex(c)).is_valid()) {
      throw Error(fmt::format(
          "subdivision: triangle {} ({}, {}, {}) makes the cage non-manifold or is turned against its "
          "neighbours",
          i, a, b, c));
    }
  }
  for (const Vertex v : mesh.vertices()) {
    if (!mesh.is_manifold(v)) {
      throw Error(
          fmt::format("subdivision: the surface only touches itself at vertex {} of the cage", v.idx()));
    }
  }
  return mesh;
}

// Neighbours counter-clockwise, seen from the front; on the boundary from one boundary edge to the other.
void one_ring(const HalfEdges& mesh, Vertex v, std::vector<Vec>& ring) {
  ring.clear();
  const auto last = mesh.halfedge_handle(v);  // the boundary's, where there is one
  auto h = last;
  do {
    h = mesh.ccw_rotated_halfedge_handle(h);
    ring.push_back(mesh.point(mesh.to_vertex_handle(h)));
  } while (h != last);
}

Vec sum(const std::vector<Vec>& ring) {
  Vec total(0, 0, 0);
  for (const Vec& p : ring) total += p;
  return total;
}

// The vertex masks of refinement (β of Warren 1995; 1/8 on boundaries) and of the limit have one form:
// `weight` to each neighbour, the rest to the vertex.
Vec blend(const HalfEdges& mesh, Vertex v, const std::vector<Vec>& ring, double interior_weight,
          double boundary_weight) {
  const Vec p = mesh.point(v);
  if (mesh.is_boundary(v))
    return p * (1 - 2 * boundary_weight) + (ring.front() + ring.back()) * boundary_weight;
  return p * (1 - static_cast<double>(ring.size()) * interior_weight) + sum(ring) * interior_weight;
}

double beta(std::size_t valence) {
  return valence == 3 ? 3.0 / 16 : 3.0 / (8 * static_cast<double>(valence));
}

double limit_weight(std::size_t valence) {
  return 1 / (static_cast<double>(valence) + 3 / (8 * beta(valence)));
}

Vec edge_point(const HalfEdges& mesh, OpenMesh::EdgeHandle e) {
  const auto h = mesh.halfedge_handle(e, 0), o = mesh.halfedge_handle(e, 1);
  const Vec ends = mesh.point(mesh.to_vertex_handle(h)) + mesh.point(mesh.to_vertex_handle(o));
  if (mesh.is_boundary(e)) return ends * 0.5;
  const auto opposite = [&](auto half) {
    return mesh.point(mesh.to_vertex_handle(mesh.next_halfedge_handle(half)));
  };
  return ends * 0.375 + (opposite(h) + opposite(o)) * 0.125;
}

using CornerParameters = std::vector<std::array<Point2d, 3>>;

Point2d between(Point2d a, Point2d b) { return {(a.x + b.x) / 2, (a.y + b.y) / 2}; }

void refine(std::vector<Vec>& positions, Triangles& triangles, CornerParameters* parameters) {
  const HalfEdges mesh = connect(positions, triangles);
  positions.resize(mesh.n_vertices() + mesh.n_edges());
  std::vector<Vec> ring;
  for (const Vertex v : mesh.vertices()) {
    one_ring(mesh, v, ring);
    positions[static_cast<std::size_t>(v.idx())] = blend(mesh, v, ring, beta(ring.size()), 0.125);
  }
  const auto edge_vertex = [&](OpenMesh::EdgeHandle e) {
    return static_cast<std::uint32_t>(mesh.n_vertices()) + static_cast<std::uint32_t>(e.idx());
  };
  for (const auto e : mesh.edges()) positions[edge_vertex(e)] = edge_point(mesh, e);
  Triangles finer;
  finer.reserve(4 * triangles.size());
  CornerParameters finer_parameters;
  for (const auto f : mesh.faces()) {
    std::array<std::uint32_t, 3> corner{}, middle{};  // middle[i] lies between corner[i] and corner[i + 1]
    auto h = mesh.halfedge_handle(f);
    for (std::size_t i = 0; i < 3; ++i, h = mesh.next_halfedge_handle(h)) {
      corner[i] = static_cast<std::uint32_t>(mesh.from_vertex_handle(h).idx());
      middle[i] = edge_vertex(mesh.edge_handle(h));
    }
    for (std::size_t i = 0; i < 3; ++i) finer.push_back({corner[i], middle[i], middle[(i + 2) % 3]});
    finer.push_back(middle);
    if (!parameters) continue;
    const auto face = static_cast<std::size_t>(f.idx());
    const auto shift = static_cast<std::size_t>(std::ranges::find(triangles[face], corner[0]) -
                                                triangles[face].begin());  // half-edges may start elsewhere
    std::array<Point2d, 3> at{}, half{};
    for (std::size_t i = 0; i < 3; ++i) at[i] = (*parameters)[face][(i + shift) % 3];
    for (std::size_t i = 0; i < 3; ++i) half[i] = between(at[i], at[(i + 1) % 3]);
    for (std::size_t i = 0; i < 3; ++i) finer_parameters.push_back({at[i], half[i], half[(i + 2) % 3]});
    finer_parameters.push_back(half);
  }
  triangles = std::move(finer);
  if (parameters) *parameters = std::move(finer_parameters);
}

// Tangent masks of the limit surface: Hoppe et al. 1994, appendix A.
Vec limit_normal(const Vec& p, const std::vector<Vec>& ring, bool boundary) {
  const std::size_t k = ring.size();
  Vec s(0, 0, 0), t(0, 0, 0);
  if (!boundary) {
    for (std::size_t i = 0; i < k; ++i) {
      const Point2d d = unit_circle(2 * pi * static_cast<double>(i) / static_cast<double>(k));
      s += ring[i] * d.x;
      t += ring[i] * d.y;
    }
    return cross(s, t);
  }
  s = ring.front() - ring.back();  // along the boundary
  if (k == 2) {
    t = ring[0] + ring[1] - p * 2;
  } else if (k == 3) {
    t = ring[1] - p;
  } else if (k == 4) {
    t = ring[1] * 2 + ring[2] * 2 - ring[0] - ring[3] - p * 2;
  } else {
    const double angle = pi / static_cast<double>(k - 1);
    const Point2d d = unit_circle(angle);
    t = (ring.front() + ring.back()) * -d.y;
    for (std::size_t i = 1; i + 1 < k; ++i) {
      t += ring[i] * ((2 - 2 * d.x) * unit_circle(angle * static_cast<double>(i)).y);
    }
  }
  return cross(s, t);
}

TriangleMesh to_limit(const std::vector<Vec>& positions, const Triangles& triangles) {
  const HalfEdges mesh = connect(positions, triangles);
  TriangleMesh result;
  result.positions.reserve(positions.size());
  result.normals.reserve(positions.size());
  result.triangles = triangles;
  std::vector<Vec> ring;
  for (const Vertex v : mesh.vertices()) {
    one_ring(mesh, v, ring);
    const Vec p = blend(mesh, v, ring, limit_weight(ring.size()), 1.0 / 6);
    const Vec n = limit_normal(mesh.point(v), ring, mesh.is_boundary(v));
    result.positions.push_back(cast<float>(Point3d{p[0], p[1], p[2]}));
    result.normals.push_back(cast<float>(to_normal(normalize(Vector3d{n[0], n[1], n[2]}))));
  }
  return result;
}

// The cage without the vertices that no triangle uses.
void copy_used(const TriangleMesh& cage, std::vector<Vec>& positions, Triangles& triangles) {
  constexpr std::uint32_t unused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> place(cage.positions.size(), unused);
  for (const auto& triangle : cage.triangles) {
    auto& copy = triangles.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      if (triangle[i] >= cage.positions.size())
        throw Error("subdivision: an index is beyond the vertices of the cage");
      const Point3f p = cage.positions[triangle[i]];
      if (!is_finite(p)) throw Error("subdivision: a vertex of the cage is not finite");
      if (place[triangle[i]] == unused) {
        place[triangle[i]] = static_cast<std::uint32_t>(positions.size());
        positions.emplace_back(p.x, p.y, p.z);
      }
      copy[i] = place[triangle[i]];
    }
  }
}

}  // namespace

TriangleMesh loop_subdivide(const TriangleMesh& cage, int levels,
                            std::vector<std::array<Point2d, 3>>* parameters) {
  constexpr double most_triangles = 1 << 30;  // half-edges are counted by int
  if (levels < 0) throw Error(fmt::format("subdivision: {} levels; the number has to be 0 or more", levels));
  if (static_cast<double>(cage.triangles.size()) * std::pow(4.0, levels) > most_triangles) {
    throw Error(fmt::format("subdivision: {} levels of {} triangles are more than {:.0f}; lower the levels",
                            levels, cage.triangles.size(), most_triangles));
  }
  std::vector<Vec> positions;
  Triangles triangles;
  copy_used(cage, positions, triangles);
  if (parameters) parameters->assign(triangles.size(), {Point2d{0, 0}, {1, 0}, {0, 1}});
  for (int i = 0; i < levels; ++i) refine(positions, triangles, parameters);
  return to_limit(positions, triangles);
}

}  // namespace vitrail
