// SPDX-License-Identifier: Apache-2.0
// Choosing one of many lights by how much it can send to a point: Conty Estevez & Kulla, "Importance Sampling
// of Many Lights with Adaptive Tree Splitting" (2018), without the splitting, with eight children a node.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "scene/bounds.h"

namespace vitrail {

// Where light may leave from and to: its normals lie within θ_o of `axis`, it emits within θ_e of a normal.
struct LightBounds {
  Bounds3d box;
  Vector3d axis{0, 0, 1};
  double theta_o_rad = 0, theta_e_rad = 0;
  double power = 0;        // any unit, the same for all
  bool two_sided = false;  // its normals count in both directions
};

enum class LightChoice : std::uint8_t { tree, power };

// What each child of a node can send to a point, in four cache lines. Coordinates are the tree's: the box of
// all lights has its centre at 0 and its greatest half edge is 1. A child without power does not exist.
struct alignas(64) LightNode {
  static constexpr int width = 8;
  static constexpr float unit = 32767;  // of the integers
  using Lanes = std::array<float, width>;
  using Integers = std::array<std::int16_t, width>;
  Lanes center_x{}, center_y{}, center_z{};
  Lanes radius2{};                          // of a sphere around the child; < 0: two-sided
  Lanes power{};                            // < 0: nothing leaves beyond θ_o, else θ_e = 90°
  std::array<std::int32_t, width> child{};  // a node, or ~light
  Integers axis_x{}, axis_y{}, axis_z{};    // in units of 1/unit
  Integers cos_o{};
};
static_assert(sizeof(LightNode) == 256);

class LightTree {
 public:
  LightTree() = default;
  // Lights without power are never chosen.
  LightTree(std::span<const LightBounds> lights, LightChoice choice);

  struct Chosen {
    std::uint32_t light = 0;
    double probability = 0;
  };
  // u in [0,1). Empty where no light reaches p, as far as the bounds can tell.
  std::optional<Chosen> choose(Point3d p, double u) const;
  // The probability with which `choose` would give that light.
  double probability(Point3d p, std::uint32_t light) const;

  bool empty() const { return nodes_.empty(); }
  double power() const { return power_; }  // of all lights
  std::size_t nodes() const { return nodes_.size(); }

 private:
  friend class LightTreeBuilder;
  Point3f local(Point3d p) const;

  std::vector<LightNode> nodes_;  // 0 is the root
  // Of each light: the lanes from the root, three bits each, lowest first, and a 1 above them; 0: it is not
  // in the tree.
  std::vector<std::uint64_t> trail_;
  Point3d center_;
  double scale_ = 1;
  double power_ = 0;
  LightChoice choice_ = LightChoice::tree;
};

}  // namespace vitrail
