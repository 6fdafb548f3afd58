// SPDX-License-Identifier: Apache-2.0
#include "importers/shapes/level_set.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

namespace vitrail::level_set_test {
namespace {

SampledFunction sampled(int nx, int ny, int nz, auto&& f) {
  SampledFunction function{nx, ny, nz, {}};
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x)
        function.values.push_back(
            static_cast<float>(f(Point3d{x / (nx - 1.0), y / (ny - 1.0), z / (nz - 1.0)})));
  return function;
}

// Of ∑ p·n dA ÷ 3 over its triangles.
double volume(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    const auto v = [&](std::size_t i) { return cast<double>(mesh.positions[t[i]]) - Point3d{}; };
    sum += dot(v(0), cross(v(1), v(2))) / 6;
  }
  return sum;
}

TEST(LevelSet, OfABallIsClosedAndLooksOutwards) {
  const Point3d middle{0.5, 0.45, 0.55};
  const LevelSet made =
      level_set(sampled(20, 24, 28, [&](const Point3d& p) { return length(p - middle) - 0.3; }));
  EXPECT_NEAR(volume(made.mesh), 4 * std::numbers::pi / 3 * std::pow(0.3, 3), 2e-3);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& t : made.mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_TRUE(edges.contains({edge.second, edge.first}));
  }
  for (std::size_t i = 0; i < made.mesh.positions.size(); ++i) {
    const Vector3d out = unit(cast<double>(made.mesh.positions[i]) - middle);
    EXPECT_GT(dot(out, to_vector(cast<double>(made.mesh.normals[i]))), 0.995);
  }
  EXPECT_LT(made.distance, 1e-3);
}

// 0 where x = 0.35, which linear interpolation has exactly.
TEST(LevelSet, OfAPlaneIsExact) {
  const LevelSet made = level_set(sampled(2, 2, 2, [](const Point3d& p) { return p.x - 0.35; }));
  ASSERT_FALSE(made.mesh.triangles.empty());
  for (const Point3f& p : made.mesh.positions) EXPECT_NEAR(p.x, 0.35, 1e-6);
  EXPECT_LT(made.distance, 1e-6);
  EXPECT_TRUE(level_set(sampled(3, 3, 3, [](const Point3d&) { return 1; })).mesh.triangles.empty());
}

}  // namespace
}  // namespace vitrail::level_set_test
