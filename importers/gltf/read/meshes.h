// SPDX-License-Identifier: Apache-2.0
// Meshes makes meshes of the primitives of glTF's meshes.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "importers/gltf/read/materials.h"
#include "importers/gltf/read/primitive.h"
#include "scene/geometry/transform.h"
#include "scene/models/turned_normal_maps.h"
#include "scene/shapes/deferred_mesh.h"

namespace vitrail::gltf {

// It is a primitive as a mesh and what it looks like.
struct Part {
  Id<TriangleMesh> mesh;
  Surface surface;
  AgainstAxes against;  // where its normal map is to be turned
};

// A node that uses a mesh bends it by a Pose.
struct Pose {
  std::vector<double> weights;    // of morph targets; none: the mesh's own
  std::vector<Transform> joints;  // from the mesh at rest to the world; none: it has no skin
};

class Meshes {
 public:
  Meshes(const Document& document, Scene& scene, Diagnostics& diagnostics, MeshMemory& memory)
      : document_(document),
        scene_(scene),
        diagnostics_(diagnostics),
        memory_(memory),
        materials_(document, scene, diagnostics),
        turned_materials_(scene) {}

  // They make triangles of triangles, strips and fans; points and lines are reported and left out. A mesh
  // without normals has flat ones. Wrong indices, and attributes of another length than the positions, throw
  // Error.
  const std::vector<Part>& parts(int mesh);
  std::vector<Part> posed_parts(int mesh, const Pose& pose);

  Materials& materials() { return materials_; }
  TurnedMaterials& turned_materials() { return turned_materials_; }

 private:
  void add_part(int mesh, const tinygltf::Primitive& primitive, const Pose& pose, std::vector<Part>& parts);
  void add_uvs(int mesh, const PrimitiveReader& reader, const Surface& surface, TriangleMesh& to);
  void add_colors(int mesh, const PrimitiveReader& reader, const Surface& surface, TriangleMesh& to);
  void keep(int mesh, const PrimitiveReader& reader, const Surface& surface, TriangleMesh parts_of,
            std::vector<Part>& parts);
  void note(Fidelity fidelity, int mesh, const std::string& what);

  const Document& document_;
  Scene& scene_;
  Diagnostics& diagnostics_;
  MeshMemory& memory_;
  Materials materials_;
  TurnedMaterials turned_materials_;
  std::map<int, std::vector<Part>> known_;
};

}  // namespace vitrail::gltf
