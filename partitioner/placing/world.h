// SPDX-License-Identifier: Apache-2.0
// A World is a scene, ready to be placed.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "bundle/manifest.h"
#include "partitioner/placing/objects.h"
#include "scene/records/scene.h"

namespace vitrail {

struct WorldOptions {
  bool keep_instances = false;  // else they are copied
  bool everything = false;      // as if the scene required all that there is, for measuring
  std::filesystem::path cache;  // of baked images; empty: none
};

struct WorldObject {
  Assembly assembly;
  std::uint32_t first_surface = 0, surface_count = 0;
};

struct ShiningPlacement {
  Placement placement;
  std::uint32_t area_light = 0;   // index
  FloatParameter opacity = 1.0f;  // of its surface
};

struct World {
  // It has all but what is known when triangles have been placed (SceneTally), the kd-tree and its domains.
  Manifest manifest;
  std::vector<Placement> placements;  // by id, of the triangles that no instance has
  std::uint64_t own_triangles = 0;    // of them
  std::vector<std::unique_ptr<const TriangleMesh>> tessellated;  // that placements are of
  // They are what is kept of instances, and all quadrics: the objects, where the scene has
  // them, and what of it shines there.
  std::vector<WorldObject> objects;
  std::vector<ObjectUse> uses;
  std::vector<QuadricRun> runs;
  std::uint64_t quadrics = 0;  // in uses and runs
  std::vector<ShiningPlacement> shining;
  Bounds3f instance_bounds;  // of all instances, kept or copied
  std::uint64_t coarse = 0;  // as in ScenePlan
  std::vector<TextureBaker::Attribute> attributes;
  std::vector<std::int32_t> material_ids;  // of the manifest, by that of the scene; −1: not used
  std::vector<std::string> shape_names;    // of the manifest's surfaces, where the film tells shapes apart

  PlacementRule rule() const {
    return {manifest.offset, manifest.requirements.shading_normals, manifest.requirements.uv, attributes};
  }
};

// Composes all transforms in double. `offset`, to be taken from the world's coordinates, is where frame.h
// finds the origin, a point of floats. Ids run in scene order: the shapes that are no instances of an
// object, the others, then each instance's shapes. Materials and area lights that no triangle uses are left
// out. Throws Error for shapes that floats cannot hold, and for more triangles that are no instances' than
// there are numbers (bundle/triangle_number.h). Images are baked into the directory `bundle`, unless it is
// empty. The scene outlives the world.
World world_of(const Scene& scene, const std::filesystem::path& bundle, const WorldOptions& options = {});

}  // namespace vitrail
