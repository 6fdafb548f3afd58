// SPDX-License-Identifier: Apache-2.0
#include "bundle/occupancy.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "tests/bundle/sample_bundle.h"

namespace vitrail::occupancy_test {
namespace {

const Bounds3f box{{-1, 2, 10}, {7, 6, 10.5f}};
constexpr double padding = 1e-6;

class Random {
 public:
  double operator()(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(engine_);
  }
  Point3d point(double beyond) {
    return {(*this)(-1 - beyond, 7 + beyond), (*this)(2 - beyond, 6 + beyond),
            (*this)(10 - beyond, 10.5 + beyond)};
  }

 private:
  std::mt19937_64 engine_{3};
};

int count(const Occupancy& o) {
  int marked = 0;
  for (const std::uint64_t slice : o.slice) marked += __builtin_popcountll(slice);
  return marked;
}

TEST(Occupancy, MarksWhatATriangleReaches) {
  Occupancy o;
  mark(o, box, std::vector<Point3d>{{-0.5, 2.2, 10.01}, {-0.4, 2.2, 10.01}, {-0.5, 2.3, 10.02}}, padding);
  EXPECT_EQ(o.slice[0], 1u);
  EXPECT_EQ(count(o), 1);
  // Half of the bottom: 8·9/2 cells on or below the diagonal, and those that touch it.
  Occupancy half;
  mark(half, box, std::vector<Point3d>{{-1, 2, 10.01}, {7, 2, 10.01}, {-1, 6, 10.01}}, padding);
  EXPECT_GE(count(half), 36);
  EXPECT_LE(count(half), 36 + 7);
  EXPECT_EQ(half.slice[1], 0u);
}

// Triangle i of the sample domain is (i+eₓ, i+e_y, i+e_z); of 3 and 6 only the corners i+eₓ are in it.
TEST(Occupancy, PiecesStandForTheirTriangles) {
  DomainContent d = test::sample_domain();
  d.pieces = {{3, 0, 3}, {6, 3, 3}};
  d.piece_vertices = {{4, 3, 3}, {3.9, 3.1, 3}, {3.9, 3, 3.1}, {7, 6, 6}, {6.9, 6.1, 6}, {6.9, 6, 6.1}};
  const Bounds3f cells_around{{-0.5f, -0.5f, -0.5f}, {7.5f, 7.5f, 7.5f}};
  const Occupancy o = occupancy_of(cells_around, view_of(d), d.pieces, d.piece_vertices, 1e-6f);
  const auto marked = [&](std::size_t x, std::size_t y, std::size_t z) {
    return (o.slice[z] >> (y * 8 + x) & 1) != 0;
  };
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_TRUE(marked(i + 1, i, i)) << i;
    EXPECT_EQ(marked(i, i, i + 1), i != 3 && i != 6) << i;
  }
}

// A ray through a point of a triangle meets its marks, wherever it comes from; also through the points that
// lie on bounds of cells.
TEST(Occupancy, NoHitIsMissed) {
  Random random;
  for (int i = 0; i < 20000; ++i) {
    std::vector<Point3d> triangle{random.point(0), random.point(0), random.point(0)};
    if (i % 4 == 0)
      for (Point3d& p : triangle) p = {std::round(p.x), 2 + std::round((p.y - 2) * 2) / 2, p.z};
    const double u = random(0, 1), v = random(0, 1 - u);
    const Point3d target =
        i % 8 == 0 ? triangle[0]
                   : triangle[0] + (triangle[1] - triangle[0]) * u + (triangle[2] - triangle[0]) * v;
    const Point3d from = random.point(20);
    Occupancy o;
    mark(o, box, triangle, padding);
    EXPECT_TRUE(meets(o, box, from, target - from, 0.5, 1.5)) << i;
    // Along an axis, in the plane of a bound of cells.
    const Point3d beside{target.x, target.y - 40, target.z};
    EXPECT_TRUE(meets(o, box, beside, {0, 1, 0}, 30, 50)) << i;
  }
}

TEST(Occupancy, EmptySpaceIsPassed) {
  Occupancy o;
  mark(o, box, std::vector<Point3d>{{-1, 2, 10.01}, {7, 2, 10.01}, {-1, 6, 10.01}}, padding);
  EXPECT_FALSE(meets(o, box, {-3, 3, 10.2}, {1, 0, 0}, 2, 10));
  EXPECT_FALSE(meets(o, box, {7, 6, 11}, {0, 0, -1}, 0.5, 1));
  EXPECT_TRUE(meets(o, box, {0, 3, 11}, {0, 0, -1}, 0.5, 1));
  EXPECT_FALSE(meets(Occupancy{}, box, {0, 3, 11}, {0, 0, -1}, 0.5, 1));
}

}  // namespace
}  // namespace vitrail::occupancy_test
