// SPDX-License-Identifier: Apache-2.0
// A vertex of a TriangleMesh is a position with its normal, uv and attributes; where those differ (a seam),
// several vertices lie at one point.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/shapes/mesh.h"

namespace vitrail {

using Triangle = std::array<std::uint32_t, 3>;

// Returns for each vertex the first one at its position; 0 and −0 are equal.
std::vector<std::uint32_t> first_at_position(const TriangleMesh& mesh);

// Returns for each vertex the first one that is the same in everything, bit for bit up to
// the sign of zeros of the position.
std::vector<std::uint32_t> first_equal(const TriangleMesh& mesh);

// Returns for each triangle the first one with the same attributes a face; empty where there are none.
std::vector<std::uint32_t> first_equal_face(const TriangleMesh& mesh);

// Adds a vertex at the end that is the same as `vertex` in everything, and returns its number.
std::uint32_t append_copy(TriangleMesh& mesh, std::uint32_t vertex);

// Returns a mesh of new triangles over its vertices, each with the triangle whose attributes it takes.
// Vertices that none uses are left out; the others keep their order.
TriangleMesh with_triangles(const TriangleMesh& mesh, const std::vector<Triangle>& triangles,
                            const std::vector<std::uint32_t>& sources);

Vector3d scaled_normal(const TriangleMesh& mesh, const Triangle& triangle);  // length: twice the area

}  // namespace vitrail
