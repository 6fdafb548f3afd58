// SPDX-License-Identifier: Apache-2.0
// Binary makes the one buffer of a written glTF, and accessors of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "importers/gltf/tinygltf.h"

namespace vitrail::gltf {

class Binary {
 public:
  explicit Binary(tinygltf::Model& model) : model_(model) { model_.buffers.emplace_back(); }

  // Each function returns the index of a new accessor or bufferView. Throws Error beyond 4 GiB, which a .glb
  // cannot hold.
  int floats(std::span<const float> values, int type, bool with_bounds = false);
  int indices(const std::vector<std::uint32_t>& corners, std::size_t vertices);
  int bytes(std::span<const std::byte> content);

 private:
  int view(std::span<const std::byte> content, int target);

  tinygltf::Model& model_;
};

}  // namespace vitrail::gltf
