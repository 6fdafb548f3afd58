// SPDX-License-Identifier: Apache-2.0
// Shapes and, above all, which side of them is the front.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "importers/pbrt/read/pbrt.h"
#include "scene/shapes/curve.h"
#include "scene/shapes/quadric_places.h"
#include "scene/shapes/tessellate.h"
#include "scene/spectra/rgb_to_spectrum.h"
#include "tests/importers/pbrt/pbrt_text.h"

namespace vitrail::pbrt_shapes_test {
namespace {

// The front's normal of triangle `t` of a shape in the world, by the rule of scene.h.
Vector3d front(const Scene& scene, const Shape& shape, std::size_t t = 0, const Transform& to_world = {}) {
  const TriangleMesh& mesh = scene.meshes[shape.mesh.value];
  const Transform transform = to_world * shape.object_to_world;
  const auto corner = [&](std::size_t i) {
    return transform_point(transform, cast<double>(mesh.positions[mesh.triangles[t][i]]));
  };
  const Vector3d normal = normalize(cross(corner(1) - corner(0), corner(2) - corner(0)));
  return shape.flip_orientation ? -normal : normal;
}

// Its quadrics as triangles.
Scene tessellated_v4(const std::string& world) {
  Scene scene = import_v4(world).scene;
  for (TriangleMesh& mesh : scene.meshes)
    if (mesh.quadric) mesh = tessellate(*mesh.quadric);
  return scene;
}

Vector3d front_of(const std::string& world) {
  const Scene scene = tessellated_v4(world);
  return front(scene, scene.shapes.at(0));
}

// The front of a closed shape around the origin: +1 if outside.
double outwardness(const std::string& world) {
  const Scene scene = tessellated_v4(world);
  const Shape& shape = scene.shapes.at(0);
  const TriangleMesh& mesh = scene.meshes[shape.mesh.value];
  double least = 1, greatest = -1;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Point3d p =
        transform_point(shape.object_to_world, cast<double>(mesh.positions[mesh.triangles[t][0]]));
    const double side = dot(front(scene, shape, t), p - Point3d{}) > 0 ? 1 : -1;
    least = std::min(least, side);
    greatest = std::max(greatest, side);
  }
  EXPECT_EQ(least, greatest) << "the sides differ";
  return least;
}

const Vector3d up{0, 0, 1}, down{0, 0, -1};
const std::string points =
    "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"integer indices\" [0 1 2] ";
const std::string facing_up = points + "\"normal N\" [0 0 1 0 0 1 0 0 1]";
const std::string facing_down = points + "\"normal N\" [0 0 -1 0 0 -1 0 0 -1]";

TEST(PbrtOrientation, MeshesFaceWhereTheyWindInTheObject) {
  EXPECT_EQ(front_of(points), up);
  EXPECT_EQ(front_of("ReverseOrientation " + points), down);
  EXPECT_EQ(front_of("ReverseOrientation ReverseOrientation " + points), up);
  EXPECT_EQ(front_of("Scale -1 1 1 " + points), up) << "a mirror keeps the side";
  EXPECT_EQ(front_of("Scale 1 1 -1 " + points), down) << "the side itself is mirrored";
  EXPECT_EQ(front_of("Scale -1 1 1 ReverseOrientation " + points), down);
}

TEST(PbrtOrientation, MeshesWithNormalsFaceWhereTheNormalsPoint) {
  EXPECT_EQ(front_of(facing_up), up);
  EXPECT_EQ(front_of(facing_down), down);
  EXPECT_EQ(front_of("Scale -1 1 1 " + facing_down), down);
  EXPECT_EQ(front_of("Scale 1 1 -1 " + facing_down), up);
  EXPECT_EQ(front_of("ReverseOrientation " + facing_down), up);
}

TEST(PbrtOrientation, OfEachTriangleIsItsOwn) {
  const Scene scene =
      import_v4(
          "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 1 1 0 0 0 5 1 0 5 1 1 5] \"integer indices\" "
          "[0 1 2 3 4 5] \"normal N\" [0 0 1 0 0 1 0 0 1 0 0 -1 0 0 -1 0 0 -1]")
          .scene;
  EXPECT_EQ(front(scene, scene.shapes[0], 0), up);
  EXPECT_EQ(front(scene, scene.shapes[0], 1), down);
}

TEST(PbrtOrientation, PatchesFaceTheCrossProductOfTheirEdges) {
  const std::string patch = "Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 0] ";
  EXPECT_EQ(front_of(patch), up);
  EXPECT_EQ(front_of("ReverseOrientation " + patch), down);
  EXPECT_EQ(front_of("Scale -1 1 1 " + patch), up);
  EXPECT_EQ(front_of(patch + "\"normal N\" [0 0 -1 0 0 -1 0 0 -1 0 0 -1]"), down);
}

TEST(PbrtOrientation, DisksFaceUpAndSpheresOutside) {
  EXPECT_EQ(front_of("Shape \"disk\""), up);
  EXPECT_EQ(front_of("ReverseOrientation Shape \"disk\""), down);
  EXPECT_EQ(outwardness("Shape \"sphere\""), 1);
  EXPECT_EQ(outwardness("ReverseOrientation Shape \"sphere\""), -1);
  EXPECT_EQ(outwardness("Shape \"cylinder\""), 1);
}

TEST(PbrtOrientation, MirrorsTurnAnalyticShapesInsideOut) {
  EXPECT_EQ(outwardness("Scale -1 1 1 Shape \"sphere\""), -1) << "as pbrt renders glass";
  EXPECT_EQ(outwardness("Scale -1 1 1 ReverseOrientation Shape \"sphere\""), 1);
  EXPECT_EQ(outwardness("Scale -1 1 1 AreaLightSource \"diffuse\" Shape \"sphere\""), 1)
      << "but not their light";
}

TEST(PbrtOrientation, SubdividedMeshesFaceAgainstTheirWinding) {
  const std::string cube =
      "Shape \"loopsubdiv\" \"integer levels\" 2 \"integer indices\" [0 2 1 0 3 2 4 5 6 4 6 7 0 1 5 0 5 4 1 "
      "2 6 1 6 5 2 3 7 "
      "2 7 6 3 0 4 3 4 7] \"point3 P\" [-1 -1 -1 1 -1 -1 1 1 -1 -1 1 -1 -1 -1 1 1 -1 1 1 1 1 -1 1 1]";
  EXPECT_EQ(outwardness(cube), -1) << "pbrt's normals of a cage that winds outside point inside";
  EXPECT_EQ(outwardness("ReverseOrientation " + cube), 1);
  const Scene scene = import_v4(cube).scene;
  const TriangleMesh& mesh = scene.meshes.at(0);
  EXPECT_EQ(mesh.triangles.size(), 12u * 16u);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    EXPECT_LT(dot(to_vector(mesh.normals[i]), mesh.positions[i] - Point3f{}), 0);
}

TEST(PbrtOrientation, PrototypesKeepTheirSides) {
  const Scene scene =
      import_v4("ObjectBegin \"o\" " + points + "ObjectEnd Scale -1 1 1 ObjectInstance \"o\"").scene;
  EXPECT_FALSE(scene.prototypes[0].shapes[0].flip_orientation);
  EXPECT_EQ(front(scene, scene.prototypes[0].shapes[0]), up);
}

// ---- Meshes and files
// -----------------------------------------------------------------------------------------------

TEST(PbrtShapes, MeshesKeepTheirVertices) {
  const ImportedScene imported = import_v3(
      "Shape \"trianglemesh\" \"point P\" [0 0 0 1 0 0 0 1 .5] \"float uv\" [0 0 1 0 0 1] "
      "\"integer indices\" [2 0 1] \"vector S\" [1 0 0 1 0 0 1 0 0]");
  EXPECT_EQ(imported.diagnostics.size(), 1U);
  EXPECT_TRUE(mentions(imported.diagnostics, "tangents"));
  const TriangleMesh& mesh = imported.scene.meshes.at(0);
  EXPECT_EQ(mesh.positions, (std::vector<Point3f>{{0, 0, 0}, {1, 0, 0}, {0, 1, .5f}}));
  EXPECT_EQ(mesh.uvs, (std::vector<Point2f>{{0, 0}, {1, 0}, {0, 1}}));
  EXPECT_EQ(mesh.triangles, (std::vector<std::array<std::uint32_t, 3>>{{2, 0, 1}}));
}

TEST(PbrtShapes, OneTriangleNeedsNoIndices) {
  EXPECT_EQ(import_v4("Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0]")
                .scene.meshes.at(0)
                .triangles.size(),
            1u);
}

TEST(PbrtShapes, MeshesFarAwayKeepTheirDetail) {
  const Scene scene =
      import_v4(
          "Translate 1 0 0 Shape \"trianglemesh\" \"point3 P\" [1000000.0625 0 0 1000000.125 0 0 "
          "1000000.0625 .001 0]")
          .scene;
  const TriangleMesh& mesh = scene.meshes.at(0);
  const auto world = [&](std::size_t i) {
    return transform_point(scene.shapes[0].object_to_world, cast<double>(mesh.positions[i]));
  };
  EXPECT_NEAR(world(0).x, 1000001.0625, 1e-8);
  EXPECT_NEAR(world(1).x, 1000001.125, 1e-8);
  EXPECT_NEAR(world(2).y, .001, 1e-8);
}

TEST(PbrtShapes, PlyFilesAreReadOnce) {
  const TemporaryFolder folder;
  folder.write(
      "t.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  const Scene scene =
      read_pbrt(folder.write("s.pbrt",
                             "Film \"rgb\" WorldBegin Shape \"plymesh\" \"string filename\" \"t.ply\" "
                             "ReverseOrientation Shape \"plymesh\" \"string filename\" [\"t.ply\"]"))
          .scene;
  ASSERT_EQ(scene.shapes.size(), 2u);
  EXPECT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(front(scene, scene.shapes[0]), up);
  EXPECT_EQ(front(scene, scene.shapes[1]), down);
}

// Of triangles, of a patch that becomes two, and of a file with both; only where a texture asks for them.
TEST(PbrtShapes, NumbersOfFacesAreKeptForPtex) {
  const TemporaryFolder folder;
  folder.write("t.ply",
               "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float "
               "z\nelement face 2\nproperty list uchar int vertex_indices\nproperty int face_indices\n"
               "end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 0 0\n4 0 1 2 3 7\n3 1 4 2 9\n");
  const auto faces = [&](const std::string& before) {
    const Scene scene =
        read_pbrt(
            folder.write("s.pbrt", "Film \"rgb\" WorldBegin " + before +
                                       " Shape \"plymesh\" \"string filename\" \"t.ply\" "
                                       "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 0] "
                                       "\"integer indices\" [0 1 2 1 3 2] \"integer faceIndices\" [4 5]"))
            .scene;
    std::vector<std::vector<float>> values;
    for (const TriangleMesh& mesh : scene.meshes)
      values.push_back(mesh.attributes.empty() ? std::vector<float>() : mesh.attributes.at(0).values);
    return values;
  };
  using Faces = std::vector<std::vector<float>>;
  EXPECT_EQ(faces("Texture \"t\" \"spectrum\" \"ptex\" \"string filename\" \"t.ptx\""),
            (Faces{{9}, {7, 7}, {4, 5}}));
  EXPECT_EQ(faces(""), (Faces{{}, {}, {}}));
}

TEST(PbrtShapes, QuadricsAreKept) {
  const ImportedScene imported = import_v4(
      "Shape \"sphere\" Scale 1 2 3 Shape \"sphere\" \"float radius\" 2 Shape \"disk\" \"float height\" 4 "
      "Shape \"cylinder\" \"float zmin\" [1] \"float zmax\" [3] "
      "Shape \"cylinder\" \"float phimax\" 90 Shape \"cone\" \"float height\" 7 "
      "Shape \"paraboloid\" \"float zmin\" [1] \"float zmax\" [4] Shape \"sphere\" \"float zmin\" [0] "
      "Shape \"sphere\" \"float radius\" 5 \"float zmin\" [0]");
  expect_no_diagnostics(imported);
  const Scene& scene = imported.scene;
  const auto quadric = [&](std::size_t shape) {
    const TriangleMesh& mesh = scene.meshes.at(scene.shapes.at(shape).mesh.value);
    EXPECT_TRUE(mesh.quadric && mesh.positions.empty() && mesh.triangles.empty());
    return mesh.quadric.value();
  };
  const double quarter = 90 * std::numbers::pi / 180;
  EXPECT_EQ(quadric(0), (Quadric{.kind = QuadricKind::sphere}));
  EXPECT_EQ(quadric(2), (Quadric{.kind = QuadricKind::disk, .low = 0}));
  EXPECT_EQ(quadric(3), (Quadric{.kind = QuadricKind::cylinder}));
  EXPECT_EQ(quadric(4), (Quadric{.kind = QuadricKind::cylinder, .phi_max_rad = quarter}));
  EXPECT_EQ(quadric(5), (Quadric{.kind = QuadricKind::cone}));
  EXPECT_EQ(quadric(6), (Quadric{.kind = QuadricKind::paraboloid, .low = 0.25}));
  EXPECT_EQ(quadric(7), (Quadric{.kind = QuadricKind::sphere, .low = 0}));
  EXPECT_EQ(scene.shapes[1].object_to_world, scale({2, 4, 6}));
  EXPECT_EQ(scene.shapes[2].object_to_world, scale({1, 2, 3}) * translate({0, 0, 4}));
  EXPECT_EQ(scene.shapes[3].object_to_world, scale({1, 2, 3}) * translate({0, 0, 1}) * scale({1, 1, 2}));
  EXPECT_EQ(scene.shapes[5].object_to_world, scale({1, 2, 21}));
  EXPECT_EQ(scene.shapes[1].mesh, scene.shapes[0].mesh) << "sizes are the transform's";
  EXPECT_EQ(scene.shapes[8].mesh, scene.shapes[7].mesh);
  EXPECT_EQ(scene.meshes.size(), 7u);
}

TEST(PbrtShapes, UnknownOnesAreReported) {
  const ImportedScene imported = import_v4("Shape \"teapot\"");
  EXPECT_TRUE(imported.scene.shapes.empty());
  ASSERT_EQ(imported.diagnostics.size(), 1u);
  EXPECT_EQ(imported.diagnostics[0].fidelity, Fidelity::dropped);
  EXPECT_THAT(imported.diagnostics[0].message, ::testing::HasSubstr("teapot"));
}

// The power is that of a surface of this area in the world.
TEST(PbrtShapes, PowerCountsTheAreaOfQuadrics) {
  const auto area = [](const std::string& shape) {
    const Scene scene =
        import_v4("Rotate 30 1 2 3 Scale 2 2 2 AreaLightSource \"diffuse\" \"float power\" 100 " + shape)
            .scene;
    const double radiance = luminance(std::get<Spectrum>(scene.area_lights.at(0).radiance)) *
                            static_cast<double>(scene.area_lights[0].scale);
    return 100 / (std::numbers::pi * radiance);
  };
  const double rectangle = area("Shape \"trianglemesh\" \"point3 P\" [0 0 0 2 0 0 0 1 0]") / 4;
  EXPECT_NEAR(area("Shape \"sphere\" \"float radius\" 3") / rectangle, 4 * 36 * std::numbers::pi, 1e-3);
  EXPECT_NEAR(area("Shape \"disk\" \"float innerradius\" .5") / rectangle, 4 * .75 * std::numbers::pi, 1e-4);
  EXPECT_NEAR(area("Shape \"cylinder\" \"float radius\" 3") / rectangle, 4 * 12 * std::numbers::pi, 1e-3);
}

TEST(PbrtCurves, StayCurvesAndRibbonsBecomeTriangles) {
  const std::string p = " \"point3 P\" [0 0 0 1 0 0 2 0 0 3 0 0] \"float width\" 2 ";
  const auto mesh_of = [](const std::string& world) { return import_v4(world).scene.meshes.at(0); };
  const auto curves_of = [&](const std::string& world) {
    const TriangleMesh mesh = mesh_of(world);
    std::vector<Transform> places(mesh.places->size());
    mesh.places->read(0, places);
    std::vector<PlacedCurve> curves;
    for (const Transform& place : places) curves.push_back(unpacked_curve(place));
    return curves;
  };
  const std::vector<PlacedCurve> round = curves_of("Shape \"curve\" \"string type\" \"cylinder\"" + p);
  ASSERT_EQ(round.size(), 1u);
  EXPECT_EQ(round[0].to[2], (Vector3f{3, 0, 0}));
  EXPECT_EQ(round[0].radius, (std::array<float, 4>{1, 1, 1, 1}));
  EXPECT_EQ(std::pair(round[0].along_first, round[0].along_last), std::pair(0.f, 1.f));
  // Two segments; those that follow each other and are alike become one shape.
  const std::string two =
      "Shape \"curve\" \"point3 P\" [0 0 0 1 0 0 2 0 0 3 0 0 4 0 0 5 0 0 6 1 0] \"float width0\" 2 "
      "\"float width1\" 0 ";
  const ImportedScene many = import_v4(two + "Scale 2 2 2 " + two + "Material \"conductor\" " + two);
  ASSERT_EQ(many.scene.shapes.size(), 2u);
  ASSERT_EQ(many.scene.meshes.size(), 2u);
  const std::vector<PlacedCurve> run = curves_of(two + "Scale 2 2 2 " + two);
  ASSERT_EQ(run.size(), 4u);
  EXPECT_EQ(run[1].radius[0], 0.5f);
  EXPECT_EQ(run[1].along_first, 0.5f);
  EXPECT_EQ(run[2].radius[0], 2.f);
  EXPECT_EQ(run[2].to[2], (Vector3f{6, 0, 0}));
  const TriangleMesh ribbon =
      mesh_of("Shape \"curve\" \"string type\" \"ribbon\" \"normal N\" [0 0 1 0 0 1] \"float width1\" 0" + p);
  EXPECT_EQ(ribbon.triangles.size(), 2u);
  EXPECT_EQ(ribbon.positions[0], (Point3f{0, -1, 0}));
  EXPECT_EQ(ribbon.positions[3], (Point3f{3, 0, 0}));
  // Turned by a quarter, in four steps; by half, which has no shortest way: narrow in the middle, as in pbrt;
  // and normals that lean along the curve, which make it narrow everywhere.
  const auto turned = [&](const std::string& normals) {
    return mesh_of("Shape \"curve\" \"string type\" \"ribbon\" \"normal N\" [" + normals + "]" + p);
  };
  const auto width = [](const TriangleMesh& mesh, std::size_t step) {
    return length(mesh.positions[2 * step + 1] - mesh.positions[2 * step]);
  };
  const TriangleMesh quarter = turned("0 0 1 0 1 0"), half = turned("0 0 1 0 0 -1");
  EXPECT_EQ(quarter.triangles.size(), 8u);
  for (std::size_t i = 0; i <= 4; ++i) EXPECT_NEAR(width(quarter, i), 2, 1e-6) << i;
  EXPECT_EQ(half.triangles.size(), 16u);
  for (std::size_t i = 0; i <= 8; ++i) {
    EXPECT_NEAR(width(half, i), 2 * std::abs(std::cos(std::numbers::pi * static_cast<double>(i) / 8)), 1e-6)
        << i;
    const Normal3f n = half.normals[2 * i];
    EXPECT_NEAR(n.x * n.x + n.y * n.y + n.z * n.z, 1, 1e-5);
  }
  EXPECT_NEAR(width(turned("1 0 1 1 0 1"), 0), std::numbers::sqrt2, 1e-6);
  EXPECT_EQ(curves_of("Shape \"curve\" \"string basis\" \"bspline\" \"integer degree\" 2" + p)[0].origin.x,
            0.5);
  const ImportedScene flat = import_v4("Shape \"curve\"" + p);
  EXPECT_EQ(flat.diagnostics.size(), 1u);
}

// Hair is met from outside, whatever turns the sides of other shapes; on other shapes that is reported.
TEST(PbrtCurves, OfHairHaveTheirFrontOutside) {
  const std::string curve = " Shape \"curve\" \"point3 P\" [0 0 0 1 0 0 2 0 0 3 0 0] ";
  const auto read = [&](const std::string& before) {
    return import_v4(before + " Material \"hair\" " + curve).scene.shapes.at(0).flip_orientation;
  };
  EXPECT_FALSE(read(""));
  EXPECT_FALSE(read("ReverseOrientation"));
  EXPECT_TRUE(read("Scale -1 1 1"));
  EXPECT_TRUE(read("Scale -1 1 1 ReverseOrientation"));
  EXPECT_EQ(import_v4("Material \"hair\" " + curve).diagnostics.size(), 1u);
  EXPECT_EQ(
      import_v4("MakeNamedMaterial \"h\" \"string type\" \"hair\" Material \"mix\" \"string materials\" "
                "[\"h\" \"h\"] Shape \"sphere\"")
          .diagnostics.size(),
      1u);
}

TEST(PbrtCurves, AreRefusedWhereTheyMakeNoSense) {
  for (const char* bad : {"\"point3 P\" [0 0 0 1 0 0 2 0 0]", "\"point3 P\" [0 0 0 1 0 0 2 0 0 3 0 0 4 0 0]",
                          "\"point3 P\" [0 0 0 1 0 0 2 0 0 3 0 0] \"float width\" -1",
                          "\"point3 P\" [0 0 0 1 0 0 2 0 0 3 0 0] \"integer degree\" 4",
                          "\"point3 P\" [0 0 0 1 0 0 2 0 0 3 0 0] \"string basis\" \"hermite\"",
                          "\"point3 P\" [0 0 0 1 0 0 2 0 0 3 0 0] \"string type\" \"ribbon\""})
    EXPECT_THROW(import_v4(std::string("Shape \"curve\" ") + bad), Error) << bad;
}

// Where memory is limited many in a row that differ in where they stand alone become one shape; what else is
// on the way stays what it is.
TEST(PbrtQuadrics, ManyInARowBecomePlaces) {
  constexpr int count = 5000;
  std::string world = "WorldBegin\n";
  for (int i = 0; i < count; ++i)
    world += fmt::format(
        "AttributeBegin Translate {} 0 0 Scale 1 1 {} Shape \"sphere\" \"float radius\" {} AttributeEnd\n", i,
        i == 3000 ? -1 : 1, 0.1 + 1e-5 * i);
  const TemporaryFolder folder;
  const auto file = folder.write("s.pbrt", world);
  const Scene one_by_one = read_pbrt(file).scene, gathered = read_pbrt(file, MeshMemory(1 << 16)).scene;
  ASSERT_EQ(one_by_one.shapes.size(), std::size_t{count});
  ASSERT_EQ(gathered.shapes.size(), 3u);
  std::vector<Transform> all;
  for (const Shape& shape : gathered.shapes) {
    const TriangleMesh& mesh = gathered.meshes[shape.mesh.value];
    EXPECT_EQ(mesh.quadric, one_by_one.meshes[0].quadric);
    if (!mesh.places) {
      all.push_back(shape.object_to_world);
      continue;
    }
    EXPECT_EQ(shape.object_to_world, Transform{});
    std::vector<Transform> places(mesh.places->size());
    mesh.places->read(0, places);
    all.insert(all.end(), places.begin(), places.end());
  }
  ASSERT_EQ(all.size(), std::size_t{count});
  for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(all[i], one_by_one.shapes[i].object_to_world) << i;
}

TEST(PbrtShapes, AHeightfieldIsAGridOverTheUnitSquare) {
  const ImportedScene read =
      import_v3("Shape \"heightfield\" \"integer nu\" 3 \"integer nv\" 2 \"float Pz\" [0 1 2 3 4 5]");
  expect_no_diagnostics(read);
  const TriangleMesh& mesh = read.scene.meshes.at(0);
  ASSERT_EQ(mesh.positions.size(), 6U);
  EXPECT_EQ(mesh.positions[5], (Point3f{1, 1, 5}));
  EXPECT_EQ(mesh.positions[1], (Point3f{0.5F, 0, 1}));
  EXPECT_EQ(mesh.uvs[4], (Point2f{0.5F, 1}));
  EXPECT_EQ(mesh.triangles.size(), 4U);
  EXPECT_GT(front(read.scene, read.scene.shapes.at(0)).z, 0);
  EXPECT_THROW(import_v3("Shape \"heightfield\" \"integer nu\" 3 \"integer nv\" 2 \"float Pz\" [0 1]"),
               Error);
}

// A quarter of a cylinder is a rational spline of degree 2: its points have the radius, its normals point
// outwards.
TEST(PbrtShapes, ANurbsArcIsRound) {
  const std::string arc =
      "Shape \"nurbs\" \"integer nv\" 2 \"integer vorder\" 2 \"float vknots\" [0 0 1 1]"
      " \"integer nu\" 3 \"integer uorder\" 3 \"float uknots\" [0 0 0 1 1 1] \"float Pw\" [";
  const double w = std::numbers::sqrt2 / 2;
  const std::string row = fmt::format("1 0 0 1 {0} {0} 0 {0} 0 1 0 1 ", w),
                    above = fmt::format("1 0 2 1 {0} {0} {1} {0} 0 1 2 1]", w, 2 * w);
  const ImportedScene read = import_v3(arc + row + above);
  expect_no_diagnostics(read);
  const TriangleMesh& mesh = read.scene.meshes.at(0);
  ASSERT_EQ(mesh.positions.size(), 900U);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Point3d p = cast<double>(mesh.positions[i]);
    const Normal3f n = mesh.normals[i];
    EXPECT_NEAR(std::hypot(p.x, p.y), 1, 1e-6);
    EXPECT_NEAR(n.x, p.x, 1e-6);
    EXPECT_NEAR(n.y, p.y, 1e-6);
  }
  EXPECT_EQ(mesh.positions.back(), (Point3f{0, 1, 2}));
  EXPECT_THROW(import_v3(arc + row + "]"), Error);
}

TEST(PbrtShapes, NurbsOfAnOrderThatNobodyHasAreRefused) {
  const auto surface = [](int order, double weight) {
    std::string text = fmt::format(
        "Shape \"nurbs\" \"integer nv\" 2 \"integer vorder\" 2 \"float vknots\" [0 0 1 1] \"integer nu\" {0} "
        "\"integer uorder\" {0} \"float uknots\" [",
        order);
    for (int i = 0; i < 2 * order; ++i) text += i < order ? "0 " : "1 ";
    text += "] \"float Pw\" [";
    for (int i = 0; i < 2 * order; ++i) text += fmt::format("{} {} 0 {} ", i % order, i / order, weight);
    return text + "]";
  };
  EXPECT_EQ(import_v3(surface(100, 1)).scene.meshes.at(0).positions.size(), 900U);
  EXPECT_THROW(import_v3(surface(257, 1)), Error);
  EXPECT_THROW(import_v3(surface(3, 1e-45)), Error);  // points beyond single precision
}

TEST(PbrtShapes, HyperboloidsBeyondSinglePrecisionAreRefused) {
  EXPECT_THROW(import_v3("Shape \"hyperboloid\" \"point p1\" [3e38 3e38 0] \"point p2\" [3e38 3e38 1]"),
               Error);
}

// x² + y² − z² = 1 is swept by the line from (1,−1,−1) to (1,1,1).
TEST(PbrtShapes, AHyperboloidIsWhatALineSweeps) {
  const ImportedScene read =
      import_v3("Shape \"hyperboloid\" \"point p1\" [1 -1 -1] \"point p2\" [1 1 1] \"float phimax\" 180");
  EXPECT_TRUE(mentions(read.diagnostics, "a hyperboloid becomes triangles"));
  const TriangleMesh& mesh = read.scene.meshes.at(0);
  EXPECT_EQ(mesh.triangles.size(), 2U * 128 * 64);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Point3d p = cast<double>(mesh.positions[i]);
    const Vector3d gradient{p.x, p.y, -p.z}, n = to_vector(cast<double>(mesh.normals[i]));
    EXPECT_NEAR(p.x * p.x + p.y * p.y - p.z * p.z, 1, 1e-6);
    EXPECT_NEAR(length(cross(normalize(gradient), normalize(n))), 0, 1e-6);
  }
}

