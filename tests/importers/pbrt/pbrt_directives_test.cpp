// SPDX-License-Identifier: Apache-2.0
// Transforms, blocks, files, objects and the order of definitions.
#include <zlib.h>

#include <numbers>

#include "scene/records/nesting.h"
#include "tests/importers/pbrt/pbrt_text.h"

namespace vitrail::pbrt_directives_test {
namespace {

void expect_near(Point3d found, Point3d expected) {
  EXPECT_NEAR(found.x, expected.x, 1e-12);
  EXPECT_NEAR(found.y, expected.y, 1e-12);
  EXPECT_NEAR(found.z, expected.z, 1e-12);
}

// Where `directives` take the point (1, 2, 3).
Point3d moved(const std::string& directives) {
  const ImportedScene imported = import_v4(directives + "\n" + triangle);
  expect_no_diagnostics(imported);
  return transform_point(imported.scene.shapes.at(0).object_to_world, {1, 2, 3});
}

TEST(PbrtTransforms, ComposeFromTheRight) {
  expect_near(moved("Translate 10 20 30"), {11, 22, 33});
  expect_near(moved("Scale 2 3 -4"), {2, 6, -12});
  expect_near(moved("Translate 10 0 0 Scale 2 2 2"), {12, 4, 6});
  expect_near(moved("Rotate 90 0 0 1"), {-2, 1, 3});
  expect_near(moved("Rotate [90 0 0 2]"), {-2, 1, 3});
  expect_near(moved("Translate 9 9 9 Identity"), {1, 2, 3});
  expect_near(moved("Translate [1 1 1]"), {2, 3, 4});
}

TEST(PbrtTransforms, MatricesAreListedByColumns) {
  const std::string matrix = "[1 0 0 0  0 1 0 0  0 0 2 0  5 6 7 1]";
  expect_near(moved("Transform " + matrix), {6, 8, 13});
  expect_near(moved("Translate 100 0 0 Transform " + matrix), {6, 8, 13});
  expect_near(moved("Translate 100 0 0 ConcatTransform " + matrix), {106, 8, 13});
}

TEST(PbrtTransforms, LookAtTakesTheWorldToTheCamera) {
  // From (0,0,-5) along +z with +y up nothing turns: right is +x.
  expect_near(moved("LookAt 0 0 -5  0 0 0  0 1 0"), {1, 2, 8});
}

TEST(PbrtTransforms, CoordinateSystemsAreRemembered) {
  expect_near(moved("Translate 1 0 0 CoordinateSystem \"here\" Identity CoordSysTransform \"here\""),
              {2, 2, 3});
  expect_near(moved("Translate 1 0 0 CoordSysTransform \"world\""), {1, 2, 3});
  const ImportedScene camera = import_text(
      "Film \"rgb\" Translate 0 0 5 Camera \"perspective\"\nWorldBegin "
      "CoordSysTransform \"camera\" " +
      triangle);
  expect_near(transform_point(camera.scene.shapes[0].object_to_world, {}), {0, 0, -5});
  EXPECT_TRUE(
      mentions(import_v4("CoordSysTransform \"wrld\" " + triangle).diagnostics, "did you mean \"world\""));
}

TEST(PbrtTransforms, WorldBeginResets) {
  const ImportedScene imported = import_text("Film \"rgb\" Scale -1 1 1\nWorldBegin " + triangle);
  EXPECT_EQ(imported.scene.shapes[0].object_to_world, Transform{});
}

// ---- Motion

const std::string moving =
    "ActiveTransform StartTime Translate 1 0 0 ActiveTransform EndTime Translate 2 0 0 "
    "ActiveTransform All Translate 10 0 0 ";

// Shapes that move together are one object, whose fronts are those of its own space.
TEST(PbrtMotion, ShapesThatMoveAreInstances) {
  const ImportedScene imported =
      import_text("TransformTimes -1 1 Film \"rgb\" WorldBegin AttributeBegin " + moving +
                  "Scale -1 1 1 ReverseOrientation " + triangle + triangle + "AttributeEnd " + triangle);
  expect_no_diagnostics(imported);
  const Scene& scene = imported.scene;
  ASSERT_EQ(scene.shapes.size(), 1u);
  ASSERT_EQ(scene.prototypes.size(), 1u);
  ASSERT_EQ(scene.prototypes[0].shapes.size(), 2u);
  EXPECT_EQ(scene.prototypes[0].shapes[1].object_to_world, Transform{});
  EXPECT_TRUE(scene.prototypes[0].shapes[1].flip_orientation);
  ASSERT_EQ(scene.instances.size(), 1u);
  ASSERT_EQ(scene.motions.size(), 1u);
  EXPECT_EQ(scene.instances[0].motion, Id<Motion>{0});
  const std::vector<Keyframe> keys{{-1, translate({11, 0, 0}) * scale({-1, 1, 1})},
                                   {1, translate({12, 0, 0}) * scale({-1, 1, 1})}};
  EXPECT_EQ(scene.motions[0].keys(), keys);
  expect_near(transform_point(scene.instances[0].prototype_to_world, {}), {11.5, 0, 0});  // at 0
  EXPECT_EQ(scene.shutter, (Shutter{0, 1}));
}

TEST(PbrtMotion, InstancesMove) {
  const ImportedScene imported =
      import_v4("ObjectBegin \"a\" " + triangle + "ObjectEnd " + moving + "ObjectInstance \"a\"");
  expect_no_diagnostics(imported);
  ASSERT_EQ(imported.scene.instances.size(), 1u);
  EXPECT_TRUE(imported.scene.instances[0].motion);
}

// Each of the two transforms of its own time, and both of what was named.
TEST(PbrtMotion, DirectivesChangeTheActiveTransforms) {
  const Scene scene = import_v4("AttributeBegin " + moving +
                                "CoordinateSystem \"here\" AttributeEnd "
                                "ActiveTransform EndTime CoordSysTransform \"here\" Identity Scale 2 2 2 " +
                                triangle)
                          .scene;
  ASSERT_EQ(scene.motions.size(), 1u);
  EXPECT_EQ(scene.motions[0].keys()[0].transform, translate({11, 0, 0}));
  EXPECT_EQ(scene.motions[0].keys()[1].transform, scale({2, 2, 2}));
}

TEST(PbrtMotion, CamerasMove) {
  const ImportedScene imported = import_text(
      "TransformTimes 0 2 ActiveTransform EndTime Translate 0 0 4 ActiveTransform All "
      "Camera \"perspective\" \"float shutteropen\" 1 \"float shutterclose\" 2 Film \"rgb\" WorldBegin " +
      triangle);
  expect_no_diagnostics(imported);
  const Scene& scene = imported.scene;
  EXPECT_EQ(scene.shutter, (Shutter{1, 2}));
  const std::vector<Keyframe> keys{{0, {}}, {2, translate({0, 0, -4})}};
  EXPECT_EQ(scene.camera_motion.keys(), keys);
  expect_near(transform_point(std::get<PerspectiveCamera>(scene.camera).camera_to_world, {}), {0, 0, -2});
}

TEST(PbrtMotion, WhatTheShutterDoesNotSeeStandsStill) {
  const std::string camera =
      "Camera \"perspective\" \"float shutteropen\" 1 \"float shutterclose\" 2 Film \"rgb\" ";
  const Scene scene = import_text(camera + "WorldBegin " + moving + triangle).scene;
  EXPECT_TRUE(scene.motions.empty());
  ASSERT_EQ(scene.shapes.size(), 1u);
  expect_near(transform_point(scene.shapes[0].object_to_world, {}), {12, 0, 0});
}

TEST(PbrtMotion, WhatIsHeldIsReported) {
  for (const char* what : {"LightSource \"point\"", "Texture \"t\" \"float\" \"wrinkled\"",
                           "MakeNamedMedium \"m\" \"string type\" \"homogeneous\""})
    EXPECT_TRUE(mentions(import_v4(moving + what).diagnostics, "as in pbrt, the start holds")) << what;
  EXPECT_TRUE(mentions(
      import_v4("ObjectBegin \"a\" " + moving + triangle + "ObjectEnd ObjectInstance \"a\"").diagnostics,
      "motion within an object"));
  const ImportedScene mirrored = import_v4("ActiveTransform EndTime Scale -1 1 1 " + triangle);
  EXPECT_TRUE(mentions(mirrored.diagnostics, "of which one mirrors"));
  EXPECT_EQ(mirrored.scene.shapes.size(), 1u);
}

TEST(PbrtMotion, LightsOfWhatMovesDoNotShine) {
  const ImportedScene imported = import_v4("AreaLightSource \"diffuse\" " + moving + triangle);
  EXPECT_TRUE(mentions(imported.diagnostics, "area lights that move do not shine"));
  EXPECT_TRUE(imported.scene.area_lights.empty());
}

// ---- Blocks
// -------------------------------------------------------------------------------------------------------

TEST(PbrtBlocks, AttributesAreRestored) {
  const Scene scene = import_v4(
                          "AttributeBegin Translate 1 0 0 ReverseOrientation Material \"interface\" "
                          "AreaLightSource \"diffuse\" "
                          "AttributeEnd " +
                          triangle)
                          .scene;
  EXPECT_EQ(scene.shapes[0].object_to_world, Transform{});
  EXPECT_FALSE(scene.shapes[0].flip_orientation);
  EXPECT_FALSE(scene.shapes[0].area_light);
  EXPECT_EQ(scene.materials[scene.shapes[0].material.value], Material{DiffuseMaterial{}});
}

TEST(PbrtBlocks, TransformEndRestoresTheTransformAloneInV3) {
  const std::string world = "TransformBegin Translate 1 0 0 ReverseOrientation TransformEnd " + triangle;
  const Shape v3 = import_v3(world).scene.shapes[0], v4 = import_v4(world).scene.shapes[0];
  EXPECT_EQ(v3.object_to_world, Transform{});
  EXPECT_EQ(v4.object_to_world, Transform{});
  EXPECT_TRUE(v3.flip_orientation);
  EXPECT_FALSE(v4.flip_orientation);
}

TEST(PbrtBlocks, AttributeSetsDefaultsThatExplicitValuesBeat) {
  const ImportedScene imported = import_v4(
      "AttributeBegin Attribute \"shape\" \"float radius\" 2 Attribute \"material\" \"float reflectance\" "
      "[.25] "
      "Attribute \"light\" \"float scale\" 3 Material \"diffuse\" "
      "Shape \"disk\" Shape \"disk\" \"float radius\" 5 LightSource \"infinite\" \"float L\" 1 AttributeEnd "
      "Shape \"disk\"");
  const auto radius = [&](std::size_t i) { return imported.scene.shapes.at(i).object_to_world.m[0][0]; };
  EXPECT_EQ(radius(0), 2);
  EXPECT_EQ(radius(1), 5);
  EXPECT_EQ(radius(2), 1);
  EXPECT_EQ(imported.scene.materials[0], Material{DiffuseMaterial{ConstantSpectrum{.25f}}});
  EXPECT_EQ(std::get<InfiniteLight>(imported.scene.lights.at(0).model).radiance,
            Spectrum{ConstantSpectrum{3}});
  EXPECT_FALSE(mentions(imported.diagnostics, "not used"));
}

TEST(PbrtBlocks, WhatFollowsWorldEndIsReported) {
  EXPECT_TRUE(
      mentions(import_text("Film \"image\" WorldBegin " + triangle + " WorldEnd WorldBegin").diagnostics,
               "another scene"));
  EXPECT_TRUE(mentions(import_text("Film \"image\" WorldBegin " + triangle).diagnostics, "no WorldEnd"));
  EXPECT_TRUE(mentions(import_v3("AttributeBegin " + triangle).diagnostics, "not closed before WorldEnd"));
}

// ---- Files
// --------------------------------------------------------------------------------------------------------

// Some of the backslashes look like escapes.
TEST(PbrtFiles, PathsOfWindows) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "parts/new");
  folder.write("parts/new/tables.pbrt", "Shape \"disk\"");
  const Scene scene = read_pbrt(folder.write("scene.pbrt",
                                             "Film \"rgb\" WorldBegin Include \"parts\\new\\tables.pbrt\" "
                                             "Include \"parts\\\\new\\\\tables.pbrt\""))
                          .scene;
  EXPECT_EQ(scene.shapes.size(), 2u);
}

