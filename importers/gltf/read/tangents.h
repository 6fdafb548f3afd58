// SPDX-License-Identifier: Apache-2.0
// Which way the axes of normal maps run on a mesh. glTF's third axis is B = (N × T)·w of its TANGENT (T, w),
// and without one that along which v falls. A Scene's maps have N × ∂p/∂u there.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/shapes/mesh.h"

namespace vitrail::gltf {

struct SidesOfUv {
  std::vector<std::uint32_t> straight, mirrored;  // triangles by whether B is N × ∂p/∂u, or against it
};

// `tangents`: four numbers a vertex, or none. v runs down the image, as in glTF.
SidesOfUv sides_of_uv(const TriangleMesh& mesh, const std::vector<float>& tangents);

// Returns the mean angle, by area, between the tangents and the direction of u.
double turn_of_tangents_deg(const TriangleMesh& mesh, const std::vector<float>& tangents);

}  // namespace vitrail::gltf
