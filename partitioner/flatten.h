// SPDX-License-Identifier: Apache-2.0
// Scene → one list of world triangles around the origin.
#pragma once

#include <filesystem>

#include "bundle/manifest.h"
#include "partitioner/objects.h"
#include "partitioner/placement.h"
#include "scene/scene.h"

namespace vitrail {

// Placed triangles with their ids, ascending. In what speaks of them a triangle is an index into these.
struct NumberedTriangles : PlacedTriangles {
  std::vector<std::uint32_t> ids;
};

// An object's own triangles.
struct FlatObject : NumberedTriangles {
  std::uint32_t first_surface = 0, surface_count = 0;
};

// The triangles that no instance has.
struct FlatScene : NumberedTriangles {
  ScenePlan plan;
  std::vector<FlatObject> objects;  // of the plan
  Manifest manifest;                // all but the kd-tree, the domains, the objects and cut_triangles
};

struct FlattenOptions {
  bool keep_instances = false;  // else they are copied
  bool everything = false;      // as if the scene required all that there is, for measuring
};

// Composes all transforms in double, shifts the world to the centre of its bounds (a point of floats:
// `offset`) and rounds once. Ids run in scene order: the shapes, then each instance's shapes. Materials and
// area lights that no triangle uses are left out. Shading normals are turned to their triangle's front; a
// triangle with one that is zero has none. Throws Error for vertices that are not finite in the world, and
// for 2³² − 1 triangles or more.
// Images are baked into the directory `bundle`, unless it is empty.
FlatScene flatten(const Scene& scene, const std::filesystem::path& bundle,
                  const FlattenOptions& options = {});

}  // namespace vitrail
