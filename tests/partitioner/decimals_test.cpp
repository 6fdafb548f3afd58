// SPDX-License-Identifier: Apache-2.0
#include "partitioner/placing/decimals.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "partitioner/placing/wedged_panes.h"

namespace vitrail::decimals_test {
namespace {

// 24 vertices of a box about a point, turned, each number written by `write` and read again.
template <class Write>
std::vector<Point3f> written_box(Vector3d about, double size, const Write& write) {
  std::vector<Point3f> box;
  for (int i = 0; i < 8; ++i) {
    const Vector3d p{(i & 1 ? 0.5 : -0.5) * size, (i & 2 ? 0.4 : -0.4) * size,
                     (i & 4 ? 0.001 : -0.001) * size};
    const Vector3d q{about.x + 0.8 * p.x - 0.6 * p.y + 0.0098765432 * i * size,
                     about.y + 0.48 * p.x + 0.64 * p.y - 0.6 * p.z,
                     about.z + 0.36 * p.x + 0.48 * p.y + 0.8 * p.z + 0.0123456789 * i * size};
    const auto number = [&](double x) { return std::stof(write(x)); };
    box.push_back({number(q.x), number(q.y), number(q.z)});
  }
  return box;
}

TEST(DecimalStep, IsThatOfTheFile) {
  for (const double size : {0.3, 3.0, 40.0})
    for (const Vector3d about : {Vector3d{0.1, 0.2, 0.3}, Vector3d{12.3, -4.5, 7.8}})
      for (const int decimals : {2, 3, 4, 5}) {
        const double step = std::pow(10.0, -decimals);
        if (step > size / 64) continue;
        const auto box =
            written_box(about, size, [&](double x) { return fmt::format("{:.{}f}", x, decimals); });
        // Numbers of few digits may be of a format with six as well.
        EXPECT_NEAR(decimal_step(box) / step, 1, 1e-9) << size << ' ' << decimals << ' ' << about.x;
      }
}

TEST(DecimalStep, OfSixDigitsIsThatOfTheGreatest) {
  const auto box = written_box({12.3, -4.5, 0.8}, 0.3, [](double x) { return fmt::format("{:.6g}", x); });
  EXPECT_NEAR(decimal_step(box), 1e-4, 1e-12);
}

TEST(DecimalStep, IsNoneOfFloatsAndOfDesigns) {
  EXPECT_EQ(decimal_step(written_box({}, 3, [](double x) { return fmt::format("{:.9g}", x); })), 0);
  EXPECT_EQ(decimal_step(written_box({}, 3, [](double x) { return fmt::format("{}", x); })), 0);
  const std::vector<Point3f> cube{{-1, -1, -1}, {1, 1, 1}, {1, -1, 1}}, point{{0, 0, 0}};
  EXPECT_EQ(decimal_step(cube), 0);
  EXPECT_EQ(decimal_step(point), 0);
  EXPECT_EQ(decimal_step({}), 0);
}

// ---- Panes and what is none

TriangleMesh plate(double wedge_rad, int decimals) {
  TriangleMesh mesh;
  const double step = std::pow(10.0, -decimals);
  const auto written = [&](double x) { return static_cast<float>(std::round(x / step) * step); };
  for (int i = 0; i < 8; ++i) {
    const double x = i & 1 ? 1.5012345 : -1.5012345, half = 0.0301234 + wedge_rad / 2 * x;
    mesh.positions.push_back(
        {written(x), written(i & 2 ? 1.2512345 : -1.2512345), written(i & 4 ? half : -half)});
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

TEST(PaneFaces, AreAsFarFromParallelAsTheyAre) {
  for (const double wedge : {0.0, 3e-4, 2e-3, 1e-2}) {
    const auto faces = pane_faces(plate(wedge, 7), rotate(0.3, {1, 2, 3}));
    ASSERT_TRUE(faces.has_value());
    EXPECT_NEAR(faces->wedge_rad, wedge, 1e-6);
    EXPECT_LT(faces->explained_rad, 1e-5);
  }
  // Half the thickness, 0.029898 and 0.030349 m, becomes 0.0299 and 0.0303 m.
  const auto rounded = pane_faces(plate(3e-4, 4), {});
  ASSERT_TRUE(rounded.has_value());
  EXPECT_GT(rounded->explained_rad, 1e-4);
  EXPECT_FALSE(pane_faces(plate(0, 7), scale({1, 1, 42})).has_value());
}

}  // namespace
}  // namespace vitrail::decimals_test
