// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "scene/records/scene.h"

namespace vitrail {

// PrototypeUses tell what the prototypes of a scene hold and where they are used. Each is looked at once,
// however many instances of instances there are. The scene counts as one more prototype, the last.
class PrototypeUses {
 public:
  // Throws Error where a prototype holds itself, and for more than 2⁶² triangles with all instances.
  explicit PrototypeUses(const Scene& scene);

  // Returns the triangles with all that is in it.
  std::uint64_t triangles(std::size_t prototype) const { return triangles_[prototype]; }
  // Returns the uses by instances that may be kept.
  std::uint64_t uses(std::size_t prototype) const { return uses_[prototype]; }

  // Returns whether an instance of `inner` in `outer` may be kept. On chains of more instances than a ray can
  // follow (of prototypes one less than max_instance_depth) it may where `inner` is of a lower magnitude in
  // triangles. That leaves chains short enough, and copies at most 16 times what an object holds; 256 times
  // in scenes of 2³² triangles or more.
  bool may_keep(std::size_t outer, std::size_t inner) const;

 private:
  bool is_deep(std::size_t prototype) const;
  // Returns 0 for 2⁰ to 2⁴ triangles, 1 for 2⁴ to 2⁸ …; in scenes of 2³² or more 0 for 2⁰ to 2⁸ …
  int magnitude(std::size_t prototype) const;

  std::size_t scene_;  // index
  std::vector<std::uint64_t> triangles_, uses_;
  std::vector<std::uint32_t> above_, below_;  // of the longest chain from the scene, and to what holds none
};

}  // namespace vitrail
