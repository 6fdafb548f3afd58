// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "scene/records/scene.h"

namespace vitrail {

// A ShapeKey is all of a shape but where it stands, its name and its origin.
using ShapeKey = std::array<std::uint32_t, 8>;
ShapeKey key_of(const Shape& shape);

// These shapes of the scene are the same but for where they stand: one mesh, one surface. Where copies would
// take much, one object stands for them, and its instances. It depends on the scene alone.
class SharedShapes {
 public:
  explicit SharedShapes(const Scene& scene);

  // Returns the group of the scene's shape of that index, if it is to be an instance.
  std::optional<std::uint32_t> group_of(std::size_t shape) const;

  // Returns for each group one shape that stands for all of it.
  const std::vector<const Shape*>& groups() const { return groups_; }

  // Returns whether the object's winding shows its back: mirrored instances keep the fronts of their object.
  static bool flip_in_object(const Shape& shape) {
    return shape.flip_orientation != swaps_handedness(shape.object_to_world);
  }

 private:
  std::vector<const Shape*> groups_;
  std::vector<std::uint32_t> group_of_;  // of each shape, from 1; empty where there are no groups
};

}  // namespace vitrail
