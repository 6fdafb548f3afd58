// SPDX-License-Identifier: Apache-2.0
// A Motion moves objects while the shutter is open. A transform is taken apart, M = T·R·S (Shoemake & Duff,
// "Matrix animation and polar decomposition", 1992). Between two keyframes T and S go in straight lines and R
// along the shortest great arc, as in pbrt and Mitsuba 0.6.
#pragma once

#include <array>
#include <vector>

#include "scene/geometry/bounds.h"
#include "scene/geometry/transform.h"

namespace vitrail {

// Its times are the file's; each sample of a pixel has a time in [open_s, close_s), uniformly distributed.
struct Shutter {
  double open_s = 0, close_s = 1;
  bool operator==(const Shutter&) const = default;
};

struct Keyframe {
  double time_s = 0;
  Transform transform;
  bool operator==(const Keyframe&) const = default;
};

// Returns whether the keyframes make a Motion. Their times ascend, and their transforms are affine and have
// inverses. Their condition, over all of them, is at most 10⁴, so that rays can be taken to what moves. All
// of them mirror or none does: between those that differ there would be no extent.
bool can_move(const std::vector<Keyframe>& keys);

// It stands still before its first keyframe and after its last. Without keyframes there is no motion.
class Motion {
 public:
  Motion() = default;
  // Throws Error where the keyframes cannot move.
  explicit Motion(std::vector<Keyframe> keys);

  bool moves() const { return !keys_.empty(); }
  const std::vector<Keyframe>& keys() const { return keys_; }
  std::size_t bytes() const { return keys_.size() * (sizeof(Keyframe) + sizeof(Parts) + sizeof(double)); }
  // Returns the transform at a time, with the same bits on every machine. There is a keyframe.
  Transform at(double time_s) const;
  // Returns a box that holds, at any time, all that lies in `box`.
  Bounds3d swept(const Bounds3d& box) const;

  bool operator==(const Motion& other) const { return keys_ == other.keys_; }

 private:
  struct Parts {
    Vector3d translation;
    std::array<double, 4> rotation{};  // a unit quaternion x, y, z, w
    std::array<std::array<double, 3>, 3> stretch{};
  };
  static Parts parts_of(const Transform& t);
  Transform between(std::size_t key, double t) const;

  std::vector<Keyframe> keys_;
  std::vector<Parts> parts_;
  std::vector<double> half_angles_rad_;  // from each rotation to the next, at most π/2
};

// Returns all of the motion, moved by `outer` as a whole.
Motion operator*(const Transform& outer, const Motion& motion);

// Returns whether nothing moves while the shutter is open.
bool stands_still(const Motion& motion, const Shutter& shutter);

}  // namespace vitrail
