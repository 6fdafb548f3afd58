// SPDX-License-Identifier: Apache-2.0
// Shapes, curves, quadrics and instances, there and back.
#include "scene/shapes/tessellate.h"
#include "scene/spectra/rgb_to_spectrum.h"
#include "tests/importers/curve_records.h"
#include "tests/importers/pbrt/pbrt_round_trip.h"

namespace vitrail::write_pbrt_shapes_test {
namespace {

TEST(WritePbrt, HairIsExactAndMeantForCurves) {
  for (const char* material :
       {"Material \"hair\" \"rgb reflectance\" [.1 .2 .3]", "Material \"hair\" \"float eumelanin\" .7"}) {
    const RoundTrip trip = expect_reported(material + (" " + triangle), "meant for curves");
    EXPECT_EQ(test::difference(trip.first.scene, trip.second.scene), "");
  }
  Scene scene = round_trip("Film \"rgb\"\nWorldBegin\n" + triangle).first.scene;
  HairMaterial hair;
  hair.along_v = true;
  scene.materials.at(0).model = hair;
  const TemporaryFolder folder;
  EXPECT_TRUE(mentions(write_pbrt(scene, folder / "out.pbrt"), "runs along u"));
}

TEST(WritePbrt, CurvesStayCurves) {
  const std::string type = "Shape \"curve\" \"string type\" \"cylinder\" ";
  const std::string bent = type + "\"point3 P\" [0 0 0 1 .3 0 2 1 .7 3 1 0 4 1 -.7 5 0 0 6 .1 .2] ";
  const std::string taper = "\"float width0\" .1 \"float width1\" 0 ";
  for (const std::string& world :
       {bent + "\"float width\" .3", bent + taper + "\"string basis\" \"bspline\" \"float alpha\" .5",
        "Scale 2 2 -2 " + bent + taper + bent, "ReverseOrientation " + bent + "ReverseOrientation " + bent,
        "Material \"hair\" \"float eumelanin\" 1 Scale 1 -1 1 " + bent + taper, "Scale 1 2 1 " + bent + taper,
        "ObjectBegin \"a\" " + bent + taper +
            "ObjectEnd ObjectInstance \"a\" Scale 1 2 3 ObjectInstance \"a\""}) {
    SCOPED_TRACE(world);
    const RoundTrip trip = round_trip("Film \"rgb\"\nWorldBegin\n" + world);
    EXPECT_THAT(trip.complaints, testing::IsEmpty()) << trip.text;
    for (const Diagnostic& d : trip.written) ADD_FAILURE() << d.message;
    const Scene &first = trip.first.scene, &second = trip.second.scene;
    ASSERT_EQ(first.prototypes.size(), second.prototypes.size());
    const bool in_object = !first.prototypes.empty();
    const std::vector<Shape>& before = in_object ? first.prototypes[0].shapes : first.shapes;
    const std::vector<Shape>& after = in_object ? second.prototypes[0].shapes : second.shapes;
    ASSERT_FALSE(before.empty());
    test::expect_near(test::curves_of(first, before), test::curves_of(second, after), 1e-6);
    EXPECT_EQ(before[0].opacity, after[0].opacity);
  }
}

TEST(WritePbrt, CurvesThatPbrtDoesNotHave) {
  const TemporaryFolder folder;
  const std::vector<CurvePoint> points{{{0, 0, 0}, .2}, {{1, 0, 0}, .1}, {{2, 1, 0}, .3}, {{3, 1, 1}, .1}};
  const auto written = [&](const std::vector<PlacedCurve>& curves, const char* report) {
    Scene scene = round_trip("Film \"rgb\"\nWorldBegin\n" + triangle).first.scene;
    scene.shapes = {test::add_curves(scene, curves, QuadricUv::mitsuba)};
    const Diagnostics diagnostics = write_pbrt(scene, folder / "out.pbrt");
    EXPECT_EQ(diagnostics.size(), 1u);
    EXPECT_TRUE(mentions(diagnostics, report)) << report;
    const Scene again = read_pbrt(folder / "out.pbrt").scene;
    return test::curves_of(again, again.shapes);
  };
  // Radii that are cubic: in 4 parts each, where the radius is the same within 1 %.
  const std::vector<PlacedCurve> cubic = placed_curves(bspline_segments(points), 0, 1, false, false);
  const std::vector<PlacedCurve> parts = written(cubic, "radii that are cubic");
  ASSERT_GT(parts.size(), 1u);
  CurveSegment first, second;
  halve(segment_of(cubic[0]), first, second);
  double greatest = 0, nearest = 1, radius = 0;
  for (const PlacedCurve& part : parts) {
    for (const float r : part.radius) greatest = std::max(greatest, double{r});
    const double away = length(part.origin - second[0].position);
    if (away >= nearest) continue;
    nearest = away;
    radius = double{part.radius[0]};
  }
  EXPECT_LT(nearest, 1e-6);
  EXPECT_NEAR(radius, second[0].radius, .002);
  EXPECT_NEAR(greatest, .2, .04);
  const std::vector<PlacedCurve> straight = placed_curves(linear_segments(points), 0, 1, true, true);
  const std::vector<PlacedCurve> bezier = written(straight, "in a mitre");
  ASSERT_EQ(bezier.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(bezier[i].to[2], straight[i].to[2]);
    EXPECT_EQ(bezier[i].radius[3], straight[i].radius[3]);
  }
}

TEST(WritePbrt, CurvesThatShineAreTubes) {
  expect_reported(
      "AreaLightSource \"diffuse\" Shape \"curve\" \"string type\" \"cylinder\" \"point3 P\" "
      "[0 0 0 1 0 0 2 1 0 3 1 0]",
      "tubes of triangles");
}

TEST(WritePbrt, ShapesAndInstances) {
  expect_exact_world(
      "Scale -1 1 1 " + triangle + "ReverseOrientation " + triangle +
      "Shape \"sphere\" Rotate 33 1 2 3 Shape \"loopsubdiv\" \"integer indices\" [0 1 2 0 2 3 0 3 1 1 3 2] "
      "\"point3 P\" [0 0 0 1 0 0 0 1 0 0 0 1]");
  expect_exact_world(
      "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1e-3 0.1 0 0 1 .33] \"normal N\" [0 0 1 0 1 1 0 0 3] "
      "\"point2 uv\" [.1 .2 .3 .4 .5 .6] \"float alpha\" .3");
  expect_exact_world("Shape \"trianglemesh\" \"point3 P\" [1e6 1e6 0 1000001 1e6 0 1e6 1000001.25 0]");
  expect_exact_world("ObjectBegin \"o\" Translate 1 2 3 " + triangle +
                     "Shape \"disk\" ObjectEnd ObjectInstance \"o\" "
                     "Scale -1 2 3 ObjectInstance \"o\"");
}

TEST(WritePbrt, QuadricsStayQuadrics) {
  const std::string light = "AreaLightSource \"diffuse\" ";
  for (const std::string shape :
       {"Shape \"sphere\" \"float radius\" .3", "Shape \"sphere\" \"float zmax\" .3 \"float phimax\" 77.7",
        "Shape \"disk\" \"float height\" 3 \"float radius\" .7 \"float innerradius\" .1",
        "Shape \"cylinder\" \"float radius\" .7 \"float zmin\" -.3 \"float zmax\" 1.1 \"float phimax\" 123"})
    for (const std::string placed : {"", "Translate 1 2 3 ", "Rotate 33 1 2 3 Scale .1 .1 .1 ",
                                     "Scale 1 2 3 Rotate 33 1 2 3 ", "Scale 1 -1 1 Rotate 40 0 1 0 "})
      for (const std::string side : {"", "ReverseOrientation "}) expect_exact_world(placed + side + shape);
  for (const std::string shape :
       {"Shape \"sphere\" \"float radius\" .3", "Shape \"disk\" \"float radius\" .7",
        "Shape \"cylinder\" \"float radius\" .7 \"float zmin\" 0 \"float phimax\" 123"})
    expect_exact_world("Translate 1 2 3 Rotate 90 1 0 0 " + light + "ReverseOrientation " + shape);
}

// pbrt samples lights before it transforms them.
TEST(WritePbrt, ShiningQuadricsHaveTheirOwnSize) {
  const auto written = [](const std::string& world) {
    return round_trip("Film \"rgb\"\nWorldBegin\nAreaLightSource \"diffuse\" " + world);
  };
  EXPECT_THAT(
      written("Translate 1 2 3 Scale 2 2 2 Shape \"sphere\" \"float radius\" 3").text,
      testing::HasSubstr("Transform [ 1 0 0 0 0 1 0 0 0 0 1 0 1 2 3 1 ]\n    Shape \"sphere\" \"float "
                         "radius\" [ 6 ]"));
  EXPECT_THAT(written("Scale 2 2 5 Shape \"cylinder\" \"float zmin\" 0").text,
              testing::HasSubstr("\"float radius\" [ 2 ] \"float zmin\" [ 0 ] \"float zmax\" [ 5 ]"));
  for (const char* world : {"Scale 1 2 1 Shape \"sphere\"", "Shape \"sphere\" \"float zmin\" 0",
                            "Shape \"disk\" \"float innerradius\" .5"}) {
    const RoundTrip trip = written(world);
    EXPECT_TRUE(mentions(trip.written, "becomes triangles, 256 for a full turn")) << world;
    EXPECT_FALSE(trip.second.scene.meshes.at(0).quadric) << world;
  }
}

// pbrt lets the points that it looks for on a mirrored light shine to one side and those that it meets to the
// other: such lights are written without the mirror.
TEST(WritePbrt, ShiningQuadricsAreNotMirrored) {
  for (const std::string shape : {"\"sphere\"", "\"disk\"", "\"cylinder\""})
    for (const std::string side : {"", "ReverseOrientation "}) {
      const RoundTrip trip =
          round_trip("Film \"rgb\"\nWorldBegin\nAreaLightSource \"diffuse\" Scale 1 1 -1 Rotate 30 1 2 3 " +
                     side + "Shape " + shape);
      const Shape &before = trip.first.scene.shapes.at(0), &after = trip.second.scene.shapes.at(0);
      EXPECT_FALSE(swaps_handedness(after.object_to_world)) << shape;
      EXPECT_EQ(after.flip_orientation, !before.flip_orientation) << shape;
      // Where the middle and the top of the quadric are has not changed.
      for (const Point3d p : {Point3d{0, 0, 0}, Point3d{0, 0, 1}})
        EXPECT_LT(
            length(transform_point(before.object_to_world, p) - transform_point(after.object_to_world, p)),
            1e-6)
            << shape;
    }
}

TEST(WritePbrt, ConesAndParaboloidsBecomeTriangles) {
  const RoundTrip trip =
      round_trip("Film \"rgb\"\nWorldBegin\nShape \"cone\" Scale 2 2 2 Shape \"cone\" Shape \"paraboloid\"");
  ASSERT_EQ(trip.written.size(), 3u);
  EXPECT_TRUE(mentions(trip.written, "a cone becomes triangles, 256 for a full turn"));
  EXPECT_EQ(trip.second.scene.meshes.size(), 2u);
  EXPECT_GT(trip.second.scene.meshes.at(0).triangles.size(), 255u);
}

// What a mirrored sphere shows of a texture is what an unmirrored one of the other convention does.
TEST(WritePbrt, SpheresOfMitsubaKeepTheirTextures) {
  const TemporaryFolder folder;
  Scene scene =
      import_v4(
          "Texture \"t\" \"spectrum\" \"checkerboard\" Material \"diffuse\" \"texture reflectance\" "
          "\"t\" Shape \"sphere\" Shape \"disk\"")
          .scene;
  for (TriangleMesh& mesh : scene.meshes) mesh.quadric->uv = QuadricUv::mitsuba;
  scene.meshes[0].quadric->high = 0.5;
  const Diagnostics diagnostics = write_pbrt(scene, folder / "out.pbrt");
  EXPECT_EQ(diagnostics.size(), 1u);
  EXPECT_TRUE(mentions(diagnostics, "a disk becomes triangles"));
  const Scene again = read_pbrt(folder / "out.pbrt").scene;
  EXPECT_EQ(again.meshes.at(0).quadric, (Quadric{.kind = QuadricKind::sphere, .low = -0.5}));
  EXPECT_EQ(again.shapes.at(0).object_to_world, vitrail::scale({1, 1, -1}));
  EXPECT_TRUE(again.shapes.at(0).flip_orientation);
  EXPECT_EQ(again.meshes.at(1).uvs, tessellate(*scene.meshes[1].quadric).uvs);
  // Where no texture shows, they are what they are.
  scene.shapes[0].material = scene.shapes[1].material = Id<Material>{1};
  scene.materials.push_back({DiffuseMaterial{}});
  EXPECT_TRUE(write_pbrt(scene, folder / "out.pbrt").empty());
  EXPECT_EQ(read_pbrt(folder / "out.pbrt").scene.shapes.at(0).object_to_world, Transform{});
}

TEST(WritePbrt, OpacitiesOfShapes) {
  const std::string leaf = "Texture \"leaf\" \"float\" \"checkerboard\" ",
                    light = "AreaLightSource \"diffuse\" ";
  expect_exact_world(leaf + triangle + "\"texture alpha\" \"leaf\" Material \"interface\" " + triangle +
                     "\"float alpha\" .25 " + light + "Material \"diffuse\" " + triangle +
                     "\"float alpha\" 0");
}

// pbrt leaves out area lights in objects.
TEST(WritePbrt, WhatShinesInAnObjectIsWrittenWithEveryInstance) {
  Scene scene = round_trip("Film \"rgb\"\nWorldBegin\nObjectBegin \"o\" " + triangle + triangle +
                           "ObjectEnd ObjectInstance \"o\" Scale -1 2 1 ObjectInstance \"o\"")
                    .first.scene;
  scene.area_lights.push_back({Spectrum{emission_from_rgb({1, 1, 1})}});
  scene.prototypes.at(0).shapes.at(1).area_light = Id<AreaLight>{0};
  const TemporaryFolder folder;
  EXPECT_TRUE(mentions(write_pbrt(scene, folder / "out.pbrt"), "instances no area lights"));
  EXPECT_THAT(test::pbrt_complaints(folder / "out.pbrt"), testing::IsEmpty());
  const Scene again = read_pbrt(folder / "out.pbrt").scene;
  EXPECT_EQ(again.prototypes.at(0).shapes.size(), 1u);
  ASSERT_EQ(again.shapes.size(), 2u);
  EXPECT_TRUE(again.shapes[0].area_light && again.shapes[1].area_light);
  EXPECT_EQ(again.shapes[1].object_to_world, scale({-1, 2, 1}));
  EXPECT_TRUE(again.shapes[1].flip_orientation);  // its front stays where it was in the object
}

}  // namespace
}  // namespace vitrail::write_pbrt_shapes_test
