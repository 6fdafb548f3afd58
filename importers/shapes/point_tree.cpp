// SPDX-License-Identifier: Apache-2.0
#include "importers/shapes/point_tree.h"

#include <algorithm>
#include <limits>

namespace vitrail {

namespace {

constexpr std::uint32_t most_in_leaf = 4;
constexpr std::uint32_t removed = std::numeric_limits<std::uint32_t>::max();

bool is_within(Point2d q, Point2d a, Point2d b, Point2d c) {
  return orientation(a, b, q) >= 0 && orientation(b, c, q) >= 0 && orientation(c, a, q) >= 0;
}

// True if all of the box is strictly to the right of a → b. The corner that is farthest to the left decides,
// and rounding is monotonic: no point of the box is within by `orientation` then.
bool is_right_of(Point2d lower, Point2d upper, Point2d a, Point2d b) {
  const Point2d farthest{b.y - a.y >= 0 ? lower.x : upper.x, b.x - a.x >= 0 ? upper.y : lower.y};
  return orientation(a, b, farthest) < 0;
}

}  // namespace

PointTree::PointTree(std::span<const Point2d> points, std::vector<std::uint32_t> indices)
    : points_(points), indices_(std::move(indices)), leaf_(points.size(), removed) {
  if (indices_.empty()) return;
  nodes_.push_back({{}, {}, 0, static_cast<std::uint32_t>(indices_.size()), 0, 0, 0});
  for (std::uint32_t node = 0; node < nodes_.size(); ++node) split(node);
}

void PointTree::split(std::uint32_t index) {
  Node node = nodes_[index];
  const auto range = std::span(indices_).subspan(node.begin, node.end - node.begin);
  node.lower = node.upper = points_[range[0]];
  for (const std::uint32_t i : range) {
    const Point2d p = points_[i];
    node.lower = {std::min(node.lower.x, p.x), std::min(node.lower.y, p.y)};
    node.upper = {std::max(node.upper.x, p.x), std::max(node.upper.y, p.y)};
  }
  node.alive = node.end - node.begin;
  if (node.alive <= most_in_leaf) {
    for (const std::uint32_t i : range) leaf_[i] = index;
  } else {
    const auto axis = node.upper.x - node.lower.x >= node.upper.y - node.lower.y ? &Point2d::x : &Point2d::y;
    const std::uint32_t middle = node.alive / 2;
    std::ranges::nth_element(range, range.begin() + middle, {},
                             [&](std::uint32_t i) { return points_[i].*axis; });
    node.left = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({{}, {}, node.begin, node.begin + middle, index, 0, 0});
    nodes_.push_back({{}, {}, node.begin + middle, node.end, index, 0, 0});
  }
  nodes_[index] = node;
}

void PointTree::remove(std::uint32_t index) {
  std::uint32_t node = leaf_[index];
  leaf_[index] = removed;
  for (; --nodes_[node].alive, node != 0; node = nodes_[node].parent) {
  }
}

std::optional<std::uint32_t> PointTree::find_within(Point2d a, Point2d b, Point2d c) const {
  if (nodes_.empty()) return {};
  const auto [left, right] = std::minmax({a.x, b.x, c.x});
  const auto [bottom, top] = std::minmax({a.y, b.y, c.y});
  std::uint32_t stack[64];  // a node and its sibling a level, of at most 31
  std::size_t size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const Node& node = nodes_[stack[--size]];
    if (node.alive == 0 || node.lower.x > right || node.upper.x < left || node.lower.y > top ||
        node.upper.y < bottom || is_right_of(node.lower, node.upper, a, b) ||
        is_right_of(node.lower, node.upper, b, c) || is_right_of(node.lower, node.upper, c, a)) {
      continue;
    }
    if (node.left != 0) {
      stack[size++] = node.left;
      stack[size++] = node.left + 1;
      continue;
    }
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
      const Point2d q = points_[indices_[i]];
      if (leaf_[indices_[i]] != removed && q != a && q != b && q != c && is_within(q, a, b, c))
        return indices_[i];
    }
  }
  return {};
}

}  // namespace vitrail
