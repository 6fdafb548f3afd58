// SPDX-License-Identifier: Apache-2.0
// A DomainWalk is the order in which a ray meets the sub-domains: front to back through the kd-tree. Both
// sides of an interface are met where the ray is within ε of it. Each of the domains that share a cell is met
// once, where it first may have something.
#pragma once

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "bundle/manifest.h"
#include "tracer/rays/cell_ways.h"
#include "tracer/rays/ray.h"

namespace vitrail {

// It visits the leaves of one ray, one after the other. The sequence is a function of the ray and the
// manifest alone. A rank that receives a ray finds its place in it again with `skip_past`.
class DomainWalk {
 public:
  struct Visit {
    std::uint32_t domain;
    double entry;  // no point of the ray before it lies in the domain
  };

  // `resident` is indexed by domain, null where absent; it may be empty. The one domain of a scene is at once
  // the first and the last, if it is at hand: its tree tells what misses it.
  DomainWalk(const Manifest& manifest, const Ray& ray, std::span<const DomainView* const> resident = {})
      : manifest_(manifest), resident_(resident) {
    if (!starts_near(ray.origin)) return;
    only_one_ = has_one(manifest, resident);
    if (!only_one_) begin(ray);
  }

  // Returns whether the one domain of a scene is at hand, so that the walk of a ray that `starts_near` visits
  // it alone.
  static bool has_one(const Manifest& manifest, std::span<const DomainView* const> resident) {
    return resident.size() == 1 && resident[0] && !manifest.domains[0].tight_bounds.empty();
  }
  // Returns whether a ray starts within 10¹⁸ of the scene's centre on each axis; no scene reaches 10¹⁵ from
  // it. The square of such a distance and its product with 10¹⁸ (ray.h) are still floats. A ray that starts
  // beyond meets nothing. It is false for NaN.
  static bool starts_near(Point3f origin) {
    constexpr double farthest = 1e18;
    const Point3d o = cast<double>(origin);
    return std::abs(o.x) <= farthest && std::abs(o.y) <= farthest && std::abs(o.z) <= farthest;
  }

  // Returns whether the ray is in the sample by which crossings are counted: one ray in `sampled_one_in`. It
  // is a function of the ray.
  static constexpr std::uint64_t sampled_one_in = 64;
  static bool is_sampled(const Ray& ray);

  // Finds the next domain whose tight bounds and marked cells the ray enters before tmax; false at the end.
  bool next(double tmax, Visit& visit) {
    if (!only_one_) return next_of_many(tmax, visit);
    only_one_ = false;
    visit = {0, 0};
    return true;
  }
  // Goes on behind `domain`, which the walk visits, where it has visited none yet. It goes down the tree to
  // the domain's cell, without the leaves before it.
  void skip_past(std::uint32_t domain, const CellWays& ways);

 private:
  struct Pending {
    std::uint32_t reference;
    bool shared;  // below a node without an axis
    double t0, t1;
  };
  // They are the two children of a plane, in the order in which the ray comes to them.
  struct Sides {
    std::uint32_t near, far;
    double near_end, far_begin;
    bool in_near, in_far;
  };
  void begin(const Ray& ray);
  Sides sides_of(const KdNode& node, const Pending& at) const;
  bool descend(std::uint32_t domain, const CellWays& ways, Pending& at);
  void skip_leaves(std::uint32_t domain);
  bool next_of_many(double tmax, Visit& visit);
  bool next_leaf(double tmax, Pending& leaf);
  void enter_shared(const KdNode& node);
  bool is_first(std::uint32_t reference);

  const Manifest& manifest_;
  std::span<const DomainView* const> resident_;
  bool only_one_ = false;  // the scene has one domain, resident, and it is still to come
  std::array<double, 3> origin_, direction_, reciprocal_;  // by axis: nodes are cut along any
  double rounding_;                                        // of points on the ray
  double epsilon_;
  std::array<Pending, 64> stack_;
  int size_ = 0;
  // It is the shared cell that the walk is in.
  struct {
    std::uint32_t first, left;  // its first domain, and how many of them are still to be met
    int below;                  // of the stack, when the walk entered it
    std::uint64_t met;          // a bit each of the first 64
    std::vector<bool> more;     // of the others
  } shared_;
};

}  // namespace vitrail
