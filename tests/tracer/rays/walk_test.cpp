// SPDX-License-Identifier: Apache-2.0
#include "tracer/rays/walk.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace vitrail::walk_test {
namespace {

// The cube [−1,1]³ cut in halves, round the axes, into 2^depth domains whose tight bounds are their boxes.
Manifest grid(int depth) {
  Manifest m;
  m.scale = 1;
  const auto cut = [&](auto self, Bounds3f box, int level) -> std::uint32_t {
    if (level == depth) {
      const auto pad = static_cast<float>(padding(1));
      DomainInfo info;
      info.triangles = 1;
      info.tight_bounds = {{box.lower.x - pad, box.lower.y - pad, box.lower.z - pad},
                           {box.upper.x + pad, box.upper.y + pad, box.upper.z + pad}};
      info.occupancy.slice.fill(~std::uint64_t{0});
      m.domains.push_back(info);
      return KdNode::leaf_bit | static_cast<std::uint32_t>(m.domains.size() - 1);
    }
    const int axis = level % 3;
    const float split = 0.5f * (box.lower[axis] + box.upper[axis]);
    const std::size_t at = m.kd_nodes.size();
    m.kd_nodes.push_back({split, static_cast<std::uint32_t>(axis), 0, 0});
    Bounds3f below = box, above = box;
    below.upper[axis] = above.lower[axis] = split;
    const std::uint32_t b = self(self, below, level + 1), a = self(self, above, level + 1);
    m.kd_nodes[at].below = b;
    m.kd_nodes[at].above = a;
    return static_cast<std::uint32_t>(at);
  };
  cut(cut, {{-1, -1, -1}, {1, 1, 1}}, 0);
  return m;
}

std::vector<DomainWalk::Visit> all_visits(const Manifest& m, const Ray& ray,
                                          std::span<const DomainView* const> resident = {}) {
  std::vector<DomainWalk::Visit> visits;
  DomainWalk walk(m, ray, resident);
  for (DomainWalk::Visit v; walk.next(std::numeric_limits<double>::infinity(), v);) visits.push_back(v);
  return visits;
}

// Random rays, rays in interface planes, along axes and from far away.
std::vector<Ray> rays() {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> u(-1, 1);
  std::vector<Ray> result;
  for (int i = 0; i < 3000; ++i) {
    Ray ray{{u(random), u(random), u(random)}, {u(random), u(random), u(random)}, no_triangle};
    if (i % 5 == 1) ray.origin.x = 0, ray.direction.x = 0;
    if (i % 5 == 2) ray.direction = {0, 0, u(random) < 0 ? -1.0f : 1.0f};
    if (i % 5 == 3) ray.origin = {ray.direction.x * -1e4f, ray.direction.y * -1e4f, ray.direction.z * -1e4f};
    if (i % 5 == 4) ray.origin = {0, 0.5f, -0.5f};
    result.push_back(ray);
  }
  return result;
}

// All of the domains, which have the whole cube, are met in the leaves of `cells`, one of `sharers` in each;
// and one more, with number 0, comes before them.
Manifest shared_by(const Manifest& cells, std::uint32_t sharers) {
  Manifest m = cells;
  m.domains.resize(sharers + 1, m.domains[0]);
  for (KdNode& node : m.kd_nodes)
    for (std::uint32_t KdNode::*side : {&KdNode::below, &KdNode::above}) {
      std::uint32_t& child = node.*side;
      child = child & KdNode::leaf_bit ? KdNode::leaf_bit | (1 + (child & ~KdNode::leaf_bit) % sharers)
                                       : child + 1;
    }
  m.kd_nodes.insert(m.kd_nodes.begin(),
                    {static_cast<float>(sharers + 1), KdNode::no_axis, KdNode::leaf_bit | 0, 1});
  return m;
}

// Of those that share a cell each is visited once, where the ray comes to it first; also of more than 64.
TEST(Walk, VisitsEachThatSharesACellOnce) {
  Manifest cells = grid(9);
  for (DomainInfo& d : cells.domains) d.tight_bounds = {{-1.1f, -1.1f, -1.1f}, {1.1f, 1.1f, 1.1f}};
  for (const std::uint32_t sharers : {3u, 100u}) {
    const Manifest shared = shared_by(cells, sharers);
    const CellWays ways(shared);
    for (const Ray& ray : rays()) {
      std::vector<std::uint32_t> expected, visited;
      for (const DomainWalk::Visit& v : all_visits(cells, ray)) {
        const std::uint32_t sharer = 1 + v.domain % sharers;
        if (std::ranges::find(expected, sharer) == expected.end()) expected.push_back(sharer);
      }
      const auto all = all_visits(shared, ray);
      for (const DomainWalk::Visit& v : all) visited.push_back(v.domain);
      if (!visited.empty()) expected.insert(expected.begin(), 0);
      ASSERT_EQ(visited, expected);
      for (std::size_t i = 0; i < all.size(); ++i) {
        DomainWalk walk(shared, ray);
        walk.skip_past(all[i].domain, ways);
        DomainWalk::Visit next;
        ASSERT_EQ(walk.next(std::numeric_limits<double>::infinity(), next), i + 1 < all.size());
        if (i + 1 < all.size()) {
          EXPECT_EQ(next.domain, all[i + 1].domain);
        }
      }
    }
  }
}

// Subtrees behind the end are left out as a whole.
TEST(Walk, AnEndLeavesOutWhatLiesBehindItAndNothingElse) {
  const Manifest m = grid(6);
  for (const Ray& ray : rays()) {
    const auto all = all_visits(m, ray);
    for (int eighths = 1; eighths <= 8 && !all.empty(); ++eighths) {
      const double tmax = all.back().entry * eighths / 8 + 1e-6;
      std::vector<std::uint32_t> expected, visited;
      for (const auto& v : all)
        if (v.entry <= tmax) expected.push_back(v.domain);
      DomainWalk walk(m, ray);
      for (DomainWalk::Visit v; walk.next(tmax, v);) visited.push_back(v.domain);
      EXPECT_EQ(visited, expected);
    }
  }
}

TEST(Walk, VisitsEveryDomainThatThePointsOfARayLieIn) {
  const Manifest m = grid(6);
  for (const Ray& ray : rays()) {
    const auto visits = all_visits(m, ray);
    for (std::size_t i = 0; i < visits.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) EXPECT_NE(visits[i].domain, visits[j].domain);
    const double reach = length(cast<double>(ray.origin - Point3f{})) + 4;
    const double step = reach / length(cast<double>(ray.direction)) / 400;
    for (int k = 0; k <= 400; ++k) {
      const double t = k * step;
      const Point3d p = cast<double>(ray.origin) + cast<double>(ray.direction) * t;
      for (std::uint32_t d = 0; d < m.domains.size(); ++d) {
        const Bounds3f& b = m.domains[d].tight_bounds;
        bool inside = true;
        for (int axis = 0; axis < 3; ++axis)
          inside = inside && p[axis] >= static_cast<double>(b.lower[axis]) + 1e-9 &&
                   p[axis] <= static_cast<double>(b.upper[axis]) - 1e-9;
        if (!inside) continue;
        const auto found = std::ranges::find(visits, d, &DomainWalk::Visit::domain);
        ASSERT_NE(found, visits.end());
        EXPECT_LE(found->entry, t * (1 + 1e-9) + 1e-12);
      }
    }
  }
}

TEST(Walk, GoesOnWhereItWasInterrupted) {
  const Manifest m = grid(6);
  const CellWays ways(m);
  for (const Ray& ray : rays()) {
    const auto visits = all_visits(m, ray);
    for (std::size_t i = 0; i < visits.size(); ++i) {
      DomainWalk walk(m, ray);
      walk.skip_past(visits[i].domain, ways);
      DomainWalk::Visit v;
      const bool more = walk.next(std::numeric_limits<double>::infinity(), v);
      ASSERT_EQ(more, i + 1 < visits.size());
      if (more) {
        EXPECT_EQ(v.domain, visits[i + 1].domain);
      }
    }
  }
}

// Two cells, on either side of the plane x = 0.1, that four domains share each.
Manifest two_shared_cells() {
  Manifest cells = grid(5);
  for (DomainInfo& d : cells.domains) d.tight_bounds = {{-1.1f, -1.1f, -1.1f}, {1.1f, 1.1f, 1.1f}};
  const Manifest one = shared_by(cells, 3);
  const auto nodes = static_cast<std::uint32_t>(one.kd_nodes.size()),
             domains = static_cast<std::uint32_t>(one.domains.size());
  Manifest two = one;
  two.domains.insert(two.domains.end(), one.domains.begin(), one.domains.end());
  two.kd_nodes = {{0.1f, 0, 1, 1 + nodes}};
  for (const std::uint32_t cell : {0u, 1u})
    for (KdNode node : one.kd_nodes) {
      for (std::uint32_t KdNode::*side : {&KdNode::below, &KdNode::above})
        node.*side += node.*side & KdNode::leaf_bit ? cell * domains : 1 + cell * nodes;
      two.kd_nodes.push_back(node);
    }
  return two;
}

TEST(Walk, GoesOnInAndBehindCellsThatAreShared) {
  const Manifest m = two_shared_cells();
  const CellWays ways(m);
  std::size_t behind = 0;
  for (const Ray& ray : rays()) {
    const auto all = all_visits(m, ray);
    for (std::size_t i = 0; i < all.size(); ++i) {
      DomainWalk walk(m, ray);
      walk.skip_past(all[i].domain, ways);
      DomainWalk::Visit next;
      for (std::size_t k = i + 1; k < all.size(); ++k) {
        ASSERT_TRUE(walk.next(std::numeric_limits<double>::infinity(), next));
        ASSERT_EQ(next.domain, all[k].domain);
        behind += all[k].domain / 4 != all[i].domain / 4;
      }
      ASSERT_FALSE(walk.next(std::numeric_limits<double>::infinity(), next));
    }
  }
  EXPECT_GT(behind, 1000u) << "some go on in the other cell";
}

TEST(Walk, DirectionsOfAnyLength) {
  const Manifest m = grid(6);
  for (const Ray& ray : rays())
    for (const int exponent : {-110, -60, 90}) {
      Ray other = ray;
      other.direction = ray.direction * std::ldexp(1.0f, exponent);
      const auto visits = all_visits(m, ray), others = all_visits(m, other);
      ASSERT_EQ(visits.size(), others.size());
      for (std::size_t i = 0; i < visits.size(); ++i) EXPECT_EQ(visits[i].domain, others[i].domain);
    }
}

// From so far away that in double it crosses both of two planes at the same t.
TEST(Walk, VisitsCellsThatAreCrossedNearTheirCornersFromAfar) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> u(-1, 1);
  for (int i = 0; i < 20'000; ++i) {
    Manifest m = grid(2);
    for (DomainInfo& d : m.domains) d.tight_bounds = {{-1, -1, -1}, {1, 1, 1}};
    const float shift = m.kd_nodes[0].split = 3e-5f * u(random);
    const Vector3f d{1 + 0.5f * u(random), 1 + 0.5f * u(random), 0.1f * u(random)};
    const Ray ray{Point3f{} - d * 0x1p36f, d, no_triangle};
    // It goes through (0, 0): when it reaches y = 0 it is still below the plane at x = shift, or already
    // above.
    const std::uint32_t between = shift > 0 ? 1 : 2;
    const auto visits = all_visits(m, ray);
    EXPECT_NE(std::ranges::find(visits, between, &DomainWalk::Visit::domain), visits.end()) << shift;
  }
}

