// SPDX-License-Identifier: Apache-2.0
// A scene and rays with all that intersection and decomposition may stumble over.
#pragma once

#include <span>

#include "bundle/manifest.h"
#include "scene/records/scene.h"
#include "tests/partitioner/hierarchy/clustered_mesh.h"
#include "tracer/rays/ray.h"

namespace vitrail::test {

// About 100 000 triangles: eight closed bumpy spheres, one an octant; giant and sliver triangles; a finely
// divided square in each coordinate plane, twice, so that equally balanced cuts fall into them. `size` is
// half the extent.
TriangleMesh awkward_mesh(float size, Vector3f offset);

// Half are random; a tenth each start in or near an interface and run along it, go through vertices, through
// edges, through points where an edge is cut by an interface, and along axes.
std::vector<Ray> awkward_rays(const Triangles& triangles, std::span<const KdNode> interfaces,
                              std::size_t count);

}  // namespace vitrail::test
