// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "importers/obj/read/obj_parser.h"

namespace vitrail::obj {

// Returns a mesh for each group, which has the vertices that its faces use: in the order of the file where
// the corners' indices agree with each other, else in the order in which the faces use them. Where the file
// has colours, meshes have them as the attribute `vertex_color`.
inline constexpr std::string_view vertex_color = "vertex_color";
std::vector<TriangleMesh> to_meshes(Geometry&& geometry);

}  // namespace vitrail::obj
