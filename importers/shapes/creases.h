// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/shapes/mesh.h"

namespace vitrail {

// Returns the mesh with normals that are smooth but for creases (maxSmoothAngle of Mitsuba 0.6). At each
// vertex the first triangle and all whose normals differ from that one's by less than the angle share a
// vertex, then the first of those that are left, and so on. Vertices at one place with one (u,v) count as
// one. Triangles without area follow the first.
TriangleMesh with_creases(const TriangleMesh& mesh, double most_angle_rad);

}  // namespace vitrail
