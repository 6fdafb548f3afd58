// SPDX-License-Identifier: Apache-2.0
// Random trees of sets, half of whose numbers coincide: closed, right at random points, and hardly ever
// refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "importers/solids/csg.h"
#include "importers/solids/primitives.h"
#include "tests/importers/solids/solid_checks.h"

namespace vitrail::solids::csg_trees_test {
namespace {

using Inside = std::function<bool(Point3d)>;

struct Tree {
  Csg csg;
  Inside inside;
};

class RandomTrees {
 public:
  explicit RandomTrees(std::uint32_t seed) : random_(seed) {}

  std::uint32_t draw() { return static_cast<std::uint32_t>(random_()); }
  double number(double low, double high) { return low + (high - low) * (draw() / 4294967296.0); }

  Tree tree(int depth) {
    if (depth == 0 || draw() % 5 == 0) return leaf();
    const std::uint32_t kind = draw() % 5;
    const std::uint32_t more = draw() % 3;
    std::vector<Csg> sets;
    std::vector<Inside> in;
    for (std::uint32_t i = 0; i < (kind == 4 ? 1 : 2 + more); ++i) {
      Tree one = tree(depth - 1);
      sets.push_back(std::move(one.csg));
      in.push_back(std::move(one.inside));
    }
    const auto any = [in](Point3d p) {
      return std::ranges::any_of(in, [&](const Inside& i) { return i(p); });
    };
    const auto all = [in](Point3d p) {
      return std::ranges::all_of(in, [&](const Inside& i) { return i(p); });
    };
    const auto first_alone = [in](Point3d p) {
      return in[0](p) && std::none_of(in.begin() + 1, in.end(), [&](const Inside& i) { return i(p); });
    };
    switch (kind) {
      case 0:
        return {unite(std::move(sets)), any};
      case 1:
        return {merge(std::move(sets)), any};
      case 2:
        return {intersection(std::move(sets)), all};
      case 3:
        return {difference(std::move(sets)), first_alone};
      default:
        return {complement(std::move(sets[0])), [in](Point3d p) { return !in[0](p); }};
    }
  }

 private:
  // Half of them multiples of ½, so that faces coincide.
  double coordinate(double low, double high) {
    const double v = number(low, high);
    return draw() % 2 ? v : std::round(2 * v) / 2;
  }
  Vector3d vector(double low, double high) {
    const double x = coordinate(low, high), y = coordinate(low, high), z = coordinate(low, high);
    return {x, y, z};
  }

  Tree leaf() {
    const std::uint32_t kind = draw() % 4, surface = draw() % 7;
    if (kind == 0) {
      const Point3d low = Point3d{} + vector(-2, 2), high = low + vector(0.5, 3);
      return {solid(box(low, high), surface), [=](Point3d p) {
                return p.x > low.x && p.x < high.x && p.y > low.y && p.y < high.y && p.z > low.z &&
                       p.z < high.z;
              }};
    }
    if (kind == 1) {
      const Point3d center = Point3d{} + vector(-1, 1);
      const double radius = coordinate(0.5, 2);
      return {solid(sphere(center, radius, {1e-2}), surface),
              [=](Point3d p) { return length(p - center) < radius; }};
    }
    if (kind == 2) {
      const Point3d base = Point3d{} + vector(-1, 1);
      const double high = coordinate(0.5, 3), radius = coordinate(0.5, 1.5);
      const int axis = static_cast<int>(draw() % 3);
      Vector3d along;
      along[axis] = high;
      return {solid(cylinder(base, base + along, radius, false, {1e-2}), surface), [=](Point3d p) {
                const Vector3d d = p - base;
                const double t = d[axis];
                return t > 0 && t < high && dot(d, d) - t * t < radius * radius;
              }};
    }
    Vector3d normal = vector(-1, 1);
    if (length(normal) < 0.1) normal = {0, 1, 0};
    const double distance = coordinate(-1, 1);
    return {half_space({normal, distance}, surface),
            [=](Point3d p) { return dot(normal, p - Point3d{}) < distance * length(normal); }};
  }

  std::mt19937 random_;
};

// How often the solid's surface turns around the point.
int winding(const Solid& solid, Point3d from, Vector3d along) {
  int turns = 0;
  for (const auto& t : solid.triangles) {
    const Vector3d a = solid.positions[t[0]] - from, b = solid.positions[t[1]] - from,
                   c = solid.positions[t[2]] - from;
    const double u = dot(cross(b, c), along), v = dot(cross(c, a), along), w = dot(cross(a, b), along);
    if (!((u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0))) continue;
    const Vector3d hit = (a * u + b * v + c * w) * (1 / (u + v + w));
    if (dot(hit, along) > 0) turns += u > 0 ? 1 : -1;
  }
  return turns;
}

TEST(CsgTrees, AreRightAndHardlyEverRefused) {
  int refused = 0, wrong = 0;
  constexpr int trees = 60, points = 40, most_refused = 1;
  for (std::uint32_t seed = 0; seed < trees; ++seed) {
    RandomTrees random(seed);
    Tree tree = random.tree(3);
    const CsgResult result = evaluate(
        intersection({solid(box({-3, -3, -3}, {3.01, 3.02, 3.03}), 99), std::move(tree.csg)}), {.reach = 50});
    EXPECT_TRUE(result.solid.empty() || is_watertight(result.solid)) << seed;
    refused += !result.refused.empty();
    for (int i = 0; i < points; ++i) {
      const double x = random.number(-2.9, 2.9), y = random.number(-2.9, 2.9), z = random.number(-2.9, 2.9);
      const bool inside = winding(result.solid, {x, y, z}, {0.31, 0.52, 0.79}) > 0;
      wrong += inside != tree.inside({x, y, z});
    }
  }
  EXPECT_LE(refused, most_refused);
  EXPECT_LE(wrong, trees * points / 100)
      << "points near surfaces, which are triangles, and those of refused trees";
}

}  // namespace
}  // namespace vitrail::solids::csg_trees_test
