// SPDX-License-Identifier: Apache-2.0
#include "partitioner/meshes/decimate.h"

#include <OpenMesh/Core/System/omstream.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <algorithm>
#include <cmath>

#include "partitioner/meshes/collapse_rules.h"
#include "partitioner/meshes/surface.h"
#include "scene/bounds.h"

namespace vitrail {

namespace {

using Decimater = OpenMesh::Decimater::DecimaterT<HalfEdges>;

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
HalfEdges connect(const TriangleMesh& mesh, Surface& surface) {
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

DecimatedMesh unchanged(const TriangleMesh& mesh) { return {mesh, mesh.triangles.size(), 0, true}; }

}  // namespace

DecimatedMesh decimate(const TriangleMesh& mesh, double fraction) {
  const auto asked =
      static_cast<std::size_t>(std::ceil(fraction * static_cast<double>(mesh.triangles.size())));
  if (asked >= mesh.triangles.size()) return unchanged(mesh);
  TriangleMesh source = mesh;
  if (!source.normals.empty() && is_flat(source)) source.normals.clear();
  Surface surface = surface_of(source);
  DecimatedMesh result;
  result.asked = asked;
  result.degenerate = mesh.triangles.size() - surface.triangles.size();
  HalfEdges half_edges = connect(source, surface);
  result.manifold = surface.is_manifold();
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> sources;
  {
    Decimater decimater(half_edges);
    CollapseRules::Handle handle;
    decimater.add(handle);
    CollapseRules& rules = decimater.module(handle);
    rules.prepare(source, surface);
    decimater.initialize();
    decimater.decimate_to_faces(0, asked);
    for (const auto f : half_edges.faces()) {  // deleted ones are left out
      const auto i = static_cast<std::size_t>(f.idx());
      triangles.push_back(rules.wedges()[i]);
      sources.push_back(surface.sources[i]);
    }
  }
  result.mesh = with_triangles(source, triangles, sources);
  return result;
}

}  // namespace vitrail
