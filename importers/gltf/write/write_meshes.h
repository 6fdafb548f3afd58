// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <tuple>
#include <vector>

#include "importers/gltf/write/write_materials.h"

namespace vitrail::gltf {

// It writes shapes as meshes of glTF. Data that several shapes use are written once.
class MeshWriter {
 public:
  MeshWriter(tinygltf::Model& model, Binary& binary, ConversionNotes& notes, MaterialWriter& materials);

  // Writes a mesh of these shapes, a primitive each; returns −1 where they have no triangles. All stand under
  // one transform.
  int write(const std::vector<const Shape*>& shapes);

 private:
  // They are the accessors of one mesh of the Scene.
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