TEST(PbrtFiles, IncludesAreTextualAndRelativeToTheMainFile) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "a");
  folder.write("a/outer.pbrt", "Translate 1 0 0 Include \"a/inner.pbrt\" Shape \"disk\"");
  folder.write("a/inner.pbrt", "Translate 2 0 0");
  const Scene scene = read_pbrt(folder.write("main.pbrt",
                                             "Film \"rgb\" WorldBegin Include \"a/outer.pbrt\" "
                                             "\"float radius\" 7 " +
                                                 triangle))
                          .scene;
  ASSERT_EQ(scene.shapes.size(), 2u);
  expect_near(transform_point(scene.shapes[1].object_to_world, {}), {3, 0, 0});
  EXPECT_EQ(scene.shapes[0].object_to_world.m[0][0], 7) << "a list of parameters may go on after an include";
}

TEST(PbrtFiles, ImportsDoNotLeakTheirState) {
  const TemporaryFolder folder;
  folder.write("part.pbrt",
               "Translate 1 0 0 MakeNamedMaterial \"m\" \"string type\" \"interface\" " + triangle);
  const Scene scene = read_pbrt(folder.write("main.pbrt",
                                             "Film \"rgb\" WorldBegin Translate 0 5 0 Import \"part.pbrt\" "
                                             "NamedMaterial \"m\" " +
                                                 triangle))
                          .scene;
  expect_near(transform_point(scene.shapes.at(0).object_to_world, {}), {1, 5, 0});
  expect_near(transform_point(scene.shapes.at(1).object_to_world, {}), {0, 5, 0});
  EXPECT_EQ(scene.materials[scene.shapes[1].material.value].model, MaterialModel{InterfaceMaterial{}});
}

