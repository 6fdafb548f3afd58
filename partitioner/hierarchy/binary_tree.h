// SPDX-License-Identifier: Apache-2.0
// A BinaryTree is a binary tree over boxes, of little surface area.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "partitioner/hierarchy/sah_split.h"

namespace vitrail {

// A node is trivial, so that an array of them is only touched where it is used.
struct BinaryNode {
  Float4 lower, upper;
  std::uint32_t child[2];      // 0, 0: a leaf
  std::uint32_t first, count;  // of a leaf, in the order
  // `share` plans a wide tree: how many of i + 2 = 2 … 8 children the first child has; 0: as with one less.
  std::array<std::uint8_t, 7> share;
};

struct BinaryTree {
  std::unique_ptr<BinaryNode[]> nodes;
  std::uint32_t root = 0;
  std::unique_ptr<std::uint32_t[]> order;  // numbers of boxes, ascending in each leaf
};

// Builds a tree of one box at least, with at most `leaf_size` a leaf.
BinaryTree build_binary_tree(std::span<const Bounds3f> boxes, unsigned leaf_size);

}  // namespace vitrail
