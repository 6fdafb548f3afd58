// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "importers/obj/read/obj_parser.h"
#include "importers/shapes/polygon.h"

namespace vitrail::obj {

// Puts the triangles of faces into the groups of a Geometry.
class FaceSink {
 public:
  explicit FaceSink(Geometry& geometry) : geometry_(geometry) {}

  // At least three corners whose positions are there. The group has texture coordinates or normals if all
  // corners have.
  void add(std::span<const Corner> corners, std::size_t material, bool has_uvs, bool has_normals);

 private:
  Group& group_of(std::size_t material, bool has_uvs, bool has_normals);

  Geometry& geometry_;
  std::vector<std::array<std::optional<std::size_t>, 4>> groups_of_material_;
  std::vector<Point3d> points_;
  std::vector<CornerTriple> cut_;
};

}  // namespace vitrail::obj
