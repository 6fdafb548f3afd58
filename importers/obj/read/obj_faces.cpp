// SPDX-License-Identifier: Apache-2.0
#include "importers/obj/read/obj_faces.h"

namespace vitrail::obj {

void FaceSink::add(std::span<Corner> corners, std::size_t use, bool has_uvs, bool has_normals,
                   std::uint32_t smoothing_group) {
  const bool is_smooth = smoothing_group != 0 && !has_normals;
  if (is_smooth)
    for (Corner& corner : corners) corner.normal = smoothing_group;
  Group& group = group_of(use, has_uvs, has_normals, is_smooth);
  if (corners.size() == 3) return add_triangle(group, corners[0], corners[1], corners[2]);
  points_.clear();
  cut_.clear();
  for (const Corner& c : corners) points_.push_back(cast<double>(geometry_.positions[c.position]));
  triangulate_polygon(points_, cut_);
  for (const auto& [a, b, c] : cut_) add_triangle(group, corners[a], corners[b], corners[c]);
}

Group& FaceSink::group_of(std::size_t use, bool has_uvs, bool has_normals, bool is_smooth) {
  const std::size_t kind = (has_uvs ? 1u : 0u) + (has_normals ? 2u : is_smooth ? 4u : 0u);
  if (groups_of_use_.size() <= use) groups_of_use_.resize(use + 1);
  std::optional<std::size_t>& group = groups_of_use_[use][kind];
  if (!group) {
    group = geometry_.groups.size();
    geometry_.groups.emplace_back();
    geometry_.groups.back().object = geometry_.uses[use].object;
    geometry_.groups.back().material = geometry_.uses[use].material;
    geometry_.groups.back().has_uvs = has_uvs;
    geometry_.groups.back().has_normals = has_normals;
    geometry_.groups.back().is_smooth = is_smooth;
    geometry_.groups.back().is_aligned = !is_smooth;
  }
  return geometry_.groups[*group];
}

}  // namespace vitrail::obj
