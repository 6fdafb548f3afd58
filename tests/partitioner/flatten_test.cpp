// SPDX-License-Identifier: Apache-2.0
#include "partitioner/placing/flatten.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/test_scenes.h"

namespace vitrail::flatten_test {

namespace {

using test::scene_of;

// One triangle in z = 0 around the origin, seen counter-clockwise from +z.
TriangleMesh triangle_facing_z() {
  return {
      .positions = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}}, .triangles = {{0, 1, 2}}, .normals = {}, .uvs = {}};
}

double facing_z(const Triangle& t) {
  return cross(cast<double>(t[1]) - cast<double>(t[0]), cast<double>(t[2]) - cast<double>(t[0])).z;
}

Transform mirror_x() { return scale({-1, 1, 1}); }

TEST(Flatten, MovesTheWorldToItsCentre) {
  Scene scene = scene_of(triangle_facing_z());
  scene.shapes[0].object_to_world = translate({1e7, -2e7, 3e7 + 0.5});
  scene.lights.emplace_back(Light{PointLight{{1e7 + 3, -2e7, 3e7}, ConstantSpectrum{1}}});
  const FlatScene flat = flatten(scene, {});
  EXPECT_EQ(flat.triangles[0], (Triangle{Point3f{-1, -1, 0.5f}, Point3f{1, -1, 0.5f}, Point3f{0, 1, 0.5f}}));
  EXPECT_EQ(flat.manifest.offset, (Vector3d{1e7, -2e7, 3e7}));
  EXPECT_EQ(std::get<PointLight>(flat.manifest.lights[0].model).position, (Point3d{3, 0, 0}));
  EXPECT_EQ(std::get<PerspectiveCamera>(flat.manifest.camera).camera_to_world, translate({-1e7, 2e7, -3e7}));
  EXPECT_EQ(flat.manifest.bounds, (Bounds3f{{-1, -1, 0.5f}, {1, 1, 0.5f}}));
  EXPECT_EQ(flat.manifest.scale, 1);
}

TEST(Flatten, WindingAloneSaysTheFront) {
  Scene scene = scene_of(triangle_facing_z());
  EXPECT_GT(facing_z(flatten(scene, {}).triangles[0]), 0);
  scene.shapes[0].flip_orientation = true;
  EXPECT_LT(facing_z(flatten(scene, {}).triangles[0]), 0);
  scene.shapes[0].object_to_world = mirror_x();  // a shape's front is what its world winding says
  EXPECT_GT(facing_z(flatten(scene, {}).triangles[0]), 0);
}

TEST(Flatten, MirroredInstanceKeepsItsFront) {
  Scene scene = scene_of(triangle_facing_z());
  scene.prototypes.push_back({"p", scene.shapes});
  scene.shapes.clear();
  scene.instances = {{Id<Prototype>{0}, {}}, {Id<Prototype>{0}, mirror_x()}};
  const FlatScene flat = flatten(scene, {});
  ASSERT_EQ(flat.triangles.size(), 2u);
  EXPECT_GT(facing_z(flat.triangles[0]), 0);
  EXPECT_GT(facing_z(flat.triangles[1]), 0);
}

TEST(Flatten, NormalsTurnToTheFront) {
  TriangleMesh mesh = triangle_facing_z();
  mesh.normals = {{0, 0.1f, -1}, {0, 0, -2}, {0.1f, 0, -1}};
  const FlatScene flat = flatten(scene_of(mesh), {});
  ASSERT_EQ(flat.normals.size(), 1u);
  EXPECT_TRUE(flat.manifest.requirements.shading_normals);
  for (const std::uint32_t code : flat.normals[0]) EXPECT_GT(decode_normal(code).z, 0.9f);
  EXPECT_LT(decode_normal(flat.normals[0][0]).y, 0);
}

