// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "importers/obj/read/obj_parser.h"
#include "importers/shapes/polygon.h"

namespace vitrail::obj {

// It puts the triangles of faces into the groups of a Geometry.
class FaceSink {
 public:
  explicit FaceSink(Geometry& geometry) : geometry_(geometry) {}

  // Adds a face of at least three corners whose positions are there; `use` is an index of the Geometry's. Its
  // group has texture coordinates or normals if all corners have. Faces without normals get some where they
  // are in a smoothing group, which is not 0.
  void add(std::span<Corner> corners, std::size_t use, bool has_uvs, bool has_normals,
           std::uint32_t smoothing_group);

 private:
  Group& group_of(std::size_t use, bool has_uvs, bool has_normals, bool is_smooth);

  Geometry& geometry_;
  std::vector<std::array<std::optional<std::size_t>, 6>> groups_of_use_;
  std::vector<Point3d> points_;
  std::vector<CornerTriple> cut_;
};

}  // namespace vitrail::obj
