// SPDX-License-Identifier: Apache-2.0
#include "partitioner/meshes/repair.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/partitioner/meshes/shapes.h"

namespace vitrail::repair_test {
namespace {

TEST(Repair, LeavesASoundMeshAsItIs) {
  TriangleMesh mesh = test::torus(20, 12, 1, 0.3, true);
  mesh.attributes = {{"vertex_age", false, 1, std::vector<float>(mesh.positions.size(), 2)},
                     {"face_hue", true, 3, std::vector<float>(3 * mesh.triangles.size(), 0.5f)}};
  const RepairedMesh repaired = repair(mesh, false);
  EXPECT_EQ(repaired, (RepairedMesh{mesh}));
}

TEST(Repair, CountsEveryDefect) {
  TriangleMesh mesh = test::sphere(2);
  const TriangleMesh sound = mesh;
  const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh.triangles.push_back({a, b, c});
  };
  for (int i = 0; i < 5; ++i) mesh.positions.push_back(sound.positions[7]);             // equal and unused
  for (int i = 0; i < 3; ++i) mesh.positions.push_back({9, static_cast<float>(i), 9});  // unused
  const auto [a, b, c] = mesh.triangles[3];
  add(b, c, a), add(c, a, b);  // duplicates
  add(a, c, b);                // a duplicate that faces the other way
  add(a, a, b), add(c, c, c);  // degenerate
  add(7, vertices, a);         // degenerate by position
  const RepairedMesh repaired = repair(mesh, false);
  EXPECT_EQ(repaired.mesh, sound);
  EXPECT_EQ(repaired.merged_vertices, 5u);
  EXPECT_EQ(repaired.unused_vertices, 3u);
  EXPECT_EQ(repaired.degenerate_triangles, 3u);
  EXPECT_EQ(repaired.duplicate_triangles, 3u);
  const RepairedMesh shining = repair(mesh, true);
  EXPECT_EQ(shining.duplicate_triangles, 2u);
  EXPECT_EQ(shining.mesh.triangles.size(), sound.triangles.size() + 1);
}

TEST(Repair, TellsNeedlesFromLinesExactly) {
  const float next = std::nextafter(1.f, 2.f);
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 1, 1}, {3, 3, 3}, {1, 1, next}, {1e-30f, 1e-30f, 1e-30f}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 2}, {0, 4, 2}};
  const RepairedMesh repaired = repair(mesh, false);
  EXPECT_EQ(repaired.degenerate_triangles, 2u);
  ASSERT_EQ(repaired.mesh.triangles.size(), 1u);
  EXPECT_EQ(repaired.mesh.positions[2], (Point3f{1, 1, next}));
}

TEST(Repair, KeepsSeamsAndSmoothMeshesEqualAgain) {
  const TriangleMesh mesh = test::torus(16, 10, 1, 0.3, true);
  const RepairedMesh repaired = repair(test::as_soup(mesh), false);
  EXPECT_EQ(repaired.mesh.positions.size(), mesh.positions.size());  // seams: (16 + 1) · (10 + 1)
  EXPECT_EQ(repaired.mesh.triangles.size(), mesh.triangles.size());
  EXPECT_EQ(test::as_soup(repaired.mesh), test::as_soup(mesh));
}

TEST(Repair, FaceAttributesGoWithTheirTriangles) {
  TriangleMesh mesh = test::sphere(1);
  mesh.triangles.insert(mesh.triangles.begin() + 5, {2, 2, 4});
  mesh.attributes = {{"face_number", true, 1, {}}};
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    mesh.attributes[0].values.push_back(static_cast<float>(i));
  const std::vector<float> values = repair(mesh, false).mesh.attributes[0].values;
  ASSERT_EQ(values.size(), 32u);
  EXPECT_EQ(values[4], 4);
  EXPECT_EQ(values[5], 6);
}

// The same counts as CGAL's, on soups where each point has nothing but its position.
TEST(Repair, AgreesWithCgalOnRandomSoups) {
  namespace pmp = CGAL::Polygon_mesh_processing;
  using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
  std::mt19937_64 random(5);
  std::size_t removed = 0;
  for (int soup = 0; soup < 200; ++soup) {
    TriangleMesh mesh;
    for (int i = 0; i < 40; ++i) {
      const auto coordinate = [&] { return static_cast<float>(random() % 3); };
      const float x = coordinate(), y = coordinate();
      mesh.positions.push_back({x, y, x * x + y * y});  // on a paraboloid: no three on a line
    }
    for (int i = 0; i < 60; ++i) {
      const auto vertex = [&] { return static_cast<std::uint32_t>(random() % 40); };
      const std::uint32_t a = vertex(), b = vertex();
      mesh.triangles.push_back({a, b, vertex()});
    }
    std::vector<Point> points;
    std::vector<std::vector<std::size_t>> polygons;
    for (const Point3f p : mesh.positions) points.emplace_back(p.x, p.y, p.z);
    for (const auto& [a, b, c] : mesh.triangles) polygons.push_back({a, b, c});
    pmp::repair_polygon_soup(points, polygons);
    const RepairedMesh repaired = repair(mesh, false);
    EXPECT_EQ(repaired.mesh.positions.size(), points.size());
    EXPECT_EQ(repaired.mesh.triangles.size(), polygons.size());
    removed += repaired.degenerate_triangles + repaired.duplicate_triangles;
  }
  EXPECT_GT(removed, 200u);
}

}  // namespace
}  // namespace vitrail::repair_test
