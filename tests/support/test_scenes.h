// SPDX-License-Identifier: Apache-2.0
// Scenes for tests of the partitioner.
#pragma once

#include "scene/records/scene.h"

namespace vitrail::test {

// A closed manifold torus with bumps: 2n² triangles, every vertex with a normal.
TriangleMesh bumpy_torus(int n);

// Centred on the origin, with all that cutting may stumble over: small random triangles, giants, slivers,
// triangles of zero area, three grids of unit squares on integer coordinates (one for each axis: interfaces
// fall into their planes), and a second copy of everything.
TriangleMesh adversarial_soup();

// One shape with a grey diffuse material, and a camera.
Scene scene_of(TriangleMesh mesh);

}  // namespace vitrail::test
