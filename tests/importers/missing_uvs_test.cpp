// SPDX-License-Identifier: Apache-2.0
// A mesh without (u,v) looks the same in every format that knows textures: what one renderer makes of it is
// written out where another would make something else of it, and where it shows.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "importers/export.h"
#include "importers/import.h"
#include "scene/shapes/mesh_uv.h"
#include "tests/importers/temporary_folder.h"

namespace vitrail::missing_uvs_test {
namespace {

constexpr MissingUv all_rules[] = {MissingUv::pbrt,           MissingUv::pbrt_turned, MissingUv::patches,
                                   MissingUv::patches_turned, MissingUv::barycentric, MissingUv::zero};

// Four triangles of a square, with attributes of their own where `textured`.
Scene scene_with(MissingUv rule, bool textured) {
  Scene scene;
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 0.5f}};
  mesh.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  mesh.missing_uv = rule;
  scene.meshes.push_back(mesh);
  DiffuseMaterial diffuse;
  if (textured) {
    Texture texture;
    texture.model = CheckerboardTexture{ConstantSpectrum{0.2f}, ConstantSpectrum{0.8f}, UvMapping{}};
    scene.textures.push_back(texture);
    diffuse.reflectance = Id<Texture>{0};
  }
  scene.materials.push_back({diffuse});
  Shape shape;
  shape.mesh = {0};
  shape.material = {0};
  scene.shapes.push_back(shape);
  return scene;
}

using Corner = std::array<float, 5>;

// What each triangle has at its corners, wherever it begins.
std::multiset<std::set<Corner>> corners(const TriangleMesh& mesh) {
  std::multiset<std::set<Corner>> all;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    std::set<Corner> triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      const Point3f p = mesh.positions[mesh.triangles[i][k]];
      const Point2f uv = uvs_of(mesh, i)[k];
      triangle.insert({p.x, p.y, p.z, uv.x, uv.y});
    }
    all.insert(triangle);
  }
  return all;
}

Scene written_and_read(const Scene& scene, const std::string& name) {
  const TemporaryFolder folder;
  export_scene(scene, folder / name);
  return import_scene(folder / name).scene;
}

TEST(MissingUvs, StayWhatTheyAreInOtherFormats) {
  for (const char* const name : {"out.pbrt", "out.xml", "out.obj"})
    for (const MissingUv rule : all_rules) {
      const Scene scene = scene_with(rule, true);
      const Scene again = written_and_read(scene, name);
      EXPECT_EQ(corners(scene.meshes[0]), corners(again.meshes.at(0)))
          << name << " " << static_cast<int>(rule);
    }
}

// What a format makes of them by itself is not written, nor what no texture looks up.
TEST(MissingUvs, AreWrittenOnlyWhereTheyShow) {
  const auto has_uvs = [](const Scene& scene) { return !scene.meshes.at(0).uvs.empty(); };
  EXPECT_FALSE(has_uvs(written_and_read(scene_with(MissingUv::pbrt, true), "out.pbrt")));
  EXPECT_FALSE(has_uvs(written_and_read(scene_with(MissingUv::barycentric, true), "out.xml")));
  EXPECT_FALSE(has_uvs(written_and_read(scene_with(MissingUv::zero, true), "out.obj")));
  for (const char* const name : {"out.pbrt", "out.xml", "out.obj"})
    for (const MissingUv rule : all_rules) {
      const Scene again = written_and_read(scene_with(rule, false), name);
      EXPECT_FALSE(has_uvs(again)) << name;
      EXPECT_EQ(again.meshes.at(0).positions.size(), 5u) << name;
    }
}

TEST(MissingUvs, OfPovRayAreTwoTriangles) {
  const TemporaryFolder folder;
  export_scene(scene_with(MissingUv::barycentric, true), folder / "out.pov");
  std::ifstream file(folder / "out.pov");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  EXPECT_NE(text.find("uv_vectors { 6, <0,0>, <1,0>, <0,1>, <0,0>, <1,0>, <0,1> }"), std::string::npos)
      << text;
}

TEST(MissingUvs, TurningATriangleKeepsThem) {
  for (const MissingUv rule : all_rules) {
    const TriangleMesh mesh = scene_with(rule, true).meshes[0];
    TriangleMesh turned = mesh;
    turn_round(turned);
    EXPECT_EQ(corners(mesh), corners(turned)) << static_cast<int>(rule);
    EXPECT_EQ(corners(mesh), corners(with_uvs(mesh))) << static_cast<int>(rule);
  }
}

}  // namespace
}  // namespace vitrail::missing_uvs_test
