// SPDX-License-Identifier: Apache-2.0
// A LightTree chooses one of many lights by how much it can send to a point. It follows Conty Estevez &
// Kulla, "Importance Sampling of Many Lights with Adaptive Tree Splitting" (2018), without the splitting,
// with eight children a node.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "scene/geometry/bounds.h"

namespace vitrail {

// It bounds where light may leave from and to. Its normals lie within θ_o of `axis`, and it emits within θ_e
// of a normal.
struct LightBounds {
  Bounds3d box;
  Vector3d axis{0, 0, 1};
  double theta_o_rad = 0, theta_e_rad = 0;
  double power = 0;        // any unit, the same for all
  bool two_sided = false;  // its normals count in both directions
  double near = 0;         // up to this distance it does not weaken
};

enum class LightChoice : std::uint8_t { tree, power };

// It holds what each child of a node can send to a point, in four cache lines. Coordinates are the tree's:
// the box of all lights has its centre at 0 and its greatest half edge is 1. Lights are in the tree's order:
// those of a child are in the slots [first[i], first[i + 1]). A child without lights has no power.
struct alignas(64) LightNode {
  static constexpr int width = 8;
  static constexpr float unit = 32767;       // of the integers
  static constexpr std::uint8_t alike = 64;  // of `below`: see LightTree
  // A lesser squared distance to the centre of a light counts as this.
  static constexpr float least_distance2 = 1e-12f;
  // Lights are alike where cos θ exceeds this many times sin θ_o + sin θ_u: their 1/d² then differs by less
  // than a factor of 1.7 from the middle, the cosine by 25 %.
  static constexpr float alike_ratio = 4;
  using Lanes = std::array<float, width>;
  using Pairs = std::array<std::uint32_t, width>;
  Lanes center_x{}, center_y{}, center_z{};
  // There are two a lane, the first in the lower bits. Some are the upper bits of floats: radius² of a sphere
  // around the child, < 0: two-sided; power, < 0: nothing leaves beyond θ_o, else θ_e = 90°. The others are
  // integers in units of 1/unit: the axis, and cos θ_o.
  Pairs radius2_power{}, axis_xy{}, axis_z_cos_o{};
  std::array<std::uint32_t, width + 1> first{};
  std::uint32_t children = 0;  // the first node of the children of several lights, which are together
  std::array<std::uint8_t, width> below{};  // of such a child: its node after `children`
  // They are upper bits of floats: the square of the distance up to which the child does not weaken.
  using Halves = std::array<std::uint16_t, width>;
  Halves near2{};
};
static_assert(sizeof(LightNode) == 256);

// It holds what the children of a node can send to one point.
struct LightWeights {
  alignas(64) float child[LightNode::width];
  float alike[LightNode::width];   // > 0: the lights of the child are alike
  double up_to[LightNode::width];  // of a child and those before it
};
// p is in the tree's coordinates.
void weigh(const LightNode& node, Point3f p, LightWeights& result);

// The tree chooses from the root down by what each child can send to a point, until a child's lights are
// alike for it. Alike lights are far away for their extent and turned to it, and none has less than 1e-12 of
// all power. One of these is chosen by power, by sums over the tree's order.
class LightTree {
 public:
  LightTree() = default;
  // Lights without power are never chosen. bounds(i) is that of light i; the constructor calls it several
  // times.
  LightTree(std::span<const LightBounds> lights, LightChoice choice);
  using BoundsOf = std::function<LightBounds(std::uint32_t)>;
  LightTree(std::size_t lights, const BoundsOf& bounds, LightChoice choice);

  struct Chosen {
    std::uint32_t slot = 0;
    double probability = 0;
    double rest = 0;  // of u: uniform in [0,1) again
  };
  // Chooses a light; u is in [0,1). Returns nothing where no light reaches p, as far as the bounds can tell.
  std::optional<Chosen> choose(Point3d p, double u) const;
  class Point;  // chooses several times
  // Returns the probability with which `choose` would give that light.
  double probability(Point3d p, std::uint32_t light) const;

  // Returns the light of each slot.
  std::span<const std::uint32_t> order() const { return order_; }
  bool empty() const { return nodes_.empty(); }
  double power() const { return power_; }  // of all lights
  std::size_t nodes() const { return nodes_.size(); }

  // They are the parts of `choose`, for tracer/lanes. Coordinates in it are (p − center)·scale, clamped to
  // ±farthest.
  static constexpr double farthest = 1e15;
  struct Slots {
    std::uint32_t begin = 0, end = 0;
  };
  Slots all() const { return {0, static_cast<std::uint32_t>(order_.size())}; }
  LightChoice choice() const { return choice_; }
  std::span<const LightNode> node_list() const { return nodes_; }  // 0 is the root
  Point3d center() const { return center_; }
  double scale() const { return scale_; }
  std::optional<Chosen> choose_by_power(Slots slots, double u) const;
  // Returns for each slot the power of those before it, of 1, and then the power of all.
  std::span<const double> sums() const { return sums_; }
  // Returns the last of the slots that has no more than `target` before it. u in [0,1) says where to look
  // first.
  std::uint32_t slot_by_power(Slots slots, double u, double target) const;

 private:
  friend class LightTreeBuilder;
  static constexpr std::uint32_t absent = ~0u;
  Point3f local(Point3d p) const;
  // weights_of(number of a node) → const LightWeights& holds at most until the next call.
  template <class WeightsOf>
  std::optional<Chosen> choose_from_root(double u, const WeightsOf& weights_of) const;
  double share_of_power(Slots slots, std::uint32_t slot) const;

  std::vector<LightNode> nodes_;  // 0 is the root
  std::vector<double> sums_;      // as sums()
  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> slot_;  // of each light, or `absent`
  Point3d center_;
  double scale_ = 1;
  double power_ = 0;
  LightChoice choice_ = LightChoice::tree;
};

// It is a point that several lights are chosen for. It keeps the weights of nodes, since later choices mostly
// go by the same nodes. The tree has to outlive it.
class LightTree::Point {
 public:
  Point(const LightTree& tree, Point3d p) : tree_(tree), p_(p) { kept_.fill(absent); }
  // Chooses as LightTree::choose, to the last bit.
  std::optional<Chosen> choose(double u);

 private:
  static constexpr std::size_t places = 8;  // of nodes, by the last digits of their numbers
  const LightTree& tree_;
  Point3d p_;
  Point3f local_;                             // of the tree, once the root is kept
  std::array<std::uint32_t, places> kept_;    // the node in a place, or `absent`
  std::array<LightWeights, places> weights_;  // of those
};

}  // namespace vitrail
