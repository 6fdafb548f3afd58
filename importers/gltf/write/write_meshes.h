// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <tuple>
#include <vector>

#include "importers/gltf/write/write_materials.h"

namespace vitrail::gltf {

// Shapes as meshes of glTF. What several use is written once.
class MeshWriter {
 public:
  MeshWriter(tinygltf::Model& model, Binary& binary, ConversionNotes& notes, MaterialWriter& materials);

  // A mesh of these shapes, a primitive each; −1 where they have no triangles. All stand under one transform.
  int write(const std::vector<const Shape*>& shapes);

 private:
  // Of one mesh of the Scene.
  struct Accessors {
    std::map<std::string, int> attributes;
    int indices = -1;
  };
  const Accessors& accessors(Id<TriangleMesh> mesh, bool turned, const std::string& color,
                             const Shape& shape);

  tinygltf::Model& model_;
  Binary& binary_;
  ConversionNotes& notes_;
  MaterialWriter& materials_;
  std::vector<bool> uvs_show_;
  std::map<std::tuple<std::uint32_t, bool, std::string>, Accessors> known_;
  std::map<std::vector<std::tuple<std::uint32_t, bool, int>>, int> meshes_;
};

}  // namespace vitrail::gltf
