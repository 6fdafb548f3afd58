// SPDX-License-Identifier: Apache-2.0
// glTF's TANGENT (T, w) says how the axes of normal maps run: T, and B = (N × T)·w. A Scene's maps have ∂p/∂u
// and N × ∂p/∂u there.
#pragma once

#include <vector>

#include "scene/models/turned_normal_maps.h"

namespace vitrail::gltf {

// Returns the triangles in parts by the axes that are against those of a Scene's maps. `tangents` has four
// numbers a vertex.
std::vector<UvPart> parts_by_tangents(const TriangleMesh& mesh, const std::vector<float>& tangents);

// Returns the mean angle, by area, between the line of the tangents and that of u: at most 90.
double turn_of_tangents_deg(const TriangleMesh& mesh, const std::vector<float>& tangents);

}  // namespace vitrail::gltf
