// SPDX-License-Identifier: Apache-2.0
#include "importers/solids/grids.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/geometry/pi.h"
#include "scene/system/diagnostics.h"
#include "tests/importers/solids/solid_checks.h"

namespace vitrail::solids::grids_test {
namespace {

HeightField waves(int columns, int rows) {
  HeightField field{columns, rows, {}};
  for (int k = 0; k < rows; ++k)
    for (int i = 0; i < columns; ++i)
      field.heights.push_back(0.5 + 0.25 * std::sin(2 * pi * i / (columns - 1)) *
                                        std::cos(2 * pi * k / (rows - 1)));
  return field;
}

TEST(HeightField, IsClosedBelow) {
  const HeightField field = waves(40, 30);
  const Solid made = height_field(field);
  expect_sound(made, 0.9);
  EXPECT_NEAR(volume(made), 0.5 + 1e-3, 1e-3);
  EXPECT_EQ(mesh_of(made).triangles.size(), 39u * 29 * 2);
  for (const Point3f& p : mesh_of(made).positions) {
    EXPECT_NEAR(p.y, 0.5 + 0.25 * std::sin(2 * pi * p.x) * std::cos(2 * pi * p.z), 1e-6);
  }
}

TEST(HeightField, WaterCoversWhatIsLower) {
  HeightField field = waves(41, 41);  // some heights are at the water's level
  field.water_level = 0.5;
  const Solid made = height_field(field);
  expect_sound(made, 0.9);
  for (const Point3f& p : mesh_of(made).positions) EXPECT_GE(p.y, 0.5f);
  // ∫∫ of the parts above: a quarter of 2/π times 2/π, over two quarters of the square each way.
  EXPECT_NEAR(volume(made), 0.25 * 4 / (pi * pi) / 2 + 1e-3 / 2, 2e-3);
  field.water_level = 0.9;
  EXPECT_TRUE(height_field(field).empty());
}

TEST(HeightField, SmoothNormalsAreThoseOfTheSurface) {
  HeightField field = waves(101, 101);
  field.smooth = true;
  field.closed = false;
  const TriangleMesh made = mesh_of(height_field(field));
  EXPECT_EQ(made.positions.size(), 101u * 101);
  for (std::size_t v = 0; v < made.positions.size(); ++v) {
    const Point3d p = cast<double>(made.positions[v]);
    if (p.x < 0.02 || p.x > 0.98 || p.z < 0.02 || p.z > 0.98) continue;
    const Vector3d n = normalize(Vector3d{-0.5 * pi * std::cos(2 * pi * p.x) * std::cos(2 * pi * p.z), 1,
                                          0.5 * pi * std::sin(2 * pi * p.x) * std::sin(2 * pi * p.z)});
    EXPECT_GT(dot(n, to_vector(cast<double>(made.normals[v]))), 0.9999);
  }
  EXPECT_THROW(height_field({3, 3, {0, 0}}), Error);
}

TEST(BicubicPatch, PassesThroughItsCorners) {
  std::array<Point3d, 16> points;
  for (std::size_t i = 0; i < 16; ++i)
    points[i] = {static_cast<double>(i % 4), static_cast<double>(i / 4), i % 4 == 1 ? 1.0 : 0.0};
  const Solid made = bicubic_patch(points);
  EXPECT_FALSE(made.closed);
  EXPECT_EQ(made.positions.front(), (Point3d{0, 0, 0}));
  EXPECT_EQ(made.positions.back(), (Point3d{3, 3, 0}));
  const auto off = [](Point3d p) {
    const double u = p.x / 3;
    return p.z - 3 * u * (1 - u) * (1 - u);
  };
  EXPECT_LT(greatest_distance(made, off), 5e-4 * 3);
  for (std::size_t t = 0; t < made.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const double u = made.positions[made.triangles[t][i]].x / 3;
      const Vector3d n = normalize(Vector3d{-(3 * (1 - u) * (1 - u) - 6 * u * (1 - u)) / 3, 0, 1});
      EXPECT_GT(dot(n, to_vector(cast<double>(made.normals[t][i]))), 0.9999);
    }
}

TEST(Parametric, SphereHasItsAreaAndIsCut) {
  Parametric ball{.place =
                      [](double u, double v) {
                        return Point3d{std::cos(u) * std::sin(v), std::cos(v), std::sin(u) * std::sin(v)};
                      },
                  .to = {2 * pi, pi}};
  const Solid made = parametric(ball);
  EXPECT_LT(greatest_distance(made, [](Point3d p) { return length(p - Point3d{}) - 1; }), 5e-4 * 2);
  const auto area = [](const Solid& solid) {
    double sum = 0;
    for (const auto& t : solid.triangles) {
      const Point3d a = solid.positions[t[0]];
      sum += length(cross(solid.positions[t[1]] - a, solid.positions[t[2]] - a)) / 2;
    }
    return sum;
  };
  EXPECT_NEAR(area(made), 4 * pi, 0.02);
  ball.contained_by = Bounds3d{{-2, 0.5, -2}, {2, 2, 2}};
  const Solid cut = parametric(ball);
  EXPECT_NEAR(area(cut), 2 * pi * 0.5, 0.01);
  for (const auto& t : cut.triangles)
    for (const std::uint32_t v : t) EXPECT_GE(cut.positions[v].y, 0.5 - 1e-9);
  ball.place = [](double, double) { return Point3d{NAN, 0, 0}; };
  EXPECT_THROW(parametric(ball), Error);
}

}  // namespace
}  // namespace vitrail::solids::grids_test