TEST(PbrtFiles, MayBeGzipped) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "scene.pbrt.gz";
  const std::string text = "Film \"rgb\"\nWorldBegin\n" + triangle;
  const gzFile out = ::gzopen(file.c_str(), "wb");
  ::gzwrite(out, text.data(), static_cast<unsigned>(text.size()));
  ::gzclose(out);
  EXPECT_EQ(read_pbrt(file).scene.shapes.size(), 1u);
}

TEST(PbrtFiles, PartsOfScenesGetACameraAndASky) {
  const ImportedScene imported = import_text("Translate 100 0 0 " + triangle);
  EXPECT_TRUE(mentions(imported.diagnostics, "no camera"));
  EXPECT_TRUE(mentions(imported.diagnostics, "no light"));
  const auto& camera = std::get<PerspectiveCamera>(imported.scene.camera);
  const Point3d seen = transform_point(inverse(camera.camera_to_world), {100, 0, 0});
  EXPECT_GT(seen.z, 0);
  EXPECT_LT(std::abs(seen.x / seen.z), camera.screen.x1);
}

// ---- Objects
// ------------------------------------------------------------------------------------------------------

TEST(PbrtObjects, AreKeptOnceAndPlacedByInstances) {
  const ImportedScene imported =
      import_v4("Translate 1 0 0 ObjectBegin \"tree\" Scale 2 2 2 " + triangle + triangle +
                "ObjectEnd Translate 10 0 0 ObjectInstance \"tree\" Identity "
                "ObjectInstance \"tree\"");
  expect_no_diagnostics(imported);
  const Scene& scene = imported.scene;
  EXPECT_TRUE(scene.shapes.empty());
  ASSERT_EQ(scene.prototypes.size(), 1u);
  EXPECT_EQ(scene.prototypes[0].name, "tree");
  ASSERT_EQ(scene.prototypes[0].shapes.size(), 2u);
  expect_near(transform_point(scene.prototypes[0].shapes[0].object_to_world, {1, 0, 0}), {3, 0, 0});
  ASSERT_EQ(scene.instances.size(), 2u);
  expect_near(transform_point(scene.instances[0].prototype_to_world, {}), {11, 0, 0});
  expect_near(transform_point(scene.instances[1].prototype_to_world, {}), {0, 0, 0});
}

