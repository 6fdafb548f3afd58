// SPDX-License-Identifier: Apache-2.0
#include "partitioner/cutting/shared_cell.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <set>

#include "tracer/rays/walk.h"

namespace vitrail::shared_cell_test {
namespace {

constexpr Bounds3f cell{{-50, -50, 0}, {50, 50, 20}};
constexpr std::uint32_t domains = 7;

// Trees on a plain, one kind a domain; some reach out of the cell.
std::vector<SharedBox> trees(int count) {
  std::mt19937 random(8);
  std::uniform_real_distribution<float> u(0, 1);
  std::vector<SharedBox> boxes;
  for (int i = 0; i < count; ++i) {
    const float x = 102 * u(random) - 51, y = 102 * u(random) - 51, r = 0.3f + u(random),
                h = 4 + 3 * u(random);
    boxes.push_back({{{x - r, y - r, -0.1f}, {x + r, y + r, h}}, static_cast<std::uint32_t>(i) % domains});
  }
  return boxes;
}

// Domain 0 has the cell's own; those of the boxes follow.
Manifest manifest_of(std::span<const SharedBox> boxes) {
  Manifest m;
  m.scale = 60;
  m.domains.resize(domains + 1);
  for (DomainInfo& d : m.domains) d.occupancy.slice.fill(~std::uint64_t{0});
  extend(m.domains[0].tight_bounds, cell);
  for (const SharedBox& b : boxes) extend(m.domains[b.domain + 1].tight_bounds, b.box);
  m.kd_nodes = tree_of_shared(cell, boxes, domains, max_kd_depth - 1);
  for (KdNode& node : m.kd_nodes)
    for (std::uint32_t KdNode::*side : {&KdNode::below, &KdNode::above}) {
      std::uint32_t& child = node.*side;
      const std::uint32_t domain = child & ~KdNode::leaf_bit;
      child = child & KdNode::leaf_bit ? KdNode::leaf_bit | (domain == domains ? 0 : domain + 1) : child + 1;
    }
  m.kd_nodes.insert(m.kd_nodes.begin(), {domains + 1, KdNode::no_axis, KdNode::leaf_bit | 0, 1});
  return m;
}

bool enters(const Ray& ray, const Bounds3f& box) {
  double t0 = 0, t1 = std::numeric_limits<double>::infinity();
  for (int a = 0; a < 3; ++a) {
    const double low = (double{box.lower[a]} - ray.origin[a]) / ray.direction[a],
                 high = (double{box.upper[a]} - ray.origin[a]) / ray.direction[a];
    t0 = std::max(t0, std::min(low, high));
    t1 = std::min(t1, std::max(low, high));
  }
  return t0 <= t1;
}

// A walk misses no domain that has a box on its way, and visits few others.
TEST(SharedCell, TellsWhichDomainsARayMayMeet) {
  const std::vector<SharedBox> boxes = trees(900);
  const Manifest m = manifest_of(boxes);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> u(-1, 1);
  std::size_t needed = 0, visited = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Ray ray{{48 * u(random), 48 * u(random), 9 + 9 * u(random)},
                  {u(random), u(random), 0.2f * u(random)}};
    std::set<std::uint32_t> met, due;
    DomainWalk walk(m, ray);
    for (DomainWalk::Visit v; walk.next(std::numeric_limits<double>::infinity(), v);)
      if (v.domain > 0) met.insert(v.domain);
    for (const SharedBox& b : boxes)
      if (enters(ray, b.box)) due.insert(b.domain + 1);
    ASSERT_TRUE(std::ranges::includes(met, due)) << i;
    needed += due.size(), visited += met.size();
  }
  EXPECT_GT(needed, 20'000u);
  EXPECT_LT(static_cast<double>(visited), 1.4 * static_cast<double>(needed))
      << "without planes beside boxes 2.9";
}

}  // namespace
}  // namespace vitrail::shared_cell_test
