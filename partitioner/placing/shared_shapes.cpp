// SPDX-License-Identifier: Apache-2.0
#include "partitioner/placing/shared_shapes.h"

#include <array>
#include <bit>
#include <map>

#include "scene/shapes/deferred_mesh.h"

namespace vitrail {

namespace {

// Tracing an instance costs up to 1.4 times a copy: little is copied.
constexpr std::uint64_t least_saved_triangles = 1 << 18;  // 16 MB in domain files

}  // namespace

ShapeKey key_of(const Shape& shape) {
  const auto number = [](const auto& id) { return id ? id->value + 1 : 0u; };
  const auto* opacity = std::get_if<float>(&shape.opacity);
  return {shape.mesh.value,
          shape.material.value,
          number(shape.area_light),
          number(shape.interior),
          number(shape.exterior),
          SharedShapes::flip_in_object(shape) ? 1u : 0u,
          opacity ? 1u : 0u,
          opacity ? std::bit_cast<std::uint32_t>(*opacity) : std::get<Id<Texture>>(shape.opacity).value};
}

SharedShapes::SharedShapes(const Scene& scene) {
  std::vector<std::uint64_t> uses(scene.meshes.size());
  for (const Shape& shape : scene.shapes) ++uses.at(shape.mesh.value);
  const auto saves = [&](std::uint32_t mesh, std::uint64_t copies) {
    return copies > 1 && !scene.meshes[mesh].quadric &&
           (copies - 1) * triangles_of(scene.meshes[mesh]) >= least_saved_triangles;
  };
  struct Group {
    std::uint64_t uses = 0;
    std::uint32_t number = 0;
  };
  std::map<ShapeKey, Group> found;
  for (const Shape& shape : scene.shapes)
    if (saves(shape.mesh.value, uses[shape.mesh.value])) ++found[key_of(shape)].uses;
  if (found.empty()) return;
  group_of_.resize(scene.shapes.size());
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
    const Shape& shape = scene.shapes[i];
    const auto group = found.find(key_of(shape));
    if (group == found.end() || !saves(shape.mesh.value, group->second.uses)) continue;
    if (group->second.number == 0) {
      groups_.push_back(&shape);
      group->second.number = static_cast<std::uint32_t>(groups_.size());
    }
    group_of_[i] = group->second.number;
  }
}

std::optional<std::uint32_t> SharedShapes::group_of(std::size_t shape) const {
  if (group_of_.empty() || group_of_[shape] == 0) return std::nullopt;
  return group_of_[shape] - 1;
}

}  // namespace vitrail
