// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/write/write_meshes.h"

#include <algorithm>

#include "importers/writing/text_sink.h"
#include "scene/shapes/mesh_uv.h"

namespace vitrail::povray {

namespace {

using Triangle = std::array<std::uint32_t, 3>;

Point3f position(const MeshText& text, std::uint32_t i) {
  return cast<float>(transform_point(text.to_pov, cast<double>(text.mesh.positions[i])));
}

// Twice the area, along the normal of the side from which the vertices run counter-clockwise.
Vector3d area_vector(const MeshText& text, const Triangle& t) {
  const Point3d a = cast<double>(position(text, t[0]));
  return cross(cast<double>(position(text, t[1])) - a, cast<double>(position(text, t[2])) - a);
}

bool counts(const MeshText& text, const Triangle& t) { return length(area_vector(text, t)) > 0; }

void put_positions(const MeshText& text, TextSink& out) {
  out.put(FMT_COMPILE("vertex_vectors {{ {}"), text.mesh.positions.size());
  for (std::uint32_t i = 0; i < text.mesh.positions.size(); ++i) {
    const Point3f p = position(text, i);
    out.put(FMT_COMPILE(",\n<{},{},{}>"), p.x, p.y, p.z);
  }
  out.put(FMT_COMPILE(" }}\n"));
}

// Shading normals on the front side: there POV-Ray looks for the outside of a smooth triangle.
std::vector<Normal3f> front_normals(const MeshText& text) {
  std::vector<Vector3d> fronts(text.mesh.positions.size());
  for (const Triangle& t : text.mesh.triangles)
    for (const std::uint32_t i : t) fronts[i] = fronts[i] + area_vector(text, t) * (text.flip ? -1.0 : 1.0);
  std::vector<Normal3f> normals;
  normals.reserve(fronts.size());
  for (std::size_t i = 0; i < fronts.size(); ++i) {
    Vector3d n = normalize(to_vector(transform_normal(text.to_pov, cast<double>(text.mesh.normals[i]))));
    if (!(length(n) > 0)) n = normalize(fronts[i]);
    if (!(length(n) > 0)) n = {0, 0, 1};
    if (dot(n, fronts[i]) < 0) n = -n;
    normals.push_back(cast<float>(to_normal(n)));
  }
  return normals;
}

void put_normals(const MeshText& text, TextSink& out) {
  out.put(FMT_COMPILE("normal_vectors {{ {}"), text.mesh.normals.size());
  for (const Normal3f& n : front_normals(text)) out.put(FMT_COMPILE(",\n<{},{},{}>"), n.x, n.y, n.z);
  out.put(FMT_COMPILE(" }}\n"));
}

// Those of a triangle with an even number, and of one with an odd number.
void put_missing_uvs(const MeshText& text, TextSink& out) {
  out.put(FMT_COMPILE("uv_vectors {{ 6"));
  for (const std::size_t triangle : {0u, 1u})
    for (const Point2f& uv : missing_uvs(text.mesh.missing_uv, triangle))
      out.put(FMT_COMPILE(", <{},{}>"), uv.x, uv.y);
  out.put(FMT_COMPILE(" }}\n"));
}

void put_uvs(const MeshText& text, TextSink& out) {
  if (text.mesh.uvs.empty()) return put_missing_uvs(text, out);
  out.put(FMT_COMPILE("uv_vectors {{ {}"), text.mesh.uvs.size());
  for (const Point2f& uv : text.mesh.uvs) out.put(FMT_COMPILE(",\n<{},{}>"), uv.x, uv.y);
  out.put(FMT_COMPILE(" }}\n"));
}

// The outside of a flat triangle is where its vertices run clockwise (in a right-handed reading of the
// coordinates): POV-Ray's own space is left-handed.
void put_faces(const MeshText& text, TextSink& out) {
  const auto count =
      std::ranges::count_if(text.mesh.triangles, [&](const Triangle& t) { return counts(text, t); });
  const std::size_t second = text.flip ? 1 : 2, third = 3 - second;
  out.put(FMT_COMPILE("face_indices {{ {}"), count);
  for (const Triangle& t : text.mesh.triangles)
    if (counts(text, t)) out.put(FMT_COMPILE(",\n<{},{},{}>"), t[0], t[second], t[third]);
  out.put(FMT_COMPILE(" }}\n"));
  if (!text.with_uvs || !text.mesh.uvs.empty()) return;
  out.put(FMT_COMPILE("uv_indices {{ {}"), count);
  for (std::size_t i = 0; i < text.mesh.triangles.size(); ++i) {
    const std::size_t first = 3 * (i % 2);
    if (counts(text, text.mesh.triangles[i]))
      out.put(FMT_COMPILE(",\n<{},{},{}>"), first, first + second, first + third);
  }
  out.put(FMT_COMPILE(" }}\n"));
}

void put_mesh(const MeshText& text, TextSink& out) {
  put_positions(text, out);
  if (!text.mesh.normals.empty()) put_normals(text, out);
  if (text.with_uvs) put_uvs(text, out);
  put_faces(text, out);
}

}  // namespace

bool has_area(const MeshText& text) {
  return std::ranges::any_of(text.mesh.triangles, [&](const Triangle& t) { return counts(text, t); });
}

std::string mesh_text(const MeshText& text) {
  TextSink out;
  put_mesh(text, out);
  return out.text();
}

void write_mesh_text(const MeshText& text, const std::filesystem::path& path) {
  AtomicFile file(path);
  TextSink out(&file);
  put_mesh(text, out);
  out.flush();
  file.commit_part();
}

std::optional<Rectangle> rectangle_of(const MeshText& text) {
  if (text.mesh.triangles.size() != 2) return {};
  std::array<std::array<Point3d, 3>, 2> p;
  for (std::size_t t = 0; t < 2; ++t)
    for (std::size_t i = 0; i < 3; ++i)
      p[t][i] = transform_point(text.to_pov, cast<double>(text.mesh.positions[text.mesh.triangles[t][i]]));
  // The corner of each triangle that the other has not; the diagonal is what they share.
  std::array<std::size_t, 2> alone{3, 3};
  for (std::size_t t = 0; t < 2; ++t)
    for (std::size_t i = 0; i < 3; ++i)
      if (std::ranges::count(p[1 - t], p[t][i]) == 0) {
        if (alone[t] != 3) return {};
        alone[t] = i;
      }
  if (alone[0] == 3 || alone[1] == 3) return {};
  Rectangle r;
  r.corner = p[0][alone[0]];
  r.edge_u = p[0][(alone[0] + 1) % 3] - r.corner;
  r.edge_v = p[0][(alone[0] + 2) % 3] - r.corner;
  const Vector3d miss = p[1][alone[1]] - (r.corner + r.edge_u + r.edge_v);
  const double u = length(r.edge_u), v = length(r.edge_v);
  constexpr double tolerance = 1e-4;
  if (!(u > 0 && v > 0) || std::abs(dot(r.edge_u, r.edge_v)) > tolerance * u * v ||
      length(miss) > tolerance * std::min(u, v))
    return {};
  r.front = normalize(cross(r.edge_u, r.edge_v)) * (text.flip ? -1.0 : 1.0);
  return r;
}

}  // namespace vitrail::povray
