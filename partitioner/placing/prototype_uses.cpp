// SPDX-License-Identifier: Apache-2.0
#include "partitioner/placing/prototype_uses.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <limits>

#include "bundle/instance.h"
#include "bundle/triangle_number.h"
#include "scene/shapes/deferred_mesh.h"

namespace vitrail {

namespace {

constexpr int max_depth = max_instance_depth - 1;  // of prototypes: the quadrics in them are instances, too
static_assert(max_depth >= 32 / 4 && max_depth >= 64 / 8);

// Nested instances are more than can be counted.
std::uint64_t saturating_sum(std::uint64_t a, std::uint64_t b) {
  return b > std::numeric_limits<std::uint64_t>::max() - a ? std::numeric_limits<std::uint64_t>::max()
                                                           : a + b;
}

}  // namespace

PrototypeUses::PrototypeUses(const Scene& scene)
    : scene_(scene.prototypes.size()), uses_(scene_ + 1), above_(scene_ + 1), below_(scene_ + 1) {
  const auto instances_in = [&](std::size_t i) -> const std::vector<Instance>& {
    return i == scene_ ? scene.instances : scene.prototypes[i].instances;
  };
  for (std::size_t i = 0; i <= scene_; ++i) {
    std::uint64_t sum = 0;
    for (const Shape& shape : i == scene_ ? scene.shapes : scene.prototypes[i].shapes)
      sum = saturating_sum(sum, triangles_of(scene.meshes.at(shape.mesh.value)));
    for (const Instance& instance : instances_in(i)) {
      const std::uint32_t inner = instance.prototype.value;
      if (inner >= i) throw Error("a prototype holds itself", location(scene, instance.origin));
      sum = saturating_sum(sum, triangles_[inner]);
      if (triangles_[inner] > 0) below_[i] = std::max(below_[i], below_[inner] + 1);
    }
    triangles_.push_back(sum);
  }
  if (triangles_[scene_] > most_triangles)
    throw Error(
        fmt::format("the scene has {}{} triangles with all instances; the most is {}",
                    triangles_[scene_] == std::numeric_limits<std::uint64_t>::max() ? "at least " : "",
                    triangles_[scene_], most_triangles));
  for (std::size_t i = scene_ + 1; i-- > 0;)
    if (i == scene_ || above_[i] > 0)
      for (const Instance& instance : instances_in(i)) {
        std::uint32_t& above = above_[instance.prototype.value];
        above = std::max(above, above_[i] + 1);
      }
  for (std::size_t i = 0; i <= scene_; ++i)
    for (const Instance& instance : instances_in(i))
      uses_[instance.prototype.value] += may_keep(i, instance.prototype.value);
}

bool PrototypeUses::is_deep(std::size_t i) const { return above_[i] + below_[i] > max_depth; }

int PrototypeUses::magnitude(std::size_t i) const {
  return (static_cast<int>(std::bit_width(triangles_[i])) - 1) / (triangles_[scene_] >> 32 == 0 ? 4 : 8);
}

bool PrototypeUses::may_keep(std::size_t outer, std::size_t inner) const {
  if (triangles_[inner] == 0) return false;
  return outer == scene_ || !is_deep(outer) || !is_deep(inner) || magnitude(inner) < magnitude(outer);
}

}  // namespace vitrail
