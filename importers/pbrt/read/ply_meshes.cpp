// SPDX-License-Identifier: Apache-2.0
#include "importers/pbrt/read/ply_meshes.h"

#include "importers/pbrt/read/mesh_fronts.h"
#include "importers/shapes/shapes.h"

namespace vitrail::pbrt {

namespace {

// The vertices that the faces use, which are numbered anew.
template <std::size_t corners>
TriangleMesh used_vertices(const TriangleMesh& all, std::vector<std::array<std::uint32_t, corners>>& faces) {
  constexpr std::uint32_t none = 0xffffffffu;
  TriangleMesh used;
  std::vector<std::uint32_t> numbers(all.positions.size(), none);
  for (auto& face : faces)
    for (std::uint32_t& corner : face) {
      std::uint32_t& number = numbers[corner];
      if (number == none) {
        number = static_cast<std::uint32_t>(used.positions.size());
        used.positions.push_back(all.positions[corner]);
        if (!all.normals.empty()) used.normals.push_back(all.normals[corner]);
        if (!all.uvs.empty()) used.uvs.push_back(all.uvs[corner]);
      }
      corner = number;
    }
  return used;
}

// The vertices are freed with it.
// NOLINTNEXTLINE(performance-unnecessary-value-param)
PlyMesh mesh_of_patches(TriangleMesh vertices, const std::vector<std::array<std::uint32_t, 4>>& patches,
                        bool uvs_show) {
  PlyMesh made{tessellate_bilinear(vertices.positions, patches, vertices.normals, vertices.uvs, uvs_show),
               patches.size(), false};
  made.tessellated = made.mesh.triangles.size() > 2 * patches.size();
  return made;
}

}  // namespace

void add_face_indices(TriangleMesh& mesh, const std::vector<float>& faces) {
  if (faces.empty()) return;
  MeshAttribute indices{std::string(face_indices), true, 1, {}};
  const std::size_t each = mesh.triangles.size() / faces.size();
  for (const float face : faces) indices.values.insert(indices.values.end(), each, face);
  mesh.attributes.push_back(std::move(indices));
}

PbrtQuads quads_of(Version version) { return version == Version::v3 ? PbrtQuads::v3 : PbrtQuads::v4; }

std::vector<PlyMesh> meshes_of(PbrtPly ply, bool uvs_show, bool faces_show, bool* differs) {
  bool depends = !ply.patches.empty() || !ply.mesh.attributes.empty();
  std::vector<float> triangle_faces;
  if (faces_show && !ply.mesh.attributes.empty())
    triangle_faces = std::move(ply.mesh.attributes.front().values);
  ply.mesh.attributes.clear();
  if (!faces_show) ply.patch_faces.clear();
  std::vector<PlyMesh> made;
  if (ply.patches.empty()) {
    const std::size_t parts = ply.mesh.triangles.size();
    add_face_indices(ply.mesh, triangle_faces);
    made.push_back({std::move(ply.mesh), parts, false});
  } else if (ply.mesh.triangles.empty()) {
    made.push_back(mesh_of_patches(std::move(ply.mesh), ply.patches, uvs_show));
    add_face_indices(made.back().mesh, ply.patch_faces);
  } else {
    auto triangles = std::move(ply.mesh.triangles);
    TriangleMesh mesh = used_vertices(ply.mesh, triangles);
    mesh.triangles = std::move(triangles);
    add_face_indices(mesh, triangle_faces);
    const std::size_t parts = mesh.triangles.size();
    made.push_back({std::move(mesh), parts, false});
    TriangleMesh vertices = used_vertices(ply.mesh, ply.patches);
    made.push_back(mesh_of_patches(std::move(vertices), ply.patches, uvs_show));
    add_face_indices(made.back().mesh, ply.patch_faces);
  }
  for (PlyMesh& part : made) depends |= orient_by_normals(part.mesh, uvs_show);
  if (differs) *differs = depends;
  return made;
}

}  // namespace vitrail::pbrt