// Rounding moves such a ray by more than marks are padded: a domain is visited whatever its cells.
TEST(Walk, AsksNoCellsFromAfar) {
  Manifest m = grid(0);
  m.domains[0].occupancy = {};
  m.domains[0].occupancy.slice[0] = 1;
  EXPECT_TRUE(all_visits(m, {{0.5f, 0.5f, 3}, {0, 0, -1}, no_triangle}).empty());
  EXPECT_EQ(all_visits(m, {{0.5f, 0.5f, 1e12f}, {0, 0, -1}, no_triangle}).size(), 1u);
}

TEST(Walk, VisitsTheOneDomainThatThereIs) {
  const DomainView view;
  const DomainView *here = &view, *absent = nullptr;
  Manifest m = grid(0);
  m.domains[0].occupancy = {};
  const Ray ray{{0.5f, 0.5f, 3}, {0, 0, -1}, no_triangle};
  EXPECT_TRUE(all_visits(m, ray, {&absent, 1}).empty());
  EXPECT_EQ(all_visits(m, ray, {&here, 1}).size(), 1u);
  DomainWalk walk(m, ray, {&here, 1});
  walk.skip_past(0, CellWays(m));
  DomainWalk::Visit visit;
  EXPECT_FALSE(walk.next(1, visit));
}

