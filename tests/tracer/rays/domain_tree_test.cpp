// SPDX-License-Identifier: Apache-2.0
#include "tracer/rays/domain_tree.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace vitrail::domain_tree_test {
namespace {

bool holds(const Bounds3f& outer, const Bounds3f& inner) {
  Bounds3f both = outer;
  extend(both, inner);
  return both == outer;
}

// The domains below a node, each within the boxes on its way.
void collect(const Manifest& m, const std::vector<BvhNode>& tree, std::uint32_t at, const Bounds3f& around,
             std::vector<std::uint32_t>& domains) {
  for (int i = 0; i < 8; ++i) {
    const BvhNode& node = tree[at];
    const std::uint32_t child = node.child[i];
    if (child == BvhNode::empty) continue;
    Bounds3f box;
    for (int axis = 0; axis < 3; ++axis)
      box.lower[axis] = node.lower[axis][i], box.upper[axis] = node.upper[axis][i];
    EXPECT_TRUE(holds(around, box));
    if (child & BvhNode::cluster_bit) {
      domains.push_back(child & ~BvhNode::cluster_bit);
      EXPECT_EQ(box, m.domains[domains.back()].tight_bounds);
    } else {
      EXPECT_GT(child, at);
      collect(m, tree, child, box, domains);
    }
  }
}

// The interval from 0 to `count` on x, cut into unit domains one after the other: a kd-tree as deep as can
// be. Domains whose number `is_empty` holds of are empty.
template <class IsEmpty>
Manifest chain(std::uint32_t count, const IsEmpty& is_empty) {
  Manifest m;
  for (std::uint32_t d = 0; d < count; ++d) {
    DomainInfo info;
    const auto x = static_cast<float>(d);
    if (!is_empty(d)) info.tight_bounds = {{x, 0, 0}, {x + 1, 1, 1}};
    m.domains.push_back(info);
    if (d + 1 == count) break;
    const std::uint32_t above = d + 2 == count ? KdNode::leaf_bit | (d + 1) : d + 1;
    m.kd_nodes.push_back({x + 1, 0, KdNode::leaf_bit | d, above});
  }
  return m;
}

TEST(DomainTree, HasEachDomainThatIsNotEmptyOnceWithinItsBoxes) {
  for (const std::uint32_t count : {2u, 3u, 8u, 9u, 62u}) {
    const Manifest m = chain(count, [](std::uint32_t d) { return d % 5 == 1; });
    const std::vector<BvhNode> tree = domain_tree(m);
    std::vector<std::uint32_t> expected, found;
    Bounds3f all;
    for (std::uint32_t d = 0; d < count; ++d)
      if (d % 5 != 1) expected.push_back(d), extend(all, m.domains[d].tight_bounds);
    collect(m, tree, 0, all, found);
    std::ranges::sort(found);
    EXPECT_EQ(found, expected);
    EXPECT_LE(tree.size(), (count + 6) / 7);
  }
}

// Domains 1 and 2 share the cell of 0, where each is met in two places.
TEST(DomainTree, HasADomainOnceThatIsMetInSeveralPlaces) {
  constexpr std::uint32_t leaf = KdNode::leaf_bit;
  Manifest m = chain(3, [](std::uint32_t) { return false; });
  m.kd_nodes = {{3, KdNode::no_axis, leaf | 0, 1},
                {0.5f, 1, 2, 3},
                {1, 0, leaf | 1, leaf | 2},
                {1, 0, leaf | 2, leaf | 1}};
  Bounds3f all;
  for (const DomainInfo& d : m.domains) extend(all, d.tight_bounds);
  std::vector<std::uint32_t> found;
  collect(m, domain_tree(m), 0, all, found);
  std::ranges::sort(found);
  EXPECT_EQ(found, (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST(DomainTree, HasNoNodesOfOneDomainOrOfEmptyOnes) {
  EXPECT_TRUE(domain_tree(chain(1, [](std::uint32_t) { return false; })).empty());
  EXPECT_TRUE(domain_tree(chain(9, [](std::uint32_t) { return true; })).empty());
}

}  // namespace
}  // namespace vitrail::domain_tree_test
