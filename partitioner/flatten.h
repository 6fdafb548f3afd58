// SPDX-License-Identifier: Apache-2.0
// Scene → one list of world triangles around the origin.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bundle/manifest.h"
#include "scene/scene.h"

namespace vitrail {

using Triangle = std::array<Point3f, 3>;

// Global triangle ids are indices into `triangles`.
struct FlatScene {
  std::vector<Triangle> triangles;  // wound so that the front is where they run counter-clockwise
  std::vector<std::array<std::uint32_t, 3>> normals;  // encode_normal; empty, or one a triangle
  std::vector<std::array<Point2f, 3>> uvs;            // empty, or one a triangle
  // [slot][triangle][vertex][channel] of the mesh attributes that textures read.
  std::vector<std::vector<std::array<std::array<float, 3>, 3>>> attributes;
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
