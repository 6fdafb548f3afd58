// SPDX-License-Identifier: Apache-2.0
// Nodes, meshes and accessors of glTF.
#include <cmath>
#include <numbers>

#include "scene/shapes/deferred_mesh.h"
#include "tests/importers/gltf/gltf_text.h"

namespace vitrail::test::gltf_geometry_test {
namespace {

std::vector<Point3f> world_corners(const Scene& scene, const Shape& shape) {
  std::vector<Point3f> out;
  const TriangleMesh& mesh = scene.meshes.at(shape.mesh.value);
  for (const auto& t : mesh.triangles)
    for (const std::uint32_t i : t)
      out.push_back(cast<float>(transform_point(shape.object_to_world, cast<double>(mesh.positions[i]))));
  return out;
}

void expect_near(Point3f a, Point3f b) {
  EXPECT_NEAR(a.x, b.x, 1e-6f);
  EXPECT_NEAR(a.y, b.y, 1e-6f);
  EXPECT_NEAR(a.z, b.z, 1e-6f);
}

TEST(GltfGeometry, NodesStandInTheirParents) {
  GltfText file;
  file.add_square();
  // The child is moved by (1,0,0), turned by 90° about y with its parent, scaled by 2, moved by (0,3,0).
  const double h = std::sqrt(0.5);
  const ImportedScene imported = read_text(file.text(
      square_mesh +
      R"(,"scenes":[{"nodes":[1]}],"nodes":[{"mesh":0,"translation":[1,0,0]},{"children":[0],)" +
      fmt::format(R"("translation":[0,3,0],"rotation":[0,{},0,{}],"scale":[2,2,2]}}],"materials":[{{}}])", h,
                  h)));
  ASSERT_EQ(imported.scene.shapes.size(), 1u);
  EXPECT_FALSE(imported.scene.shapes[0].flip_orientation);
  // (−1,0,1) → (0,0,1) → (1,0,0)·… by 90° about y: (z, y, −x) = (1,0,0) → (2,0,0) → (2,3,0).
  expect_near(world_corners(imported.scene, imported.scene.shapes[0])[0], {2, 3, 0});
}

TEST(GltfGeometry, AMatrixIsGivenByColumns) {
  GltfText file;
  file.add_square();
  const ImportedScene imported = read_text(file.text(
      square_mesh +
      R"(,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"matrix":[0,1,0,0,-1,0,0,0,0,0,1,0,5,6,7,1]}],)"
      R"("materials":[{}])"));
  expect_near(world_corners(imported.scene, imported.scene.shapes.at(0))[0], {5, 5, 8});
}

TEST(GltfGeometry, MirroredNodesKeepTheirFronts) {
  GltfText file;
  file.add_square();
  const ImportedScene imported = read_text(file.text(
      square_mesh + R"(,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"scale":[-1,1,1]}],"materials":[{}])"));
  EXPECT_TRUE(imported.scene.shapes.at(0).flip_orientation);
}

TEST(GltfGeometry, MeshesOfManyNodesAreInstances) {
  GltfText file;
  file.add_square();
  const ImportedScene imported = read_text(file.text(
      square_mesh +
      R"(,"scenes":[{"nodes":[0,1]}],"nodes":[{"mesh":0},{"mesh":0,"translation":[4,0,0],"scale":[-1,1,1]}],"materials":[{}])"));
  EXPECT_EQ(imported.scene.shapes.size(), 0u);
  ASSERT_EQ(imported.scene.prototypes.size(), 1u);
  ASSERT_EQ(imported.scene.instances.size(), 2u);
  EXPECT_FALSE(imported.scene.prototypes[0].shapes.at(0).flip_orientation);
  EXPECT_EQ(imported.scene.meshes.size(), 1u);
}

TEST(GltfGeometry, InstancesOfTheExtension) {
  GltfText file;
  file.add_square();
  const int move = file.floats({1, 0, 0, 0, 2, 0, 0, 0, 3}, 3);
  const int turn = file.numbers<std::int8_t>({0, 0, 0, 127, 127, 0, 0, 0, 0, 0, 0, 127}, 5120, "VEC4", 4,
                                             ",\"normalized\":true");
  const ImportedScene imported = read_text(file.text(
      square_mesh +
      R"(,"scenes":[{"nodes":[0]}],"materials":[{}],"extensionsUsed":["EXT_mesh_gpu_instancing"],"nodes":[{"mesh":0,"extensions":)" +
      fmt::format(R"({{"EXT_mesh_gpu_instancing":{{"attributes":{{"TRANSLATION":{},"ROTATION":{}}}}}}}}}])",
                  move, turn)));
  ASSERT_EQ(imported.scene.instances.size(), 3u);
  const Transform& second = imported.scene.instances[1].prototype_to_world;  // half a turn about x
  EXPECT_NEAR(second.m[1][1], -1, 1e-6);
  EXPECT_NEAR(second.m[1][3], 2, 1e-6);
}

TEST(GltfGeometry, StripsAndFansWindAsTriangles) {
  for (const auto& [mode, expected] :
       {std::pair{5, std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}},
        {6, std::vector<std::array<std::uint32_t, 3>>{{1, 2, 0}, {2, 3, 0}, {3, 4, 0}}}}) {
    GltfText file;
    file.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0}, 3);
    const ImportedScene imported = read_text(file.text(
        fmt::format(R"("meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"mode":{}}}]}}],)", mode) +
        one_node));
    ASSERT_EQ(imported.scene.meshes.size(), 1u);
    EXPECT_EQ(imported.scene.meshes[0].triangles, expected) << mode;
    EXPECT_TRUE(imported.scene.meshes[0].normals.empty()) << "flat";
  }
}

