// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "scene/records/scene.h"
#include "scene/shapes/quadric_places.h"

namespace vitrail {

// It adds shapes to a scene as an importer finds them. Many in a row of one quadric that differ in where they
// stand alone become one shape of many places, and so do curves. Lights, names and what mirrors stay shapes
// of their own.
class QuadricRuns {
 public:
  explicit QuadricRuns(std::uint64_t memory_bytes) : memory_bytes_(memory_bytes) {}

  void add(Scene& scene, Shape shape);
  // Adds the curve whose mesh was added last to `shapes`, which may be an object's.
  void add_curve(Scene& scene, std::vector<Shape>& shapes, Shape shape);

 private:
  bool continues(const Scene& scene, const Shape& shape) const;
  void gather(Scene& scene);

  std::uint64_t memory_bytes_;         // of places, of each run
  std::size_t first_ = 0, count_ = 0;  // of the run among the scene's shapes
  Id<TriangleMesh> quadric_;
  std::shared_ptr<QuadricPlaces> places_;  // where they have become one shape
  std::shared_ptr<QuadricPlaces> curves_;
};

}  // namespace vitrail
