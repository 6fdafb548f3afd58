// SPDX-License-Identifier: Apache-2.0
#include "partitioner/meshes/decimate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "tests/partitioner/meshes/shapes.h"

namespace vitrail::decimate_test {
namespace {

void expect_about(std::size_t triangles, double asked) {
  EXPECT_GE(static_cast<double>(triangles), 0.98 * asked - 2);
  EXPECT_LE(static_cast<double>(triangles), 1.02 * asked + 2);
}

TEST(Decimate, ClosedSurfacesStayClosedAndClose) {
  for (const TriangleMesh& mesh : {test::sphere(5), test::torus(80, 40), test::sphere(5, 1e-6, {0, 0, 3e-6})})
    for (const double fraction : {0.5, 0.1}) {
      const DecimatedMesh decimated = decimate(mesh, fraction);
      expect_about(decimated.mesh.triangles.size(), fraction * static_cast<double>(mesh.triangles.size()));
      EXPECT_TRUE(decimated.manifold);
      const auto edges = test::edges_by_triangles(decimated.mesh);
      EXPECT_EQ(edges[1] + edges[3], 0u);
      // A closed triangulation has E = 3F/2: Euler's V − E + F keeps 2 of a sphere, 0 of a torus.
      const auto euler = [](const TriangleMesh& m) {
        return static_cast<long>(m.positions.size()) - static_cast<long>(m.triangles.size()) / 2;
      };
      EXPECT_EQ(euler(decimated.mesh), euler(mesh));
    }
}

// The distance of the best triangulation by n triangles of a sphere of radius 1 is about 4.8/n (a regular
// triangle of edge e is e²/6 below its circumscribed cap).
TEST(Decimate, ErrorsAreThoseOfSoManyTriangles) {
  const TriangleMesh ball = test::sphere(5), ring = test::torus(80, 40);
  for (const double fraction : {0.5, 0.1}) {
    const TriangleMesh few = decimate(ball, fraction).mesh;
    const double best = 4.8 / static_cast<double>(few.triangles.size());
    EXPECT_LT(test::greatest_distance(ball, few), 5 * best);
    EXPECT_LT(test::greatest_distance(few, ball), 5 * best);
  }
  const TriangleMesh few = decimate(ring, 0.2).mesh;
  EXPECT_LT(test::greatest_distance(ring, few), 0.02);
  EXPECT_LT(test::greatest_distance(few, ring), 0.02);
}

TEST(Decimate, VerticesAreTheMeshesOwn) {
  TriangleMesh mesh = test::sphere(4);
  mesh.attributes = {{"vertex_number", false, 1, {}}, {"face_number", true, 1, {}}};
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    mesh.attributes[0].values.push_back(static_cast<float>(i));
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    mesh.attributes[1].values.push_back(mesh.positions[mesh.triangles[i][0]].z > 0);
  for (const Point3f p : mesh.positions) mesh.normals.push_back({p.x, p.y, p.z});
  const TriangleMesh few = decimate(mesh, 0.2).mesh;
  ASSERT_EQ(few.normals.size(), few.positions.size());
  for (std::size_t v = 0; v < few.positions.size(); ++v) {
    const auto number = static_cast<std::size_t>(few.attributes[0].values[v]);
    EXPECT_EQ(few.positions[v], mesh.positions[number]);
    EXPECT_EQ(few.normals[v], mesh.normals[number]);
  }
  // No triangle of the upper half reaches into the lower one.
  for (std::size_t i = 0; i < few.triangles.size(); ++i)
    for (const std::uint32_t v : few.triangles[i]) {
      EXPECT_GE(few.positions[v].z, few.attributes[1].values[i] > 0 ? -0.13 : -1);
    }
}

TEST(Decimate, BordersStay) {
  const TriangleMesh mesh =
      test::grid(100, [](double x, double y) { return 0.1 * std::sin(6 * x) * std::cos(5 * y); });
  const TriangleMesh few = decimate(mesh, 0.05).mesh;
  expect_about(few.triangles.size(), 1000);
  TriangleMesh border, few_border;  // as triangles without area, for greatest_distance
  const auto collect = [](const TriangleMesh& m, TriangleMesh& to) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const auto& t : m.triangles)
      for (std::size_t k = 0; k < 3; ++k) ++edges[std::minmax(t[k], t[(k + 1) % 3])];
    to.positions = m.positions;
    for (const auto& [edge, count] : edges)
      if (count == 1) to.triangles.push_back({edge.first, edge.second, edge.second});
  };
  collect(mesh, border), collect(few, few_border);
  EXPECT_LT(few_border.triangles.size(), border.triangles.size() / 2);
  EXPECT_LT(test::greatest_distance(border, few_border), 0.0011 * std::sqrt(2.1));
  EXPECT_LT(test::greatest_distance(few_border, border), 0.0011 * std::sqrt(2.1));
  EXPECT_EQ(test::edges_by_triangles(few)[3], 0u);
}

TEST(Decimate, FlatMeshesBecomeVeryFew) {
  const TriangleMesh few = decimate(test::grid(64, [](double, double) { return 0.; }), 0.001).mesh;
  EXPECT_LE(few.triangles.size(), 10u);
  double area = 0;
  for (const auto& t : few.triangles)
    area +=
        length(cross(few.positions[t[1]] - few.positions[t[0]], few.positions[t[2]] - few.positions[t[0]])) /
        2;
  EXPECT_NEAR(area, 1, 1e-6);
}