TEST(PbrtObjects, MayBeUsedBeforeTheyAreDefined) {
  const Scene scene = import_v4("ObjectInstance \"b\" ObjectInstance \"a\" ObjectBegin \"a\" " + triangle +
                                "ObjectEnd ObjectBegin \"b\" ObjectEnd")
                          .scene;
  ASSERT_EQ(scene.instances.size(), 1u) << "b is empty";
  EXPECT_EQ(scene.prototypes[scene.instances[0].prototype.value].name, "a");
}

// Not pbrt's: its objects have no instances.
TEST(PbrtObjects, MayHoldInstancesOfEarlierOnes) {
  const std::string leaf = "ObjectBegin \"leaf\" " + triangle + "ObjectEnd ";
  const Scene scene =
      import_v4(leaf + "ObjectBegin \"none\" ObjectEnd ObjectBegin \"tree\" Translate 0 5 0 " +
                "ObjectInstance \"leaf\" ObjectInstance \"none\" ObjectEnd " + "ObjectInstance \"tree\"")
          .scene;
  ASSERT_EQ(scene.instances.size(), 1u);
  const Prototype& tree = scene.prototypes[scene.instances[0].prototype.value];
  ASSERT_EQ(tree.instances.size(), 1u);
  EXPECT_EQ(scene.prototypes[tree.instances[0].prototype.value].name, "leaf");
  expect_near(transform_point(tree.instances[0].prototype_to_world, {}), {0, 5, 0});
  EXPECT_THROW(import_v4("ObjectBegin \"a\" ObjectInstance \"a\" ObjectEnd"), Error);
  EXPECT_THROW(import_v4("ObjectBegin \"a\" ObjectInstance \"b\" ObjectEnd " + leaf), Error);

  const Scene flat = without_nested_instances(scene);
  const Prototype& own = flat.prototypes[flat.instances[0].prototype.value];
  ASSERT_EQ(own.shapes.size(), 1u);
  EXPECT_FALSE(has_nested_instances(flat));
  expect_near(transform_point(own.shapes[0].object_to_world, {}), {0, 5, 0});
}

