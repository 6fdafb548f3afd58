// SPDX-License-Identifier: Apache-2.0
// Large concave polygons, each of which would take minutes if every corner were held against every other.
#include "importers/shapes/polygon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "importers/shapes/point_tree.h"

namespace vitrail::polygon_test {
namespace {

using Flat = std::vector<Point2d>;
constexpr double turn = 6.283185307179586;

double area_of(const Flat& p) {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < p.size(); ++i) sum += orientation(p[0], p[i], p[i + 1]) / 2;
  return sum;
}

// As many triangles as there have to be, none turned over, together of the polygon's area, and every edge
// inside shared by two of them in opposite directions: they tile it.
void expect_tiles(const Flat& p) {
  std::vector<Point3d> corners;
  for (const Point2d q : p) corners.push_back({q.x, q.y, 0});
  std::vector<CornerTriple> cut;
  triangulate_polygon(corners, cut);
  ASSERT_EQ(cut.size(), p.size() - 2);
  double sum = 0;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const CornerTriple& t : cut) {
    const double area = orientation(p[t[0]], p[t[1]], p[t[2]]) / 2;
    ASSERT_GE(area, 0);
    sum += area;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = t[k], to = t[(k + 1) % 3];
      ++edges[{from, to}];
      --edges[{to, from}];
    }
  }
  EXPECT_NEAR(sum, area_of(p), 1e-9 * sum);
  for (const auto& [edge, balance] : edges) {
    const bool outer =
        (edge.first + 1) % p.size() == edge.second || (edge.second + 1) % p.size() == edge.first;
    ASSERT_EQ(std::abs(balance), outer ? 1 : 0) << edge.first << " " << edge.second;
  }
}

Flat star(std::size_t count, double depth, std::mt19937& random) {
  std::uniform_real_distribution<double> radius(1 - depth, 1);
  Flat p;
  for (std::size_t i = 0; i < count; ++i) {
    const double phi = turn * static_cast<double>(i) / static_cast<double>(count), r = radius(random);
    p.push_back({r * std::cos(phi), r * std::sin(phi)});
  }
  return p;
}

// A corridor that winds inwards: nothing but its two ends can be clipped at first where it is narrow.
Flat spiral(std::size_t count, double turns, double width) {
  Flat p;
  for (const double side : {0.0, width}) {
    const std::size_t half = count / 2, begin = p.size();
    for (std::size_t i = 0; i < half; ++i) {
      const double t = static_cast<double>(i) / static_cast<double>(half - 1), phi = turn * turns * t;
      const double r = 1 + turns * t - side;
      p.push_back({r * std::cos(phi), r * std::sin(phi)});
    }
    if (side == 0) std::reverse(p.begin() + static_cast<std::ptrdiff_t>(begin), p.end());
  }
  if (area_of(p) < 0) std::reverse(p.begin(), p.end());
  return p;
}

// Slanted teeth, whose triangles are long and have large boxes.
Flat comb(std::size_t teeth) {
  Flat p{{0, -1}, {static_cast<double>(teeth) + 1, -1}};
  const double slant = static_cast<double>(teeth);
  for (std::size_t i = teeth; i-- > 0;) {
    const auto x = static_cast<double>(i);
    p.push_back({x + 1, 0});
    p.push_back({x + 0.9 + slant, slant});
    p.push_back({x + 0.5, 0});
  }
  return p;
}

Flat koch(int depth) {
  Flat p{{0, 0}, {0.5, std::sqrt(0.75)}, {1, 0}};
  for (int level = 0; level < depth; ++level) {
    Flat finer;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const Point2d a = p[i], b = p[(i + 1) % p.size()];
      const double x = (b.x - a.x) / 3, y = (b.y - a.y) / 3;
      const double h = std::sqrt(0.75);
      finer.push_back(a);
      finer.push_back({a.x + x, a.y + y});
      finer.push_back({a.x + 1.5 * x - h * y, a.y + 1.5 * y + h * x});
      finer.push_back({a.x + 2 * x, a.y + 2 * y});
    }
    p = std::move(finer);
  }
  std::reverse(p.begin(), p.end());
  return p;
}

TEST(LargePolygon, OfEveryShapeIsTiled) {
  std::mt19937 random(1);
  expect_tiles(star(100'000, 0.02, random));
  expect_tiles(star(100'000, 0.9, random));
  expect_tiles(spiral(100'000, 3, 0.5));
  expect_tiles(spiral(20'000, 200, 0.3));
  expect_tiles(comb(30'000));
  expect_tiles(koch(7));
}

TEST(LargePolygon, ThatCrossesItselfEnds) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> anywhere(0, 1);
  std::vector<Point3d> p;
  for (int i = 0; i < 20'000; ++i) p.push_back({anywhere(random), anywhere(random), 0});
  std::vector<CornerTriple> cut;
  triangulate_polygon(p, cut);
  EXPECT_EQ(cut.size(), p.size() - 2);
}

TEST(Polygon, RandomSimpleOnesAreTiled) {
  std::mt19937 random(3);
  for (int i = 0; i < 300; ++i) {
    const std::size_t count = 4 + random() % 60;
    expect_tiles(star(count, 0.99, random));
  }
}

TEST(PointTree, FindsWhatIsWithin) {
  std::mt19937 random(4);
  std::uniform_int_distribution<int> coordinate(0, 40);
  const auto point = [&] { return Point2d{coordinate(random) / 8.0, coordinate(random) / 8.0}; };
  for (int run = 0; run < 50; ++run) {
    Flat points(200);
    std::vector<std::uint32_t> alive;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      points[i] = point();
      if (i % 3 != 0) alive.push_back(i);
    }
    PointTree tree(points, alive);
    while (!alive.empty()) {
      Point2d a = point(), b = point(), c = point();
      if (orientation(a, b, c) < 0) std::swap(b, c);
      const auto is_within = [&](std::uint32_t i) {
        const Point2d q = points[i];
        return orientation(a, b, q) >= 0 && orientation(b, c, q) >= 0 && orientation(c, a, q) >= 0 &&
               q != a && q != b && q != c && orientation(a, b, c) > 0;
      };
      if (orientation(a, b, c) > 0) {
        const auto found = tree.find_within(a, b, c);
        EXPECT_EQ(found.has_value(), std::any_of(alive.begin(), alive.end(), is_within));
        if (found) {
          EXPECT_TRUE(is_within(*found) && std::count(alive.begin(), alive.end(), *found) == 1);
        }
      }
      const std::size_t gone = random() % alive.size();
      tree.remove(alive[gone]);
      alive.erase(alive.begin() + static_cast<std::ptrdiff_t>(gone));
    }
  }
}

}  // namespace
}  // namespace vitrail::polygon_test