// Along a seam both sides keep the same positions, and each its own uvs.
TEST(Decimate, SeamsDoNotTear) {
  const TriangleMesh mesh = test::torus(120, 60, 1, 0.3, true);
  const TriangleMesh few = decimate(mesh, 0.1).mesh;
  expect_about(few.triangles.size(), 1440);
  const auto edges = test::edges_by_triangles(few);  // by position
  EXPECT_EQ(edges[1] + edges[3], 0u);
  std::set<std::array<float, 5>> vertices;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    vertices.insert(
        {mesh.positions[v].x, mesh.positions[v].y, mesh.positions[v].z, mesh.uvs[v].x, mesh.uvs[v].y});
  double uv_area = 0;
  for (const auto& t : few.triangles) {
    const auto uv = [&](std::size_t k) { return few.uvs[t[k]]; };
    const double area =
        ((uv(1).x - uv(0).x) * (uv(2).y - uv(0).y) - (uv(1).y - uv(0).y) * (uv(2).x - uv(0).x)) / 2;
    EXPECT_GT(area, 0);
    uv_area += area;
    for (const std::uint32_t v : t) {
      const Point3f p = few.positions[v];
      EXPECT_TRUE(vertices.contains({p.x, p.y, p.z, few.uvs[v].x, few.uvs[v].y}));
    }
  }
  EXPECT_NEAR(uv_area, 1, 1e-5);  // the image is still covered once
}

TEST(Decimate, ASoupIsOneSurface) {
  const TriangleMesh mesh = test::sphere(5), soup = test::as_soup(mesh);
  const TriangleMesh few = decimate(soup, 0.1).mesh;
  expect_about(few.triangles.size(), 0.1 * static_cast<double>(mesh.triangles.size()));
  EXPECT_EQ(test::edges_by_triangles(few)[1], 0u);
}

TEST(Decimate, FacetNormalsDoNotHoldIt) {
  TriangleMesh mesh = test::as_soup(test::sphere(5));
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vector3f n = cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]);
    mesh.normals.insert(mesh.normals.end(), 3, to_normal(n));
  }
  const TriangleMesh few = decimate(mesh, 0.1).mesh;
  expect_about(few.triangles.size(), 0.1 * static_cast<double>(mesh.triangles.size()));
  EXPECT_TRUE(few.normals.empty());
}

TEST(Decimate, BoxesStayBoxes) {
  TriangleMesh box;
  box.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};
  box.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                   {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  EXPECT_EQ(decimate(box, 0.1).mesh.triangles.size(), 12u);
}

// Whatever else is in the mesh: sheets stay parallel and rods thick.
TEST(Decimate, SmallThingsKeepTheirShape) {
  TriangleMesh pane, rod = test::torus(200, 16, 0.2, 0.02);
  for (const float x : {0.f, 1.f})
    for (const float y : {0.f, 1.f})
      for (const float z : {0.f, 0.006f}) pane.positions.push_back({x, y, z});
  pane.triangles = {{0, 1, 3}, {0, 3, 2}, {4, 7, 5}, {4, 6, 7}, {0, 4, 5}, {0, 5, 1},
                    {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}};
  TriangleMesh all = test::sphere(5, 0.5, {1.5, 0, 0});
  test::append(all, pane);
  test::append(all, rod);
  const TriangleMesh few = decimate(all, 0.05).mesh;
  EXPECT_LT(few.triangles.size(), all.triangles.size() / 5);
  EXPECT_LT(test::greatest_distance(pane, few), 1e-6);
  EXPECT_LT(test::greatest_distance(rod, few), 0.005);
}

TEST(Decimate, HoldsWhatIsNoManifold) {
  TriangleMesh mesh;  // three sheets at one edge
  for (const double slope : {-1., 0., 1.})
    test::append(mesh, test::grid(20, [&](double x, double) { return slope * x * x; }));
  const DecimatedMesh decimated = decimate(mesh, 0.3);
  EXPECT_FALSE(decimated.manifold);
  EXPECT_LT(decimated.mesh.triangles.size(), 1200u);
  std::set<float> kept;
  for (const Point3f p : decimated.mesh.positions)
    if (p.x == 0) kept.insert(p.y);
  EXPECT_EQ(kept.size(), 21u);
}

TEST(Decimate, SurvivesAnything) {
  std::mt19937_64 random(11);
  for (int i = 0; i < 300; ++i) {
    TriangleMesh mesh;
    const std::size_t vertices = 3 + random() % 12;
    for (std::size_t v = 0; v < vertices; ++v) {
      const auto coordinate = [&] { return static_cast<float>(random() % 4); };
      const float x = coordinate(), y = coordinate();
      mesh.positions.push_back({x, y, coordinate()});
      mesh.uvs.push_back({x, static_cast<float>(random() % 2)});
    }
    for (int t = 0; t < 40; ++t) {
      const auto vertex = [&] { return static_cast<std::uint32_t>(random() % vertices); };
      const std::uint32_t a = vertex(), b = vertex();
      mesh.triangles.push_back({a, b, vertex()});
    }
    const DecimatedMesh decimated = decimate(mesh, 0.25);
    EXPECT_GE(decimated.mesh.triangles.size() + decimated.degenerate, 10u);
    EXPECT_LE(decimated.mesh.triangles.size() + decimated.degenerate, 40u);
  }
  EXPECT_TRUE(decimate({}, 0.5).mesh.triangles.empty());
}

TEST(Decimate, Deterministic) {
  EXPECT_EQ(decimate(test::torus(60, 30), 0.2).mesh, decimate(test::torus(60, 30), 0.2).mesh);
}

}  // namespace
}  // namespace vitrail::decimate_test