TEST(PbrtObjects, TheirAreaLightsAreDropped) {
  const ImportedScene imported = import_v4("ObjectBegin \"lamp\" AreaLightSource \"diffuse\" " + triangle +
                                           "ObjectEnd ObjectInstance \"lamp\"");
  EXPECT_FALSE(imported.scene.prototypes[0].shapes[0].area_light);
  EXPECT_TRUE(imported.scene.area_lights.empty());
  EXPECT_TRUE(mentions(imported.diagnostics, "do not shine"));
}

TEST(PbrtObjects, ASecondDefinitionHoldsForLaterInstances) {
  const ImportedScene imported = import_v4("ObjectBegin \"o\" " + triangle +
                                           "ObjectEnd ObjectInstance \"o\" "
                                           "ObjectBegin \"o\" " +
                                           triangle + triangle + "ObjectEnd ObjectInstance \"o\"");
  const Scene& scene = imported.scene;
  EXPECT_EQ(scene.prototypes[scene.instances[0].prototype.value].shapes.size(), 1u);
  EXPECT_EQ(scene.prototypes[scene.instances[1].prototype.value].shapes.size(), 2u);
  EXPECT_TRUE(mentions(imported.diagnostics, "defined again"));
}

// ---- Materials by name
// ----------------------------------------------------------------------------------------------

