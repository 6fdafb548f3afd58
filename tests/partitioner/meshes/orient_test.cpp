// SPDX-License-Identifier: Apache-2.0
#include "partitioner/meshes/orient.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "partitioner/meshes/exact.h"
#include "tests/partitioner/meshes/shapes.h"

namespace vitrail::orient_test {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

// Each turned so that its least corner is first.
Triangles canonical(Triangles triangles) {
  for (auto& t : triangles) std::rotate(t.begin(), std::ranges::min_element(t), t.end());
  return triangles;
}

TEST(Orient, TurnsClosedSurfacesOutwards) {
  for (const TriangleMesh& sound :
       {test::sphere(3), test::torus(40, 20), test::sphere(2, 1e-6, {1e-3, 0, 2e-5})})
    for (std::uint64_t seed = 1; seed < 6; ++seed) {
      TriangleMesh mesh = sound;
      test::turn_at_random(mesh, seed);
      std::size_t wrong = 0;
      for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        wrong += mesh.triangles[i] != sound.triangles[i];
      const OrientedMesh outward = orient(mesh, Facing::outward), inward = orient(mesh, Facing::inward);
      EXPECT_EQ(canonical(outward.mesh.triangles), canonical(sound.triangles));
      EXPECT_EQ(outward.turned_triangles, wrong);
      EXPECT_EQ(outward.components, 1u);
      EXPECT_EQ(outward.closed_components, 1u);
      EXPECT_EQ(canonical(inward.mesh.triangles), canonical(test::turned(sound).triangles));
    }
}

TEST(Orient, ShellsInShellsBoundHollows) {
  TriangleMesh mesh;
  for (const double radius : {3., 1., 2.}) test::append(mesh, test::sphere(2, radius));
  test::append(mesh,
               test::sphere(2, 0.5, {1.6, 0, 0}));  // pierces that of radius 2: in none but the outermost
  test::append(mesh, test::sphere(2, 1, {10, 0, 0}));
  test::turn_at_random(mesh, 3);
  const OrientedMesh oriented = orient(mesh, Facing::outward);
  EXPECT_EQ(oriented.components, 5u);
  EXPECT_EQ(oriented.inner_components, 2u);
  const auto volume = [&](std::size_t part) {
    TriangleMesh one = oriented.mesh;
    const auto n = static_cast<std::ptrdiff_t>(mesh.triangles.size() / 5);
    const auto first = oriented.mesh.triangles.begin() + static_cast<std::ptrdiff_t>(part) * n;
    one.triangles.assign(first, first + n);
    return test::volume6(one);
  };
  EXPECT_GT(volume(0), 0);  // outermost
  EXPECT_GT(volume(1), 0);  // in two
  EXPECT_LT(volume(2), 0);  // in one
  EXPECT_LT(volume(3), 0);  // in one, and not wholly in another
  EXPECT_GT(volume(4), 0);
}

TEST(Orient, OpenSurfacesFollowTheGreaterPart) {
  TriangleMesh mesh = test::grid(10, [](double x, double y) { return x * y; });
  const TriangleMesh sound = mesh;
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3)
    std::swap(mesh.triangles[i][0], mesh.triangles[i][1]);
  const OrientedMesh oriented = orient(mesh, Facing::outward);
  EXPECT_EQ(canonical(oriented.mesh.triangles), canonical(sound.triangles));
  EXPECT_EQ(oriented.turned_triangles, 67u);
  EXPECT_EQ(oriented.closed_components, 0u);
}

TEST(Orient, WhatShinesKeepsItsGreaterSide) {
  TriangleMesh mesh = test::turned(test::sphere(2));
  for (std::size_t i = 0; i < 20; ++i) std::swap(mesh.triangles[5 * i][1], mesh.triangles[5 * i][2]);
  EXPECT_EQ(canonical(orient(mesh, Facing::consistent).mesh.triangles),
            canonical(test::turned(test::sphere(2)).triangles));
}

TEST(Orient, NormalsFollowAndVerticesThatFaceBothWaysAreDoubled) {
  TriangleMesh mesh = test::sphere(3);
  for (const Point3f p : mesh.positions) mesh.normals.push_back({-p.x, -p.y, -p.z});
  test::turn_at_random(mesh, 9);
  const OrientedMesh oriented = orient(mesh, Facing::outward);
  EXPECT_EQ(oriented.mesh.positions.size(), mesh.positions.size());
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    EXPECT_EQ(oriented.mesh.normals[v], -mesh.normals[v]);

  TriangleMesh card;  // one side after the other, over the same vertices
  card.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1}};
  card.normals.assign(4, {0, 0, 1});
  card.triangles = {{0, 1, 2}, {0, 2, 1}, {1, 3, 2}};  // three at one edge do not decide on one another
  const OrientedMesh doubled = orient(card, Facing::consistent);
  EXPECT_EQ(doubled.mesh.positions.size(), 7u);
  EXPECT_EQ(doubled.mesh.normals[doubled.mesh.triangles[1][0]], (Normal3f{0, 0, -1}));
  EXPECT_EQ(doubled.mesh.normals[doubled.mesh.triangles[0][0]], (Normal3f{0, 0, 1}));
}

TEST(Orient, AMoebiusStripIsCutSomewhere) {
  TriangleMesh mesh;
  constexpr std::uint32_t n = 24;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double u = 2 * std::numbers::pi * i / n;
    for (const double s : {-0.3, 0.3}) {
      const double r = 1 + s * std::cos(u / 2);
      mesh.positions.push_back(cast<float>(Point3d{r * std::cos(u), r * std::sin(u), s * std::sin(u / 2)}));
    }
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t a = 2 * i, b = a + 1, c = i + 1 < n ? a + 2 : 1, d = i + 1 < n ? a + 3 : 0;
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({b, d, c});
  }
  const OrientedMesh oriented = orient(mesh, Facing::outward);
  EXPECT_EQ(oriented.mesh.triangles.size(), mesh.triangles.size());
  EXPECT_EQ(oriented.closed_components, 0u);
}

TEST(Exact, VolumesOfAlmostNothingHaveASign) {
  TriangleMesh mesh;  // a tetrahedron, flat up to one rounding
  const float next = std::nextafter(1.f, 0.f);
  mesh.positions = {{1, 1, 1}, {4096, 1, 1}, {1, 4096, 1}, {1024, 1024, next}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
  EXPECT_EQ(volume_sign(mesh, {0, 1, 2, 3}), 1);
  EXPECT_EQ(volume_sign(test::turned(mesh), {0, 1, 2, 3}), -1);
  mesh.positions[3].z = 1;
  EXPECT_EQ(volume_sign(mesh, {0, 1, 2, 3}), 0);
}

}  // namespace
}  // namespace vitrail::orient_test