// The corner that a normal belongs to moves with it when the winding is turned.
TEST(Flatten, NormalsFollowTheirCorners) {
  TriangleMesh mesh = triangle_facing_z();
  mesh.normals = {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  Scene scene = scene_of(mesh);
  scene.shapes[0].flip_orientation = true;
  const FlatScene flat = flatten(scene, {});
  for (std::size_t k = 0; k < 3; ++k) {
    const bool second = flat.triangles[0][k] == Point3f{1, -1, 0};
    EXPECT_NEAR(decode_normal(flat.normals[0][k]).x, second ? -0.7071 : 0, 1e-3);
  }
}

TEST(Flatten, ZeroNormalMeansNone) {
  TriangleMesh mesh = triangle_facing_z();
  mesh.normals = {{0, 0, 1}, {0, 0, 0}, {0, 0, 1}};
  EXPECT_EQ(flatten(scene_of(mesh), {}).normals[0], (std::array{no_normal, no_normal, no_normal}));
}

TEST(Flatten, KeepsOnlyWhatIsUsedAndMergesSurfaces) {
  Scene scene = scene_of(triangle_facing_z());
  scene.materials = {Material{InterfaceMaterial{}}, Material{DielectricMaterial{}},
                     Material{DiffuseMaterial{}}};
  scene.area_lights = {{ConstantSpectrum{1}, 1, false}, {ConstantSpectrum{2}, 1, true}};
  Shape shape = scene.shapes[0];
  shape.material = {2};
  scene.shapes = {shape, shape, shape};
  scene.shapes[2].area_light = Id<AreaLight>{1};
  const Manifest m = flatten(scene, {}).manifest;
  EXPECT_EQ(m.triangles, 3u);
  EXPECT_EQ(m.materials, std::vector<Material>{Material{DiffuseMaterial{}}});
  EXPECT_EQ(m.area_lights, (std::vector<AreaLight>{{ConstantSpectrum{2}, 1, true}}));
  EXPECT_EQ(m.surfaces, (std::vector<Surface>{{0, 0, -1}, {2, 0, 0}}));
  ASSERT_EQ(m.emissive_triangles.size(), 1u);
  EXPECT_EQ(m.emissive_triangles[0].triangle, 2u);
  EXPECT_EQ(m.requirements, Requirements{});
}

Requirements requirements_with(MaterialModel model, std::vector<Texture> textures = {}) {
  Scene scene = scene_of(triangle_facing_z());
  scene.textures = std::move(textures);
  scene.materials = {Material{std::move(model)}};
  return flatten(scene, {}).manifest.requirements;
}

TEST(Flatten, RequirementsFollowTheMaterials) {
  const DielectricMaterial prism{SellmeierSpectrum{{1, 0, 0}, {0.01, 0, 0}}};
  EXPECT_EQ(requirements_with(prism), (Requirements{.dispersion = true, .refraction = true}));
  EXPECT_EQ(requirements_with(DielectricMaterial{}), Requirements{.refraction = true});
  EXPECT_EQ(requirements_with(InterfaceMaterial{}), Requirements{.see_through = true});
  EXPECT_EQ(requirements_with(ThinDielectricMaterial{}), Requirements{.see_through = true});
  ConductorMaterial brushed;
  brushed.roughness = {0.1f, 0.3f};
  EXPECT_EQ(requirements_with(brushed), Requirements{.uv = true});
  const Texture board{CheckerboardTexture{ConstantSpectrum{0.1f}, ConstantSpectrum{0.9f}}};
  EXPECT_EQ(requirements_with(DiffuseMaterial{Id<Texture>{0}}, {board}), Requirements{.uv = true});
  Texture solid = board;
  std::get<CheckerboardTexture>(solid.model).solid = true;
  EXPECT_EQ(requirements_with(DiffuseMaterial{Id<Texture>{0}}, {solid}), Requirements{});
}

TEST(Flatten, OpacitiesAreOfSurfaces) {
  Scene scene = scene_of(triangle_facing_z());
  scene.textures = {{CheckerboardTexture{ConstantSpectrum{1}, ConstantSpectrum{0}}, true, "", {}}};
  scene.area_lights = {{ConstantSpectrum{2}}};
  scene.shapes.resize(5, scene.shapes[0]);
  scene.shapes[1].opacity = scene.shapes[2].opacity = 0.5f;
  scene.shapes[3].opacity = scene.shapes[4].opacity = Id<Texture>{0};
  scene.shapes[4].area_light = Id<AreaLight>{0};
  const Manifest m = flatten(scene, {}).manifest;
  const FloatParameter half = 0.5f, board = Id<Texture>{0};
  EXPECT_EQ(m.surfaces,
            (std::vector<Surface>{
                {0, 0, -1}, {1, 0, -1, -1, -1, half}, {3, 0, -1, -1, -1, board}, {4, 0, 0, -1, -1, board}}));
  EXPECT_EQ(m.requirements, (Requirements{.uv = true, .see_through = true}));
  EXPECT_EQ(m.emissive_opacities, std::vector<FloatParameter>{board});
  scene.shapes.resize(1);
  EXPECT_EQ(flatten(scene, {}).manifest.requirements, Requirements{});
}

TEST(Flatten, MediaStandOnTheSidesOfSurfaces) {
  Scene scene = scene_of(triangle_facing_z());
  scene.media = {Medium{}, Medium{.coefficients = NamedMedium{"nobody's"}}, Medium{}};
  scene.shapes[0].interior = Id<Medium>{2};
  scene.shapes[0].exterior = Id<Medium>{1};  // cannot be shown
  scene.camera_medium = Id<Medium>{2};
  const Manifest m = flatten(scene, {}).manifest;
  ASSERT_EQ(m.media.size(), 1u);
  EXPECT_EQ(m.surfaces, (std::vector<Surface>{{0, 0, -1, 0, -1}}));
  EXPECT_EQ(m.camera_medium, 0);
  EXPECT_TRUE(m.requirements.media);
}

TEST(Flatten, CoordinatesOfTexturesFollowTheirCorners) {
  TriangleMesh mesh = triangle_facing_z();
  mesh.uvs = {{0, 0}, {1, 0}, {0, 1}};
  Scene scene = scene_of(mesh);
  scene.shapes[0].flip_orientation = true;
  scene.textures = {Texture{CheckerboardTexture{ConstantSpectrum{0.1f}, ConstantSpectrum{0.9f}}}};
  scene.materials = {Material{DiffuseMaterial{Id<Texture>{0}}}};
  const FlatScene flat = flatten(scene, {});
  ASSERT_EQ(flat.uvs.size(), 1u);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_EQ(flat.uvs[0][k].x, (flat.triangles[0][k] == Point3f{1, -1, 0} ? 1.0f : 0.0f));
}

TEST(Flatten, RejectsWhatIsNotFinite) {
  Scene scene = scene_of(triangle_facing_z());
  scene.shapes[0].object_to_world = scale({1e300, 1, 1});
  EXPECT_THROW(flatten(scene, {}), Error);
  scene.shapes[0].object_to_world.m[1][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(flatten(scene, {}), Error);
}

TEST(Flatten, RejectsWhatCannotBeTraced) {
  Scene scene = scene_of(triangle_facing_z());
  scene.shapes[0].object_to_world = scale({1e14, 1, 1});
  EXPECT_NO_THROW(flatten(scene, {}));
  scene.shapes[0].object_to_world = scale({1, 1e16, 1});
  EXPECT_THROW(flatten(scene, {}), Error);
}

TEST(Flatten, HashSeesEveryRecord) {
  const Scene scene = scene_of(test::bumpy_torus(10));
  const std::uint64_t hash = flatten(scene, {}).manifest.scene_hash;
  EXPECT_EQ(flatten(scene, {}).manifest.scene_hash, hash);
  std::vector<Scene> others(6, scene);
  others[0].meshes[0].positions[7].x += 0.01f;
  others[1].meshes[0].normals[7].x += 0.1f;
  others[2].materials[0] = Material{DiffuseMaterial{ConstantSpectrum{0.25f}}};
  others[3].lights.emplace_back(Light{InfiniteLight{ConstantSpectrum{1}}});
  std::get<PerspectiveCamera>(others[4].camera).screen.x0 = -2;
  others[5].film.width = 1281;
  for (const Scene& other : others) EXPECT_NE(flatten(other, {}).manifest.scene_hash, hash);
}

}  // namespace

}  // namespace vitrail::flatten_test
