// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/write/write_sides.h"

#include <algorithm>
#include <utility>

#include "importers/shapes/vertex_normals.h"
#include "importers/writing/write_ply.h"
#include "scene/geometry/bounds.h"
#include "scene/shapes/deferred_mesh.h"
#include "scene/shapes/mesh_uv.h"

namespace vitrail::mitsuba_writer {

namespace {

Vector3d winding_normal(const TriangleMesh& mesh, std::size_t triangle) {
  const auto& t = mesh.triangles[triangle];
  const auto p = [&](int i) { return cast<double>(mesh.positions[t[static_cast<std::size_t>(i)]]); };
  return cross(p(1) - p(0), p(2) - p(0));
}

std::string write_derived(Context& context, const TriangleMesh& mesh) {
  std::string name = context.new_file("meshes", "sides.ply", context.derived_meshes);
  write_ply_part(mesh, context.file.parent_path() / name);
  return name;
}

// (u,v) that Mitsuba would take for others.
bool lacks_uvs(const Context& context, const Shape& shape, const TriangleMesh& mesh) {
  return context.uvs_show[shape.mesh.value] && mesh.uvs.empty() && mesh.missing_uv != MissingUv::barycentric;
}

bool is_face_indices(const MeshAttribute& a) { return a.name == face_indices; }

// Without the numbers of faces, which Mitsuba warns of.
TriangleMesh copy_of(const Context& context, const Shape& shape) {
  TriangleMesh storage;
  const TriangleMesh& mesh = loaded(context.scene.meshes[shape.mesh.value], storage);
  TriangleMesh copy = lacks_uvs(context, shape, mesh) ? with_uvs(mesh) : mesh;
  std::erase_if(copy.attributes, is_face_indices);
  return copy;
}

// Mitsuba transforms normals so that they keep their side where the transform mirrors, and the winding does
// not.
bool normals_point_behind(const TriangleMesh& mesh, const Shape& shape) {
  return !mesh.normals.empty() && normals_oppose_winding(mesh) != swaps_handedness(shape.object_to_world);
}

}  // namespace

MeshFile mesh_file(Context& context, const Shape& shape, bool sides_matter) {
  TriangleMesh storage;
  const TriangleMesh& mesh = loaded(context.scene.meshes[shape.mesh.value], storage);
  if (!sides_matter || !normals_point_behind(mesh, shape)) {
    const bool derived =
        (lacks_uvs(context, shape, mesh) || std::ranges::any_of(mesh.attributes, is_face_indices)) &&
        !context.meshes.has_name(shape.mesh);
    return {
        derived ? context.meshes.name(shape.mesh, copy_of(context, shape)) : context.meshes.name(shape.mesh),
        shape.flip_orientation};
  }
  context.approximated(
      "Mitsuba goes by the shading normals: a copy of the mesh is written, wound the other way");
  TriangleMesh copy = copy_of(context, shape);
  turn_round(copy, context.uvs_show[shape.mesh.value]);
  return {write_derived(context, copy), !shape.flip_orientation};
}

MeshFile back_of(Context& context, const Shape& shape) {
  constexpr double gap = 1e-4;  // of the diagonal
  TriangleMesh copy = copy_of(context, shape);
  bool flip = shape.flip_orientation;
  if (normals_point_behind(copy, shape)) {
    turn_round(copy, context.uvs_show[shape.mesh.value]);
    flip = !flip;
  }
  Bounds3f box;
  for (const Point3f p : copy.positions) extend(box, p);
  const double depth = gap * length(cast<double>(extent(box)));
  std::vector<Vector3d> normals(copy.positions.size());
  for (std::size_t i = 0; i < copy.triangles.size(); ++i)
    for (const std::uint32_t v : copy.triangles[i]) normals[v] = normals[v] + winding_normal(copy, i);
  const double behind = flip != swaps_handedness(shape.object_to_world) ? depth : -depth;
  for (std::size_t v = 0; v < normals.size(); ++v)
    copy.positions[v] = cast<float>(cast<double>(copy.positions[v]) + behind * normalize(normals[v]));
  return {write_derived(context, copy), !flip};
}

}  // namespace vitrail::mitsuba_writer