// pbrt-v3 knows hyperboloids with their waist at z = 0 alone: of a line that is nearest to the axis elsewhere
// it shows the one through p2 and 2p2 − p1.
TEST(PbrtShapes, TheWaistOfAHyperboloidIsWhereZIs0) {
  const TriangleMesh mesh =
      import_v3("Shape \"hyperboloid\" \"point p1\" [3 1.2 1] \"point p2\" [.65 -.5 -1]").scene.meshes.at(0);
  const double end = .65 * .65 + .5 * .5, other = 1.7 * 1.7 + 2.2 * 2.2;  // at z = −1 and −3
  const double a = 8 / (9 * end - other), c = a * end - 1;
  EXPECT_NEAR(a * other - c * 9, 1, 1e-12);
  for (const Point3f& position : mesh.positions) {
    const Point3d p = cast<double>(position);
    const double squared = std::max(0.0, (1 + c * p.z * p.z) / a);
    EXPECT_NEAR(p.x * p.x + p.y * p.y, squared, 1e-5);
  }
}

TEST(PbrtShapes, AHyperboloidThatEndsAtZ0BeginsThere) {
  const std::string shape = "Shape \"hyperboloid\" ";
  const TriangleMesh upwards =
      import_v3(shape + "\"point p1\" [1 0 0] \"point p2\" [1 1 1]").scene.meshes.at(0);
  const TriangleMesh downwards =
      import_v3(shape + "\"point p1\" [1 1 1] \"point p2\" [1 0 0]").scene.meshes.at(0);
  EXPECT_EQ(upwards.positions, downwards.positions);
  EXPECT_EQ(upwards.positions[0], (Point3f{1, 0, 0}));
}