TEST(GltfGeometry, PointsAndLinesAreReported) {
  GltfText file;
  file.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, 3);
  const ImportedScene imported = read_text(file.text(
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"mode":1},{"attributes":{"POSITION":0},"mode":0}]}],)" +
      one_node));
  EXPECT_TRUE(imported.scene.shapes.empty());
  EXPECT_TRUE(mentions(imported.diagnostics, "lines"));
  EXPECT_TRUE(mentions(imported.diagnostics, "points"));
}

TEST(GltfGeometry, QuantizedAndSparseAccessors) {
  GltfText file;
  file.numbers<std::int16_t>({-32768, 0, 32767, 0, 0, 32767, 0, 0, 32767, 0, 0, 0}, 5122, "VEC3", 4,
                             ",\"normalized\":true");
  // Rows of 8 bytes: three numbers and one to fill.
  file.views.pop_back();
  file.views += ",\"byteStride\":8}";
  file.accessors = R"({"bufferView":0,"componentType":5122,"type":"VEC3","count":3,"normalized":true})";
  const int at = file.view(std::string("\2", 1)), values = file.view(std::string(12, '\0'));
  file.accessor(fmt::format(
      R"("bufferView":0,"componentType":5122,"type":"VEC3","count":3,"normalized":true,"sparse":{{"count":1,"indices":{{"bufferView":{},"componentType":5121}},"values":{{"bufferView":{}}}}})",
      at, values));
  for (const auto& [accessor, third] : {std::pair{0, Point3f{1, 0, 0}}, {1, Point3f{0, 0, 0}}}) {
    const ImportedScene imported = read_text(file.text(
        fmt::format(R"("meshes":[{{"primitives":[{{"attributes":{{"POSITION":{}}}}}]}}],)", accessor) +
        one_node));
    const auto& p = imported.scene.meshes.at(0).positions;
    EXPECT_EQ(p.at(0), (Point3f{-1, 0, 1})) << "-32768 is held at -1";
    EXPECT_EQ(p.at(2), third);
  }
}

TEST(GltfGeometry, MorphsAndSkinsAreBentAsTheyStand) {
  GltfText file;
  const int position = file.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, 3);
  const int delta = file.floats({0, 0, 4, 0, 0, 4, 0, 0, 4}, 3);
  const int joints = file.numbers<std::uint8_t>({0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, 5121, "VEC4", 4);
  const int weights = file.floats({1, 0, 0, 0, .5f, .5f, 0, 0, 0, 1, 0, 0}, 4);
  const ImportedScene morphed = read_text(file.text(
      fmt::format(
          R"("meshes":[{{"weights":[0.25],"primitives":[{{"attributes":{{"POSITION":{}}},"targets":[{{"POSITION":{}}}]}}]}}],)",
          position, delta) +
      one_node));
  EXPECT_EQ(morphed.scene.meshes.at(0).positions.at(1), (Point3f{1, 0, 1}));
  const ImportedScene skinned = read_text(file.text(
      fmt::format(
          R"("meshes":[{{"primitives":[{{"attributes":{{"POSITION":{},"JOINTS_0":{},"WEIGHTS_0":{}}}}}]}}],)",
          position, joints, weights) +
      R"("skins":[{"joints":[1,2]}],"scenes":[{"nodes":[0,1,2]}],"nodes":[{"mesh":0,"skin":0,"translation":[9,9,9]},)"
      R"({"translation":[0,0,1]},{"translation":[0,0,3]}])"));
  const auto& p = skinned.scene.meshes.at(0).positions;
  expect_near(p.at(0), {0, 0, 1});
  expect_near(p.at(1), {1, 0, 2});
  expect_near(p.at(2), {0, 1, 3});
  EXPECT_EQ(skinned.scene.shapes.at(0).object_to_world, Transform{}) << "its node does not count";
}

TEST(GltfGeometry, TheFirstCameraOrTheOneThatIsAskedFor) {
  GltfText file;
  const std::string text = file.text(
      R"("cameras":[{"type":"perspective","perspective":{"yfov":1,"aspectRatio":2,"znear":0.1}},)"
      R"({"type":"orthographic","orthographic":{"xmag":2,"ymag":4,"znear":0,"zfar":1}}],)"
      R"("scenes":[{"nodes":[0,1]}],"nodes":[{"camera":0,"translation":[1,2,3],"scale":[5,5,5]},{"camera":1}])");
  const ImportedScene first = read_text(text);
  const auto& p = std::get<PerspectiveCamera>(first.scene.camera);
  EXPECT_NEAR(p.screen.y1, std::tan(0.5), 1e-12);
  EXPECT_NEAR(p.screen.x1, 2 * std::tan(0.5), 1e-12);
  EXPECT_EQ(first.scene.film.width, 1280);
  EXPECT_EQ(first.scene.film.height, 640);
  const Vector3d ahead = transform_vector(p.camera_to_world, {0, 0, 1});
  EXPECT_NEAR(ahead.z, -1, 1e-12) << "along −z, without the node's scale";
  EXPECT_NEAR(transform_vector(p.camera_to_world, {1, 0, 0}).x, 1, 1e-12);
  EXPECT_EQ(p.camera_to_world.m[0][3], 1);
  ImportOptions second;
  second.camera = 1;
  const ImportedScene other = read_text(text, second);
  EXPECT_NEAR(std::get<OrthographicCamera>(other.scene.camera).screen.y1, 4, 1e-12);
  EXPECT_EQ(other.scene.film.width, 640);
  second.camera = 2;
  EXPECT_THROW(read_text(text, second), UsageError);
}

}  // namespace
}  // namespace vitrail::test::gltf_geometry_test
