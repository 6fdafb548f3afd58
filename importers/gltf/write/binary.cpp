// SPDX-License-Identifier: Apache-2.0
#include "importers/gltf/write/binary.h"

#include <algorithm>
#include <limits>

#include "scene/system/diagnostics.h"

namespace vitrail::gltf {

int Binary::view(std::span<const std::byte> content, int target) {
  std::vector<unsigned char>& data = model_.buffers.front().data;
  constexpr std::size_t alignment = 4;
  data.resize((data.size() + alignment - 1) / alignment * alignment);
  if (content.size() > std::numeric_limits<std::uint32_t>::max() - data.size())
    throw Error(
        "the scene's meshes and images come to more than the 4 GiB that a glTF file holds: "
        "write .pbrt or .xml");
  tinygltf::BufferView view;
  view.buffer = 0, view.byteOffset = data.size(), view.byteLength = content.size(), view.target = target;
  const auto* begin = reinterpret_cast<const unsigned char*>(content.data());
  data.insert(data.end(), begin, begin + content.size());
  model_.bufferViews.push_back(view);
  return static_cast<int>(model_.bufferViews.size()) - 1;
}

int Binary::bytes(std::span<const std::byte> content) { return view(content, 0); }

int Binary::floats(std::span<const float> values, int type, bool with_bounds) {
  const auto components =
      static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type)));
  tinygltf::Accessor accessor;
  accessor.bufferView = view(std::as_bytes(values), TINYGLTF_TARGET_ARRAY_BUFFER);
  accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT, accessor.type = type;
  accessor.count = values.size() / components;
  for (std::size_t c = 0; with_bounds && c < components && !values.empty(); ++c) {
    float least = values[c], most = values[c];
    for (std::size_t i = c; i < values.size(); i += components)
      least = std::min(least, values[i]), most = std::max(most, values[i]);
    accessor.minValues.push_back(static_cast<double>(least)),
        accessor.maxValues.push_back(static_cast<double>(most));
  }
  model_.accessors.push_back(std::move(accessor));
  return static_cast<int>(model_.accessors.size()) - 1;
}

int Binary::indices(const std::vector<std::uint32_t>& corners, std::size_t vertices) {
  tinygltf::Accessor accessor;
  accessor.type = TINYGLTF_TYPE_SCALAR, accessor.count = corners.size();
  if (vertices < std::numeric_limits<std::uint16_t>::max()) {
    const std::vector<std::uint16_t> narrow(corners.begin(), corners.end());
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
    accessor.bufferView = view(std::as_bytes(std::span(narrow)), TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
  } else {
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    accessor.bufferView = view(std::as_bytes(std::span(corners)), TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
  }
  model_.accessors.push_back(std::move(accessor));
  return static_cast<int>(model_.accessors.size()) - 1;
}

}  // namespace vitrail::gltf
