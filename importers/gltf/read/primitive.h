// SPDX-License-Identifier: Apache-2.0
// A PrimitiveReader reads the attributes and triangles of one primitive.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "importers/gltf/read/document.h"
#include "scene/geometry/transform.h"

namespace vitrail::gltf {

class PrimitiveReader {
 public:
  PrimitiveReader(const Document& document, int mesh, const tinygltf::Primitive& primitive)
      : document_(document), mesh_(mesh), primitive_(primitive) {}

  bool has(const std::string& attribute) const { return primitive_.attributes.contains(attribute); }
  // Returns whether the attribute has a bufferView, so that there are plain numbers for it.
  bool has_data(const std::string& attribute) const;
  // Returns the channels of COLOR_0: 3 or 4, or 0 without it.
  int color_channels() const;

  // Reads as read_floats; fails where there are not as many elements as positions.
  std::vector<float> attribute(const std::string& name, int components) const;
  std::size_t vertices() const;

  // Returns those of triangles, strips and fans; none for points and lines.
  std::vector<std::array<std::uint32_t, 3>> triangles() const;

  // Adds the morph targets' differences of POSITION or NORMAL, each times its weight.
  void morph(const std::string& attribute, const std::vector<double>& weights,
             std::vector<float>& values) const;
  // Returns, for each vertex, the transform that the joints' weights come to.
  std::vector<Transform> skin(const std::vector<Transform>& joints) const;

  [[noreturn]] void fail(const std::string& what) const { document_.fail("meshes", mesh_, what); }

 private:
  const Document& document_;
  const int mesh_;
  const tinygltf::Primitive& primitive_;
};

}  // namespace vitrail::gltf
