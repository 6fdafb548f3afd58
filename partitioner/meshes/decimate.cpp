// SPDX-License-Identifier: Apache-2.0
#include "partitioner/meshes/decimate.h"

#include <OpenMesh/Core/System/omstream.hh>
#include <algorithm>
#include <cmath>
#include <queue>

#include "partitioner/meshes/collapse_rules.h"
#include "partitioner/meshes/surface.h"
#include "scene/geometry/bounds.h"

namespace vitrail {

namespace {

// Every shading normal is its triangle's own.
bool is_flat(const TriangleMesh& mesh) {
  constexpr double least_cosine = 0.9999;
  return std::ranges::all_of(mesh.triangles, [&](const Triangle& t) {
    const Vector3d front = normalize(scaled_normal(mesh, t));
    return std::ranges::all_of(t, [&](std::uint32_t v) {
      const double cosine = dot(normalize(to_vector(cast<double>(mesh.normals[v]))), front);
      return std::abs(cosine) > least_cosine || dot(front, front) == 0;
    });
  });
}

// Scaled to a diagonal of 1, so that errors have one unit.
HalfEdges connect(const TriangleMesh& mesh, MeshSurface& surface) {
  ::omerr().disable();  // it would write of complex edges to standard error
  Bounds3d bounds;
  for (const std::uint32_t p : surface.points) extend(bounds, cast<double>(mesh.positions[p]));
  const double diagonal = length(extent(bounds));
  const auto place = [&](std::uint32_t p) {
    const Vector3d v = (cast<double>(mesh.positions[p]) - center(bounds)) * (1 / diagonal);
    return OpenMesh::Vec3d(v.x, v.y, v.z);
  };
  HalfEdges half_edges;
  half_edges.reserve(surface.points.size(), surface.points.size() + surface.triangles.size(),
                     surface.triangles.size());
  for (const std::uint32_t p : surface.points) half_edges.add_vertex(place(p));
  const auto add = [&](const Triangle& t) {
    const auto vertex = [](std::uint32_t v) { return OpenMesh::VertexHandle(static_cast<int>(v)); };
    return half_edges.add_face(vertex(t[0]), vertex(t[1]), vertex(t[2])).is_valid();
  };
  for (Triangle& t : surface.triangles) {
    if (add(t)) continue;
    for (std::uint32_t& v : t) {  // two of its vertices are joined by another edge already: it stands alone
      const std::uint32_t point = surface.points[v];
      surface.held[v] = true;
      v = static_cast<std::uint32_t>(surface.points.size());
      surface.points.push_back(point);
      surface.held.push_back(true);
      half_edges.add_vertex(place(point));
    }
    add(t);
  }
  return half_edges;
}

// Vertices by the cost of their cheapest collapse. Whether that leaves the surface sound is asked only when
// it comes to be the least: OpenMesh's own decimater asks it of every edge at each change, and takes 4 times
// as long.
class Queue {
 public:
  Queue(HalfEdges& mesh, CollapseRules& rules) : mesh_(mesh), rules_(rules), vertices_(mesh.n_vertices()) {
    for (const auto v : mesh.vertices()) push(v, false);
  }

  // The number of triangles that it removes; 0 where nothing is left to do.
  std::size_t collapse_cheapest() {
    while (!entries_.empty()) {
      const Entry entry = entries_.top();
      entries_.pop();
      const OpenMesh::VertexHandle v(static_cast<int>(entry.vertex));
      if (entry.version != vertices_[entry.vertex].version) continue;
      vertices_[entry.vertex].queued = false;
      const CollapseRules::Collapse collapse(mesh_, vertices_[entry.vertex].cheapest);
      if (!rules_.is_sound(collapse)) {
        if (!entry.sound) push(v, true);  // the cheapest that is; later changes around v bring it back
        continue;
      }
      ring_.assign(mesh_.vv_range(v).begin(), mesh_.vv_range(v).end());
      const std::size_t removed = collapse.fl.is_valid() && collapse.fr.is_valid() ? 2 : 1;
      rules_.apply(collapse);
      ++vertices_[entry.vertex].version;
      for (const auto neighbour : ring_) push(neighbour, false);
      return removed;
    }
    return 0;
  }

 private:
  struct Entry {
    double cost;
    std::uint32_t vertex, version;
    bool sound;                                 // when it was pushed
    bool operator<(const Entry& other) const {  // the cheapest is on top
      return cost != other.cost ? cost > other.cost : vertex > other.vertex;
    }
  };
  struct VertexState {
    std::uint32_t version = 0;  // entries of others are outdated
    bool queued = false;
    double cost = 0;
    OpenMesh::HalfedgeHandle cheapest;
  };

  void push(OpenMesh::VertexHandle v, bool only_sound) {
    const auto number = static_cast<std::uint32_t>(v.idx());
    VertexState& state = vertices_[number];
    VertexState found;
    found.version = state.version + 1;
    for (const auto h : mesh_.voh_range(v)) {
      const CollapseRules::Collapse collapse(mesh_, h);
      const std::optional<double> cost = rules_.cost(collapse);
      if (!cost || (found.queued && found.cost <= *cost) || (only_sound && !rules_.is_sound(collapse)))
        continue;
      found = {found.version, true, *cost, h};
    }
    if (found.queued && state.queued && found.cost == state.cost && found.cheapest == state.cheapest) return;
    state = found;
    if (found.queued) entries_.push({found.cost, number, found.version, only_sound});
  }

  HalfEdges& mesh_;
  CollapseRules& rules_;
  std::vector<VertexState> vertices_;
  std::priority_queue<Entry> entries_;
  std::vector<OpenMesh::VertexHandle> ring_;
};

DecimatedMesh unchanged(const TriangleMesh& mesh) { return {mesh, mesh.triangles.size(), 0, true}; }

}  // namespace

DecimatedMesh decimate(const TriangleMesh& mesh, double fraction) {
  const auto asked =
      static_cast<std::size_t>(std::ceil(fraction * static_cast<double>(mesh.triangles.size())));
  if (asked >= mesh.triangles.size()) return unchanged(mesh);
  TriangleMesh source = mesh;
  if (!source.normals.empty() && is_flat(source)) source.normals.clear();
  MeshSurface surface = surface_of(source);
  DecimatedMesh result;
  result.asked = asked;
  result.degenerate = mesh.triangles.size() - surface.triangles.size();
  HalfEdges half_edges = connect(source, surface);
  result.manifold = surface.is_manifold();
  half_edges.request_vertex_status();
  half_edges.request_edge_status();
  half_edges.request_face_status();
  CollapseRules rules(half_edges, source, surface);
  Queue queue(half_edges, rules);
  std::size_t left = surface.triangles.size();
  while (left > asked) {
    const auto removed = queue.collapse_cheapest();
    if (removed == 0) break;
    left -= removed;
  }
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> sources;
  for (const auto f : half_edges.faces()) {  // deleted ones are left out
    const auto i = static_cast<std::size_t>(f.idx());
    triangles.push_back(rules.wedges()[i]);
    sources.push_back(surface.sources[i]);
  }
  result.mesh = with_triangles(source, triangles, sources);
  return result;
}

}  // namespace vitrail