TEST(PbrtNames, MaterialsMayPrecedeTheirDefinition) {
  const ImportedScene imported =
      import_v4("NamedMaterial \"late\" " + triangle +
                "MakeNamedMaterial \"late\" \"string type\" \"dielectric\" \"float eta\" 1.25");
  expect_no_diagnostics(imported);
  EXPECT_EQ(imported.scene.materials[imported.scene.shapes[0].material.value].model,
            MaterialModel{DielectricMaterial{ConstantSpectrum{1.25f}}});
}

TEST(PbrtNames, ASecondDefinitionHoldsForLaterShapes) {
  const Scene scene =
      import_v3("MakeNamedMaterial \"m\" \"string type\" \"none\" NamedMaterial \"m\" " + triangle +
                "MakeNamedMaterial \"m\" \"string type\" \"glass\" NamedMaterial \"m\" " + triangle)
          .scene;
  EXPECT_EQ(scene.materials[scene.shapes[0].material.value].model, MaterialModel{InterfaceMaterial{}});
  EXPECT_EQ(scene.materials[scene.shapes[1].material.value].model, MaterialModel{DielectricMaterial{}});
}

const std::string red = "Texture \"t\" \"spectrum\" \"constant\" \"rgb value\" [1 0 0] ";
const std::string green = "Texture \"t\" \"spectrum\" \"constant\" \"rgb value\" [0 1 0] ";
const std::string by_texture = "Material \"matte\" \"texture Kd\" \"t\" " + triangle;

SpectrumParameter reflectance(const Scene& scene, std::size_t shape) {
  return std::get<DiffuseMaterial>(scene.materials[scene.shapes[shape].material.value].model).reflectance;
}

// pbrt-v3 keeps textures and named materials in the state that AttributeEnd restores.
TEST(PbrtNames, EndWithTheirBlockInV3) {
  for (const char* const block : {"Attribute", "Object"}) {
    const std::string begin = std::string(block) + "Begin " + (block[0] == 'O' ? "\"o\" " : "");
    const Scene scene =
        import_v3(red + by_texture + begin + green + "MakeNamedMaterial \"m\" \"string type\" \"mirror\" " +
                  block + "End " + by_texture)
            .scene;
    EXPECT_EQ(reflectance(scene, 0), reflectance(scene, 1)) << block;
  }
  const Scene materials = import_v3(
                              "MakeNamedMaterial \"m\" \"string type\" \"none\" AttributeBegin "
                              "MakeNamedMaterial \"m\" \"string type\" \"glass\" NamedMaterial \"m\" " +
                              triangle + "AttributeEnd NamedMaterial \"m\" " + triangle)
                              .scene;
  EXPECT_EQ(materials.materials[materials.shapes[0].material.value].model,
            MaterialModel{DielectricMaterial{}});
  EXPECT_EQ(materials.materials[materials.shapes[1].material.value].model,
            MaterialModel{InterfaceMaterial{}});
}

TEST(PbrtNames, OutliveATransformInV3) {
  const Scene scene =
      import_v3(red + by_texture + "TransformBegin " + green + "TransformEnd " + by_texture).scene;
  EXPECT_NE(reflectance(scene, 0), reflectance(scene, 1));
  const Scene both = import_v3(red + by_texture + "AttributeBegin TransformBegin " + green +
                               "TransformEnd AttributeEnd " + by_texture)
                         .scene;
  EXPECT_EQ(reflectance(both, 0), reflectance(both, 1));
}

