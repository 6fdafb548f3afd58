// SPDX-License-Identifier: Apache-2.0
// Random soups of triangles with all that cutting and tracing may stumble over.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>

#include "bundle/manifest.h"
#include "tests/partitioner/hierarchy/clustered_mesh.h"

namespace vitrail::test {

// SplitMix64 (Steele, Lea & Flood 2014): the same everywhere.
class SoupRandom {
 public:
  explicit SoupRandom(std::uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15u) {}
  std::uint64_t bits();
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(bits() % n); }
  double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  double uniform(double a, double b) { return a + (b - a) * unit(); }
  double log_uniform(double a, double b) { return a * std::exp2(unit() * std::log2(b / a)); }
  bool chance(double p) { return unit() < p; }
  double sign() { return chance(0.5) ? 1 : -1; }
  Vector3d vector(double size);

 private:
  std::uint64_t state_;
};

struct Soup {
  std::uint64_t seed = 0;
  Triangles triangles;  // their ids are their positions
  std::uint32_t domains = 1;
  bool any_planes = false;  // cut at planes that no cost model would choose (soup_bundle.h)
  double reach = 1;         // about half of its extent, without the largest triangles
};

// A pure function of the seed.
Soup soup_of(std::uint64_t seed);

// Half through vertices, or one rounding beside them; the others anywhere, also twice at the same place.
// Preorder, leaf i is domain i.
std::vector<KdNode> any_planes(const Soup& soup, const Bounds3f& bounds);

}  // namespace vitrail::test
