// SPDX-License-Identifier: Apache-2.0
#include "scene/records/curve_uses.h"

#include <algorithm>
#include <cmath>

namespace vitrail {

bool is_of_curves(const Scene& scene, const Shape& shape) {
  const std::optional<Quadric>& quadric = scene.meshes.at(shape.mesh.value).quadric;
  return quadric && is_curve(*quadric);
}

InnerWall inner_wall(const MaterialTraits& material) {
  if (material.fibre) return InnerWall::nothing_by_itself;
  return material.transmits ? InnerWall::as_the_outer : InnerWall::nothing;
}

float opacity_of_wall(float opacity_of_curve) {
  return static_cast<float>(1 - std::sqrt(1 - std::clamp(double{opacity_of_curve}, 0.0, 1.0)));
}

// Those that a prototype uses stand before it.
std::vector<bool> prototypes_with_curves(const Scene& scene) {
  std::vector<bool> with(scene.prototypes.size());
  for (std::size_t i = 0; i < with.size(); ++i) {
    const Prototype& p = scene.prototypes[i];
    with[i] = std::ranges::any_of(p.shapes, [&](const Shape& s) { return is_of_curves(scene, s); }) ||
              std::ranges::any_of(p.instances, [&](const Instance& n) { return with[n.prototype.value]; });
  }
  return with;
}

}  // namespace vitrail
