// SPDX-License-Identifier: Apache-2.0
#include "scene/shapes/mesh_parts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace vitrail::mesh_parts_test {
namespace {

using testing::ElementsAre;
using PartKind = MeshPart::Kind;
using Quad = std::array<Point3f, 4>;

// Every quad has vertices of its own, as where normals differ.
TriangleMesh mesh_of(const std::vector<Quad>& quads) {
  TriangleMesh mesh;
  for (const Quad& quad : quads) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), quad.begin(), quad.end());
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
  }
  return mesh;
}

Quad turned(const Quad& q) { return {q[3], q[2], q[1], q[0]}; }

Quad pane(float z) { return {{{0, 0, z}, {2, 0, z}, {2, 1, z}, {0, 1, z}}}; }

// Outwards; the first of the faces is the upper one.
std::vector<Quad> box(float thick) {
  std::vector<Quad> faces{pane(thick), turned(pane(0))};
  const Quad low = pane(0), high = pane(thick);
  for (std::size_t i = 0; i < 4; ++i) faces.push_back({low[i], low[(i + 1) % 4], high[(i + 1) % 4], high[i]});
  return faces;
}

std::vector<MeshPart> parts(const std::vector<Quad>& quads) {
  const TriangleMesh mesh = mesh_of(quads);
  return parts_of(std::vector<PlacedMesh>{{&mesh, {}}});
}

std::vector<PartKind> kinds(const std::vector<Quad>& quads) {
  std::vector<PartKind> found;
  for (const MeshPart& part : parts(quads)) found.push_back(part.kind);
  return found;
}

std::vector<Quad> operator+(std::vector<Quad> a, const std::vector<Quad>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::vector<Quad> without_first(std::vector<Quad> quads) {
  quads.erase(quads.begin());
  return quads;
}

TEST(MeshParts, OneFaceIsOpenAndABoxIsClosed) {
  EXPECT_THAT(kinds({pane(0)}), ElementsAre(PartKind::open));
  EXPECT_THAT(kinds(box(0.006f)), ElementsAre(PartKind::closed));
  EXPECT_THAT(kinds(box(0.006f) + std::vector<Quad>{pane(1)}), ElementsAre(PartKind::closed, PartKind::open));
  EXPECT_THAT(kinds(without_first(box(1))), ElementsAre(PartKind::open));  // an aquarium
}

TEST(MeshParts, SayWhereAndHowMuch) {
  const MeshPart part = parts({pane(3)}).at(0);
  EXPECT_DOUBLE_EQ(part.area, 2);
  EXPECT_DOUBLE_EQ(part.open_area, 2);
  EXPECT_EQ(part.centre, (Point3d{1, 0.5, 3}));
  EXPECT_EQ(part.facing, (Vector3d{0, 0, 2}));
}

TEST(MeshParts, ATubeIsOpenThoughItsHolesFaceEachOther) {
  std::vector<Quad> tube = without_first(without_first(box(1)));
  EXPECT_THAT(kinds(tube), ElementsAre(PartKind::open));
}

TEST(MeshParts, CracksDoNotOpen) {
  std::vector<Quad> cracked = box(1);
  cracked[0][0].z += 1e-5f;
  EXPECT_THAT(kinds(cracked), ElementsAre(PartKind::closed));
}

TEST(MeshParts, AnEdgeOfThreeFacesIsNoRim) {
  EXPECT_THAT(kinds(box(1) + std::vector<Quad>{{{{0, 0, 0}, {2, 0, 0}, {2, -1, 0}, {0, -1, 0}}}}),
              ElementsAre(PartKind::open));  // one part, of which the fin has a rim
}

TEST(MeshParts, ADoubledFaceIsASheet) {
  const Quad quad = pane(0), back{quad[2], quad[1], quad[0], quad[3]};  // along the same diagonal
  const std::vector<MeshPart> exact = parts({quad, back});
  ASSERT_EQ(exact.size(), 1u);
  EXPECT_EQ(exact[0].kind, PartKind::open);
  EXPECT_EQ(exact[0].doubles.size(), 2u);
  EXPECT_THAT(kinds({quad, turned(quad)}), ElementsAre(PartKind::folded));  // along the other
}

TEST(MeshParts, TwoFacesBackToBackAreAPaneWithoutItsRim) {
  EXPECT_THAT(kinds({pane(0.006f), turned(pane(0))}), ElementsAre(PartKind::rimless, PartKind::rimless));
  // One behind the other, facing alike; facing each other; beside each other.
  EXPECT_THAT(kinds({pane(0.016f), pane(0)}), ElementsAre(PartKind::open, PartKind::open));
  EXPECT_THAT(kinds({turned(pane(0.006f)), pane(0)}), ElementsAre(PartKind::open, PartKind::open));
  Quad beside = turned(pane(0));
  for (Point3f& p : beside) p.x += 3;
  EXPECT_THAT(kinds({pane(0.006f), beside}), ElementsAre(PartKind::open, PartKind::open));
}

TEST(MeshParts, MeshesJoinWhereTheyStand) {
  const std::vector<Quad> faces = box(1);
  const TriangleMesh lid = mesh_of({faces[0]}), rest = mesh_of(without_first(faces));
  EXPECT_EQ(parts_of(std::vector<PlacedMesh>{{&lid, {}}, {&rest, {}}}).size(), 1u);
  EXPECT_EQ(parts_of(std::vector<PlacedMesh>{{&lid, translate({0, 0, 1})}, {&rest, {}}}).size(), 2u);
}

TEST(MeshParts, SomeTrianglesKeepTheirAttributes) {
  TriangleMesh mesh = mesh_of({pane(0), pane(1)});
  for (std::size_t i = 0; i < 8; ++i) mesh.uvs.push_back({static_cast<float>(i), 0});
  mesh.attributes.push_back({"face_a", true, 1, {10, 11, 12, 13}});
  const std::vector<std::uint32_t> kept{3};
  const TriangleMesh one = only_triangles(mesh, kept);
  EXPECT_EQ(one.positions, (std::vector<Point3f>{{0, 0, 1}, {2, 1, 1}, {0, 1, 1}}));
  EXPECT_EQ(one.uvs, (std::vector<Point2f>{{4, 0}, {6, 0}, {7, 0}}));
  EXPECT_EQ(one.attributes[0].values, std::vector<float>{13});
  // Vertices are kept once, in the order of the mesh.
  const std::vector<std::uint32_t> both{3, 0, 2};
  const TriangleMesh some = only_triangles(mesh, both);
  ASSERT_EQ(some.positions.size(), 7u);
  for (std::size_t t = 0; t < 3; ++t)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(some.uvs.at(some.triangles.at(t)[k]), mesh.uvs.at(mesh.triangles[both[t]][k])) << t;
}

}  // namespace
}  // namespace vitrail::mesh_parts_test
