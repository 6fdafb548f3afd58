// SPDX-License-Identifier: Apache-2.0
#include "importers/writing/write_ply.h"

#include <gmock/gmock.h>

#include <limits>

#include "importers/ply/read/ply.h"
#include "importers/ply/write/write_ply_scene.h"
#include "tests/importers/temporary_folder.h"

namespace vitrail::write_ply_test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using Triangle = std::array<std::uint32_t, 3>;

class WritePly : public testing::Test {
 protected:
  TriangleMesh again(const TriangleMesh& mesh) {
    write_ply(mesh, folder_ / "m.ply");
    return read_ply(folder_ / "m.ply");
  }
  TriangleMesh merged(const Scene& scene) {
    diagnostics_ = write_ply_scene(scene, folder_ / "s.ply");
    return read_ply(folder_ / "s.ply");
  }
  static auto says(const std::string& text) { return Contains(Field(&Diagnostic::message, HasSubstr(text))); }

  static TriangleMesh triangle() {
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}};
    return mesh;
  }
  static void add(Scene& scene, const TriangleMesh& mesh, const Transform& to_world = {}) {
    Shape shape;
    shape.mesh = {static_cast<std::uint32_t>(scene.meshes.size())};
    shape.object_to_world = to_world;
    scene.meshes.push_back(mesh);
    scene.shapes.push_back(shape);
    if (scene.materials.empty()) scene.materials.push_back(Material{DiffuseMaterial{}});
  }

  TemporaryFolder folder_;
  Diagnostics diagnostics_;
};

TEST_F(WritePly, MeshesStayBitForBit) {
  TriangleMesh mesh = triangle();
  mesh.positions[1] = {.1f, std::numeric_limits<float>::denorm_min(), -std::numeric_limits<float>::max()};
  EXPECT_EQ(again(mesh), mesh);
  mesh.normals = {{0, 0, 1}, {.1f, .2f, 1e-20f}, {0, 0, 0}};
  EXPECT_EQ(again(mesh), mesh);
  mesh.uvs = {{0, 0}, {.1f, -7}, {1e10f, 1}};
  EXPECT_EQ(again(mesh), mesh);
  mesh.normals.clear();
  EXPECT_EQ(again(mesh), mesh);
  EXPECT_EQ(again({}), TriangleMesh{});
}

TEST_F(WritePly, ManyVerticesAndLargeIndices) {
  TriangleMesh mesh;
  for (int i = 0; i < 200000; ++i) mesh.positions.push_back({static_cast<float>(i), 1, 2});
  for (std::uint32_t i = 0; i + 2 < 200000; i += 3) mesh.triangles.push_back({i, i + 2, 199999 - i});
  EXPECT_EQ(again(mesh), mesh);
}

TEST_F(WritePly, ScenesAreMergedInWorldSpace) {
  Scene scene;
  add(scene, triangle());
  add(scene, triangle(), translate({0, 0, 3}));
  scene.shapes[1].flip_orientation = true;
  const TriangleMesh mesh = merged(scene);
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{3, 5, 4}));
  EXPECT_EQ(mesh.positions[4], (Point3f{1, 0, 3}));
  EXPECT_THAT(mesh.normals, IsEmpty());
  EXPECT_THAT(diagnostics_, says("2 shapes"));
  EXPECT_THAT(diagnostics_, says("material"));
}

TEST_F(WritePly, FlatShapesStayFlatBesideSmoothOnes) {
  Scene scene;
  TriangleMesh smooth = triangle(), flat = triangle();
  smooth.normals = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  flat.positions.push_back({0, 0, 1});
  flat.triangles.push_back({0, 2, 3});
  flat.uvs = {{0, 0}, {0, 1}, {1, 0}, {1, 1}};
  add(scene, smooth, scale({1, 1, 2}));
  add(scene, flat);
  const TriangleMesh mesh = merged(scene);
  ASSERT_THAT(mesh.positions, SizeIs(9));
  EXPECT_EQ(mesh.normals[2], (Normal3f{0, 0, 1}));
  EXPECT_EQ(mesh.normals[3], (Normal3f{0, 0, 1}));
  EXPECT_EQ(mesh.normals[6], (Normal3f{1, 0, 0}));
  EXPECT_EQ(mesh.uvs[0], (Point2f{}));
  EXPECT_EQ(mesh.uvs[8], (Point2f{1, 1}));
}

TEST_F(WritePly, QuadricsAreWrittenAsTriangles) {
  Scene scene;
  TriangleMesh disk;
  disk.quadric = Quadric{.kind = QuadricKind::disk, .low = 0};
  add(scene, triangle());
  add(scene, disk, translate({0, 0, 3}));
  const TriangleMesh mesh = merged(scene);
  EXPECT_THAT(diagnostics_, says("a disk becomes triangles, 256 for a full turn"));
  ASSERT_THAT(mesh.triangles, SizeIs(1 + 256));
  EXPECT_EQ(mesh.normals.back(), (Normal3f{0, 0, 1})) << "they are smooth";
  EXPECT_EQ(mesh.positions.back().z, 3);
}

TEST_F(WritePly, OneShapeAndItsMesh) {
  Scene scene;
  TriangleMesh mesh = triangle();
  mesh.normals = {{1, 0, 0}, {0, 3, 0}, {0, 0, 1}};
  add(scene, mesh);
  EXPECT_EQ(merged(scene), mesh);
  scene.shapes[0].object_to_world = translate({1e6, 0, 0});
  merged(scene);
  EXPECT_THAT(diagnostics_, says("far from the origin"));
}

TEST_F(WritePly, InstancesAndEmptyScenes) {
  Scene scene;
  add(scene, triangle());
  scene.prototypes.push_back({"p", scene.shapes});
  scene.shapes.clear();
  scene.instances.push_back({{0}, scale({-1, 1, 1})});
  EXPECT_THAT(merged(scene).triangles, ElementsAre(Triangle{0, 2, 1}));  // its front stays its front
  EXPECT_THAT(diagnostics_, says("instances"));
  EXPECT_EQ(merged(Scene{}), TriangleMesh{});
}

}  // namespace
}  // namespace vitrail::write_ply_test