TEST(PbrtShapes, WithoutPointsAreLeftOut) {
  const ImportedScene imported =
      import_v4("Shape \"trianglemesh\" \"integer indices\" [] \"point3 P\" []\n" + triangle);
  EXPECT_EQ(imported.scene.shapes.size(), 1u);
  EXPECT_TRUE(mentions(imported.diagnostics, "has no points"));
}

// Only in v3.
TEST(PbrtShapes, ChangeTheColoursOfTheirMaterial) {
  const std::string world =
      "Texture \"t\" \"color\" \"checkerboard\"\n"
      "Material \"matte\" \"texture Kd\" \"t\" \"float sigma\" 20\n"
      "Shape \"sphere\" \"rgb Kd\" [.1 .2 .3]\nShape \"sphere\"\n";
  const ImportedScene imported = import_v3(world);
  expect_no_diagnostics(imported);
  const auto material = [&](std::size_t shape) {
    const Id<Material> id = imported.scene.shapes.at(shape).material;
    return std::get<DiffuseMaterial>(imported.scene.materials.at(id.value).model);
  };
  EXPECT_EQ(material(0).reflectance, SpectrumParameter{reflectance_from_rgb({0.1, 0.2, 0.3})});
  EXPECT_EQ(material(0).sigma_deg, FloatParameter{20.0f});
  EXPECT_EQ(material(1).reflectance, SpectrumParameter{Id<Texture>{0}});
  EXPECT_TRUE(
      mentions(import_v4("Material \"diffuse\"\nShape \"sphere\" \"rgb reflectance\" [.1 .2 .3]").diagnostics,
               "is not used"));
}

}  // namespace
}  // namespace vitrail::pbrt_shapes_test
