// SPDX-License-Identifier: Apache-2.0
#include "partitioner/cutting/shared_cell.h"

#include <algorithm>
#include <array>
#include <bit>

#include "partitioner/cutting/add_node.h"

namespace vitrail {

namespace {

// Cells of so few boxes are not cut, and none is cut more often: 4096 cells at most.
constexpr std::size_t few_boxes = 2;
constexpr int most_cuts = 12;
// A cut that makes more than so many of a box is not worth it.
constexpr double most_copies = 1.6;
// Of a cell's side: a gap beside what a domain has in it that is worth a plane.
constexpr float least_gap = 0.4f;

struct Plan {
  int axis = -1;  // −1: no cut is worth it
  float split = 0;
};

class Builder {
 public:
  Builder(const Bounds3f& whole, std::uint32_t none) : whole_(whole), none_(none) {}

  std::uint32_t add(const Bounds3f& cell, std::span<const SharedBox> boxes, int levels, int cuts) {
    const std::vector<std::uint32_t> domains = domains_of(boxes);
    if (domains.empty()) return KdNode::leaf_bit | none_;
    const Plan plan = levels > levels_of(domains.size()) && cuts > 0 ? plan_for(cell, boxes) : Plan{};
    if (plan.axis < 0 || domains.size() == 1)
      return add_domains(cell, domains, boxes, levels - levels_of(domains.size()));
    std::vector<SharedBox> below, above;
    for (const SharedBox& b : boxes) {
      if (b.box.lower[plan.axis] <= plan.split) below.push_back(b);
      if (b.box.upper[plan.axis] >= plan.split) above.push_back(b);
    }
    Bounds3f low = cell, high = cell;
    low.upper[plan.axis] = high.lower[plan.axis] = plan.split;
    return add_node(
        nodes_, {plan.split, static_cast<std::uint32_t>(plan.axis)},
        [&] { return add(low, below, levels - 1, cuts - 1); },
        [&] { return add(high, above, levels - 1, cuts - 1); });
  }
  std::vector<KdNode> take() { return std::move(nodes_); }

 private:
  static int levels_of(std::size_t domains) { return static_cast<int>(std::bit_width(domains - 1)); }

  static std::vector<std::uint32_t> domains_of(std::span<const SharedBox> boxes) {
    std::vector<std::uint32_t> domains;
    for (const SharedBox& b : boxes) domains.push_back(b.domain);
    std::ranges::sort(domains);
    domains.erase(std::unique(domains.begin(), domains.end()), domains.end());
    return domains;
  }

  // Halves the boxes across the cell's longest side that does not cut too many of them.
  static Plan plan_for(const Bounds3f& cell, std::span<const SharedBox> boxes) {
    if (boxes.size() <= few_boxes) return {};
    std::array<int, 3> axes{0, 1, 2};
    std::array<float, 3> sides{};
    for (int a = 0; a < 3; ++a) {
      float lower = cell.upper[a], upper = cell.lower[a];
      for (const SharedBox& b : boxes) {
        lower = std::min(lower, std::max(b.box.lower[a], cell.lower[a]));
        upper = std::max(upper, std::min(b.box.upper[a], cell.upper[a]));
      }
      sides[static_cast<std::size_t>(a)] = upper - lower;
    }
    std::ranges::stable_sort(axes, [&](int a, int b) {
      return sides[static_cast<std::size_t>(a)] > sides[static_cast<std::size_t>(b)];
    });
    std::vector<float> centres(boxes.size());
    for (const int a : axes) {
      std::ranges::transform(boxes, centres.begin(), [&](const SharedBox& b) {
        return std::max(b.box.lower[a], cell.lower[a]) / 2 + std::min(b.box.upper[a], cell.upper[a]) / 2;
      });
      const auto middle = centres.begin() + static_cast<std::ptrdiff_t>(centres.size() / 2);
      std::ranges::nth_element(centres, middle);
      const float split = *middle;
      const auto below = static_cast<std::size_t>(
          std::ranges::count_if(boxes, [&](const SharedBox& b) { return b.box.lower[a] <= split; }));
      const auto above = static_cast<std::size_t>(
          std::ranges::count_if(boxes, [&](const SharedBox& b) { return b.box.upper[a] >= split; }));
      const auto all = static_cast<double>(boxes.size());
      if (split > cell.lower[a] && split < cell.upper[a] && std::max(below, above) < boxes.size() &&
          static_cast<double>(below + above) <= most_copies * all)
        return {a, split};
    }
    return {};
  }

  std::uint32_t add_domains(const Bounds3f& cell, std::span<const std::uint32_t> domains,
                            std::span<const SharedBox> boxes, int levels) {
    if (domains.size() == 1) {
      const Bounds3f room = room_of(cell);
      Bounds3f own;
      for (const SharedBox& b : boxes)
        if (b.domain == domains[0]) extend(own, common(b.box, room));
      return add_trimmed(room, domains[0], own, levels);
    }
    const std::size_t half = (domains.size() + 1) / 2;
    return add_node(
        nodes_, {0, KdNode::no_axis}, [&] { return add_domains(cell, domains.first(half), boxes, levels); },
        [&] { return add_domains(cell, domains.subspan(half), boxes, levels); });
  }

  // A small cell with what is beyond the whole one, where rays are that leave the scene.
  Bounds3f room_of(Bounds3f cell) const {
    for (int a = 0; a < 3; ++a) {
      const float side = whole_.upper[a] - whole_.lower[a];
      if (cell.lower[a] == whole_.lower[a]) cell.lower[a] -= side;
      if (cell.upper[a] == whole_.upper[a]) cell.upper[a] += side;
    }
    return cell;
  }

  // Planes part the cell from what the domain has in it, the widest gap first.
  std::uint32_t add_trimmed(const Bounds3f& cell, std::uint32_t domain, const Bounds3f& own, int levels) {
    int axis = -1;
    bool is_below = false;
    float widest = least_gap;
    for (int a = 0; a < 3 && levels > 0; ++a) {
      const float side = cell.upper[a] - cell.lower[a], below = own.lower[a] - cell.lower[a],
                  above = cell.upper[a] - own.upper[a];
      if (const float gap = std::max(below, above); gap > widest * side)
        widest = gap / side, axis = a, is_below = below > above;
    }
    if (axis < 0) return KdNode::leaf_bit | domain;
    Bounds3f rest = cell;
    const float split = is_below ? own.lower[axis] : own.upper[axis];
    (is_below ? rest.lower : rest.upper)[axis] = split;
    const auto nothing = [&] { return KdNode::leaf_bit | none_; };
    const auto go_on = [&] { return add_trimmed(rest, domain, own, levels - 1); };
    const KdNode node{split, static_cast<std::uint32_t>(axis)};
    return is_below ? add_node(nodes_, node, nothing, go_on) : add_node(nodes_, node, go_on, nothing);
  }

  Bounds3f whole_;
  std::uint32_t none_;
  std::vector<KdNode> nodes_;
};

}  // namespace

std::vector<KdNode> tree_of_shared(const Bounds3f& cell, std::span<const SharedBox> boxes, std::uint32_t none,
                                   int most_depth) {
  Builder builder(cell, none);
  builder.add(cell, boxes, most_depth, most_cuts);
  return builder.take();
}

}  // namespace vitrail