// Where pbrt-v3 knows no such material any more it says so and keeps the one before.
TEST(PbrtNames, ThatHaveEndedChangeNothingInV3) {
  const ImportedScene imported = import_v3(
      "Material \"mirror\" AttributeBegin MakeNamedMaterial \"m\" \"string type\" \"glass\" "
      "AttributeEnd NamedMaterial \"m\" " +
      triangle);
  EXPECT_TRUE(std::holds_alternative<ConductorMaterial>(
      imported.scene.materials[imported.scene.shapes[0].material.value].model));
  EXPECT_TRUE(mentions(imported.diagnostics, "ended with its block"));
}

// So do names that never were defined; v4 stops at them.
TEST(PbrtNames, ThatAreUnknownChangeNothingInV3) {
  for (const bool begins : {true, false}) {
    const ImportedScene imported =
        import_v3(std::string(begins ? "" : "Material \"mirror\" ") + "NamedMaterial \"wood\" " + triangle);
    const MaterialModel& model = imported.scene.materials[imported.scene.shapes[0].material.value].model;
    EXPECT_EQ(std::holds_alternative<DiffuseMaterial>(model), begins);
    EXPECT_EQ(std::holds_alternative<ConductorMaterial>(model), !begins);
    EXPECT_TRUE(mentions(imported.diagnostics, "material \"wood\" is not defined"));
  }
  EXPECT_THROW(import_v4("NamedMaterial \"wood\" " + triangle), Error);
}

TEST(PbrtNames, AreGlobalInV4) {
  const Scene scene = import_v4(
                          "AttributeBegin Texture \"t\" \"spectrum\" \"constant\" \"rgb value\" [1 0 0] "
                          "MakeNamedMaterial \"m\" \"string type\" \"dielectric\" AttributeEnd "
                          "Material \"diffuse\" \"texture reflectance\" \"t\" " +
                          triangle + "NamedMaterial \"m\" " + triangle)
                          .scene;
  EXPECT_NE(reflectance(scene, 0), SpectrumParameter{ConstantSpectrum{0.5f}});
  EXPECT_EQ(scene.materials[scene.shapes[1].material.value].model, MaterialModel{DielectricMaterial{}});
}

TEST(PbrtNames, WaitForTexturesOfTheirBlockInV3) {
  const Scene scene =
      import_v3(red + "AttributeBegin Material \"matte\" \"texture Kd\" \"later\" " + triangle +
                "Texture \"later\" \"spectrum\" \"constant\" \"rgb value\" [0 1 0] "
                "AttributeEnd " +
                by_texture)
          .scene;
  EXPECT_NE(reflectance(scene, 0), reflectance(scene, 1));
}

TEST(PbrtNames, SettingsThatChangeNoPictureAreSilent) {
  expect_no_diagnostics(import_text(
      "Option \"bool disablepixeljitter\" false Option \"integer seed\" 3 ColorSpace \"srgb\" Accelerator "
      "\"kdtree\" "
      "\"integer foo\" 3 Film \"rgb\" \"string filename\" \"x.exr\" \"bool savefp16\" false "
      "Sampler \"zsobol\" \"integer seed\" 3 Integrator \"volpath\" \"string lightsampler\" \"bvh\" "
      "MakeNamedMaterial \"m\" \"string type\" \"diffuse\"\nWorldBegin MediumInterface \"\" \"\" " +
      triangle));
  expect_no_diagnostics(
      import_text("Option \"seed\" 3 Option \"disablepixeljitter\" false Option \"rendercoordsys\" \"world\" "
                  "Film \"rgb\" WorldBegin " +
                  triangle));
  EXPECT_TRUE(
      mentions(import_text("Option \"forcediffuse\" true Film \"rgb\" WorldBegin " + triangle).diagnostics,
               "forcediffuse"));
  EXPECT_THROW(import_text("Option \"seed\" Film \"rgb\" WorldBegin " + triangle), Error);
  EXPECT_TRUE(mentions(
      import_text("Option \"bool forcediffuse\" true Film \"rgb\" WorldBegin " + triangle).diagnostics,
      "forcediffuse"));
}

}  // namespace
}  // namespace vitrail::pbrt_directives_test
