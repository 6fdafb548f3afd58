// SPDX-License-Identifier: Apache-2.0
// A scene is placed as objects: what each is made of, and where they stand (plan_scene.h makes it).
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "partitioner/placing/placement.h"
#include "scene/shapes/quadric_places.h"

namespace vitrail {

struct ObjectUse {
  std::uint32_t object = 0;  // index
  Affine to_parent{};        // from the object's coordinates to the parent's
  std::uint64_t first_triangle = 0;
};

// They are uses of one quadric that differ in where they stand alone, too many to be held
// one by one. Ids run in their order.
struct QuadricRun {
  const Quadric* quadric = nullptr;
  std::uint32_t object = 0;  // index
  const QuadricPlaces* places = nullptr;
  Affine to_parent{};  // from the places' space
  std::uint64_t first_triangle = 0;

  ObjectUse use(std::size_t i, const Transform& place) const {
    return {object, compose(to_parent, *quadric, affine(place)), first_triangle + i};
  }
};
// Calls visit(use) for each of the run, in order.
void for_each_use(const QuadricRun& run, const std::function<void(const ObjectUse&)>& visit);

// An Assembly is the scene, or an object. Its coordinates are taken from `centre`.
struct Assembly {
  // A quadric has this alone, in its own space, and `flip` says that it is inside out.
  std::optional<Placement> quadric;
  std::vector<Placement> placements;  // of its own
  std::vector<ObjectUse> uses;
  std::vector<QuadricRun> runs;  // of the scene alone
  std::uint64_t triangles = 0;   // ids: of its own and of its uses, in their order
  Vector3d centre;
  double radius = 0;  // about it, on the greatest axis, half of the triangles lie
  Bounds3f bounds;    // of all, wherever it moves
  int depth = 0;      // most uses within each other
  // It is set if the object moves. There is one use then, and coordinates are where it takes that, uncentred.
  const Motion* motion = nullptr;
};

struct ScenePlan {
  // They are meshes of quadrics that stand where no ray can be taken to their space.
  std::vector<std::unique_ptr<const TriangleMesh>> tessellated;
  std::vector<Assembly> objects;  // with uses of earlier ones only
  Assembly scene;
  std::optional<Bounds3f> core;  // of the scene, about its centre, without few parts that lie far away
  std::uint64_t coarse =
      0;  // shapes and instances that rounding moves by more than a thousandth of their size
};

// Returns the placements of every use of the scene that does not move, as `select` chooses them, in the order
// of ids. It is asked once for each placement of an object, however often that is used.
std::vector<Placement> expanded(const ScenePlan& plan, const std::function<bool(const Placement&)>& select);

// Makes the plan one without instances: copies of meshes, and a use of the scene for each quadric and all
// that moves. Throws Error for more triangles than there are numbers (bundle/triangle_number.h).
void flatten(ScenePlan& plan);

}  // namespace vitrail