TEST(Walk, MeetsNothingFromBeyondFloats) {
  const Manifest m = grid(4);
  const auto visits_from = [&](float far) {
    return all_visits(m, {{far, far, far}, {-1, -1, -1}, no_triangle}).size();
  };
  EXPECT_GT(visits_from(1e17f), 0u);
  for (const float far :
       {2e18f, 3e38f, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()})
    EXPECT_EQ(visits_from(far), 0u) << far;
}

TEST(Walk, StaysInTheSlabsThatItIsParallelTo) {
  const Manifest m = grid(0);
  const float edge = m.domains[0].tight_bounds.upper.x;
  for (const float distance : {2.0f, 1e12f, 1e17f})
    for (const float x : {edge, -edge})
      EXPECT_EQ(all_visits(m, {{x, 0.5f, distance}, {0, 0, -1}, no_triangle}).size(), 1u) << distance;
  EXPECT_TRUE(all_visits(m, {{1.1f, 0.5f, 2}, {0, 0, -1}, no_triangle}).empty());
}

TEST(Walk, StopsBehindTheHit) {
  const Manifest m = grid(6);
  const Ray ray{{-3, 0.1f, 0.2f}, {1, 0.01f, 0.02f}, no_triangle};
  DomainWalk walk(m, ray);
  int count = 0;
  for (DomainWalk::Visit v; walk.next(2.4, v); ++count) EXPECT_LE(v.entry, 2.4);
  EXPECT_LT(count, static_cast<int>(all_visits(m, ray).size()));
}

}  // namespace
}  // namespace vitrail::walk_test
