// SPDX-License-Identifier: Apache-2.0
// What a format cannot say of how textures are laid out is in the (u,v) of meshes.
#include "importers/writing/mapped_uvs.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "importers/obj/write/write_obj.h"
#include "importers/pbrt/write/write_pbrt.h"
#include "scene/models/texture_mapping.h"
#include "scene/shapes/deferred_mesh.h"
#include "tests/importers/temporary_folder.h"
#include "tests/importers/written_scenes.h"

namespace vitrail::mapped_uvs_test {
namespace {

bool nothing(const TextureMapping&) { return false; }
bool by_uv(const TextureMapping& m) { return std::holds_alternative<UvMapping>(m); }

Scene scene_with(const TextureMapping& mapping) {
  ImageTexture image;
  image.filename = "none.png";
  image.mapping = mapping;
  Scene scene = square_scene(Material{DiffuseMaterial{Id<Texture>{0}}});
  scene.textures = {Texture{image, false, "t", {}}};
  return scene;
}
const TextureMapping& mapping_of(const Scene& scene) {
  return std::get<ImageTexture>(scene.textures.at(0).model).mapping;
}
const TriangleMesh& mesh_of(const MappedUvs& mapped) {
  return mapped.scene.meshes.at(mapped.scene.shapes.at(0).mesh.value);
}

TEST(MappedUvs, TurnedOnesAreThoseOfTheMesh) {
  const UvMapping turned{0, 2, 0.25f, -1, 0.5f, 1};
  const Scene scene = scene_with(turned);
  const auto mapped = with_mapped_uvs(scene, is_unturned);
  ASSERT_TRUE(mapped);
  EXPECT_EQ(mapping_of(mapped->scene), TextureMapping{UvMapping{}});
  for (std::size_t i = 0; i < 4; ++i) {
    const Point2f from = scene.meshes[0].uvs[i];
    EXPECT_EQ(mesh_of(*mapped).uvs[i], (Point2f{2 * from.y + 0.25f, -from.x + 0.5f * from.y + 1}));
  }
  EXPECT_TRUE(mapped->notes.empty());
  EXPECT_FALSE(with_mapped_uvs(scene, by_uv)) << "kept";
  EXPECT_FALSE(with_mapped_uvs(scene_with(UvMapping{2, 0, 1, 0, 3, 0}), is_unturned));
}

TEST(MappedUvs, OfAPlaneAreItsNumbers) {
  const PlanarMapping plane{translate({1, 0, 0}), {1, 0.5, 0}, {0, 0, 2}, 0.25, 0.75};
  Scene scene = scene_with(plane);
  scene.shapes[0].object_to_world = rotate(0.5, {1, 0, 0});
  const auto mapped = with_mapped_uvs(scene, by_uv);
  ASSERT_TRUE(mapped);
  for (std::size_t i = 0; i < 4; ++i) {
    const Point3d p =
        transform_point(scene.shapes[0].object_to_world, cast<double>(scene.meshes[0].positions[i]));
    EXPECT_NEAR(mesh_of(*mapped).uvs[i].x, p.x - 1 + 0.5 * p.y + 0.25, 1e-6);
    EXPECT_NEAR(mesh_of(*mapped).uvs[i].y, 2 * p.z + 0.75, 1e-6);
  }
  EXPECT_TRUE(mapped->notes.empty());
}

// Linear on each triangle, within 1/250 of the image, over the seam too.
TEST(MappedUvs, AroundAnAxisAreThoseOfSmallTriangles) {
  for (const TextureMapping& mapping :
       {TextureMapping{SphericalMapping{translate({0.1, 0.2, 0.3})}}, TextureMapping{CylindricalMapping{}},
        TextureMapping{CylindricalMapping{translate({0.1, 0, 0}), true}},
        TextureMapping{GlobeMapping{rotate(1, {1, 1, 0})}}}) {
    Scene scene = scene_with(mapping);
    TriangleMesh ball;
    ball.quadric = Quadric{QuadricKind::sphere};
    scene.meshes[0] = ball;
    const auto mapped = with_mapped_uvs(scene, by_uv);
    ASSERT_TRUE(mapped);
    EXPECT_THAT(mapped->notes, testing::SizeIs(1));
    PreparedMapping prepared{mapping, {}};
    std::visit(
        [&](const auto& m) {
          if constexpr (requires { m.texture_to_world; })
            prepared.world_to_texture = inverse(m.texture_to_world);
        },
        mapping);
    const TriangleMesh& mesh = mesh_of(*mapped);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(0.1, 0.9);
    double worst = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 17) {
      double a = number(random), b = number(random);
      if (a + b > 1) a = 1 - a, b = 1 - b;
      Vector3d p{};
      Point2d uv{};
      for (std::size_t k = 0; k < 3; ++k) {
        const double share = k == 0 ? 1 - a - b : k == 1 ? a : b;
        p = p + (cast<double>(mesh.positions[mesh.triangles[i][k]]) - Point3d{}) * share;
        uv.x += share * mesh.uvs[mesh.triangles[i][k]].x, uv.y += share * mesh.uvs[mesh.triangles[i][k]].y;
      }
      const MappedPoint m = map_point(prepared, {}, Point3d{} + p);
      const auto off = [](double x) { return std::abs(x - std::round(x)); };
      const Point3d q = transform_point(prepared.world_to_texture, Point3d{} + p);
      if (std::hypot(q.x, q.y) < 0.05) continue;  // at its poles the image turns within a triangle
      worst = std::max({worst, off(m.s - uv.x), off(m.t - uv.y)});
    }
    EXPECT_LT(worst, 0.004) << mapping.index();
  }
}

TEST(MappedUvs, WhatGoesByTheDirectionOfUStays) {
  const UvMapping turned{0, 1, 0, -1, 0, 0};
  Scene scene = scene_with(turned);
  ConductorMaterial brushed;
  brushed.roughness = Roughness{Id<Texture>{0}, 0.1f};
  scene.materials[0].model = brushed;
  EXPECT_FALSE(with_mapped_uvs(scene, is_unturned));
  scene = scene_with(turned);
  scene.materials[0].normal_map = Id<Texture>{0};
  EXPECT_FALSE(with_mapped_uvs(scene, is_unturned));
}

// Another mapping on the same mesh, or a mesh that has to stay: nothing is moved.
TEST(MappedUvs, TexturesOfTwoMappingsStay) {
  Scene scene = scene_with(UvMapping{0, 1, 0, -1, 0, 0});
  ImageTexture other = std::get<ImageTexture>(scene.textures[0].model);
  other.mapping = UvMapping{};
  scene.textures.push_back(Texture{other, true, "o", {}});
  scene.materials.push_back(scene.materials[0]);
  scene.materials[1].displacement = Id<Texture>{1};
  scene.shapes.push_back(scene.shapes[0]);
  EXPECT_TRUE(with_mapped_uvs(scene, is_unturned));
  scene.shapes[1].material = {1};  // shares the turned texture with the first
  EXPECT_FALSE(with_mapped_uvs(scene, is_unturned));
  scene.materials[1] = scene.materials[0];
  scene.materials[1].normal_map = Id<Texture>{0};
  EXPECT_FALSE(with_mapped_uvs(scene, is_unturned)) << "a mesh that has to stay";
  scene.materials[1].normal_map.reset();
  EXPECT_TRUE(with_mapped_uvs(scene, is_unturned));
  scene.area_lights = {AreaLight{Id<Texture>{0}}};
  scene.shapes[1].area_light = Id<AreaLight>{0};
  EXPECT_FALSE(with_mapped_uvs(scene, is_unturned)) << "an image of a lamp";
  EXPECT_FALSE(with_mapped_uvs(scene, nothing));
}

TEST(MappedUvs, PbrtAndObjHaveThem) {
  const TemporaryFolder folder;
  const Scene scene = scene_with(UvMapping{0, 1, 0, -1, 0, 0});
  const auto says = [](const char* text) {
    return testing::Contains(testing::Field(&Diagnostic::message, testing::HasSubstr(text)));
  };
  EXPECT_THAT(write_pbrt(scene, folder / "out.pbrt"), testing::Not(says("the turn or shear")));
  EXPECT_THAT(write_obj(scene, folder / "out.obj"), testing::Not(says("the uv themselves")));
}

}  // namespace
}  // namespace vitrail::mapped_uvs_test
