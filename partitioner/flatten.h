// SPDX-License-Identifier: Apache-2.0
// Scene → one list of world triangles around the origin.
#pragma once

#include <filesystem>

#include "bundle/manifest.h"
#include "partitioner/placement.h"
#include "scene/scene.h"

namespace vitrail {

// Global triangle ids are indices into `triangles`.
struct FlatScene : PlacedTriangles {
  Manifest manifest;  // all but the kd-tree, the domains and cut_triangles
};

// Composes all transforms in double, shifts the world to the centre of its bounds (a point of floats:
// `offset`) and rounds once. Ids run in scene order: the shapes, then each instance's shapes. Materials and
// area lights that no triangle uses are left out. Shading normals are turned to their triangle's front; a
// triangle with one that is zero has none. Throws Error for vertices that are not finite in the world, and
// for 2³² − 1 triangles or more.
// Images are baked into the directory `bundle`, unless it is empty. `everything`: as if the scene required
// all that there is, for measuring.
FlatScene flatten(const Scene& scene, const std::filesystem::path& bundle, bool everything = false);

}  // namespace vitrail
