// SPDX-License-Identifier: Apache-2.0
// The door for all formats, and the view that geometry alone gets.
#include "importers/import.h"

#include <numbers>

#include "images/image_files.h"
#include "importers/readers.h"
#include "importers/reading/default_view.h"
#include "scene/spectra/color.h"
#include "scene/spectra/spectrum.h"
#include "tests/importers/pbrt/pbrt_text.h"

namespace vitrail::import_test {
namespace {

const std::string ply =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n100 0 0\n101 0 0\n100 5 0\n3 0 1 "
    "2\n";

// Camera space coordinates of a point, by depth.
Point3d seen(const Scene& scene, Point3d p) {
  const Point3d c = transform_point(inverse(std::get<PerspectiveCamera>(scene.camera).camera_to_world), p);
  return {c.x / c.z, c.y / c.z, c.z};
}

TEST(ImportScene, GoesByTheNameOfTheFile) {
  const TemporaryFolder folder;
  EXPECT_EQ(import_scene(folder.write("a.pbrt", "Film \"rgb\" WorldBegin " + triangle)).scene.shapes.size(),
            1u);
  EXPECT_EQ(import_scene(folder.write("a.PLY", ply)).scene.shapes.size(), 1u);
  EXPECT_EQ(import_scene(folder.write("a.ply.gz", ply)).scene.shapes.size(), 1u);
  EXPECT_EQ(import_scene(folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")).scene.shapes.size(),
            1u);
  EXPECT_THROW(import_scene(folder.write("a.blend", "BLENDER-v300")), Error);
  EXPECT_THROW(import_scene(folder.path() / "none.pbrt"), Error);
}

TEST(ImportScene, KnowsFilesWithoutASuffixByTheirFirstBytes) {
  const TemporaryFolder folder;
  EXPECT_EQ(import_scene(folder.write("mesh", ply)).scene.shapes.size(), 1u);
  EXPECT_EQ(
      import_scene(folder.write("scene.txt", "<scene version=\"3.0.0\"><shape type=\"sphere\"/></scene>"))
          .scene.shapes.size(),
      1u);
  try {
    import_scene(folder.write("what", "neither"));
    FAIL();
  } catch (const Error& error) {
    for (const Reader& reader : readers())
      EXPECT_NE(std::string(error.what()).find(reader.suffixes.front()), std::string::npos) << reader.name;
  }
}

TEST(ImportScene, RefusesOptionsThatTheFormatHasNoUseFor) {
  const TemporaryFolder folder;
  ImportOptions camera;
  camera.camera = 1;
  EXPECT_THROW(import_scene(folder.write("a.ply", ply), MeshMemory{}, {}, camera), UsageError);
  ImportOptions definitions;
  definitions.definitions["a"] = "1";
  EXPECT_THROW(import_scene(folder.write("a.ply", ply), MeshMemory{}, {}, definitions), UsageError);
}

TEST(ImportScene, SaysWhichCurvesBecomeTubes) {
  const TemporaryFolder folder;
  const std::string curve =
      "Shape \"curve\" \"string type\" \"cylinder\" \"point3 P\" [0 0 0 1 0 0 2 1 0 3 1 0] ";
  const auto said = [&](const std::string& world, const char* what) {
    return mentions(import_scene(folder.write("a.pbrt", "Film \"rgb\" WorldBegin " + world)).diagnostics,
                    what);
  };
  const std::string object = "ObjectBegin \"a\" " + curve + "ObjectEnd ";
  EXPECT_FALSE(said("Scale 2 2 -2 " + curve, "tubes of triangles"));
  EXPECT_TRUE(said("Scale 2 2 3 " + curve, "that no similarity places, become tubes"));
  EXPECT_TRUE(said("AreaLightSource \"diffuse\" " + curve, "curves that shine"));
  EXPECT_FALSE(said(object + "Scale 2 2 2 ObjectInstance \"a\"", "tubes of triangles"));
  EXPECT_TRUE(said(object + "Scale 2 2 3 ObjectInstance \"a\"", "curves that are stretched"));
  EXPECT_FALSE(said("ObjectBegin \"a\" " + triangle + " ObjectEnd Scale 2 2 3 ObjectInstance \"a\"",
                    "curves that are stretched"));
}

TEST(ImportScene, ShowsAllOfGeometryAloneUnderASky) {
  const TemporaryFolder folder;
  const ImportedScene imported = import_scene(folder.write("a.ply", ply));
  EXPECT_TRUE(mentions(imported.diagnostics, "no camera"));
  EXPECT_TRUE(mentions(imported.diagnostics, "no light"));
  const ScreenWindow screen = std::get<PerspectiveCamera>(imported.scene.camera).screen;
  EXPECT_NEAR((screen.x1 - screen.x0) / (screen.y1 - screen.y0), 1280.0 / 720, 1e-9);
  for (const Point3d p : {Point3d{100, 0, 0}, Point3d{101, 0, 0}, Point3d{100, 5, 0}}) {
    const Point3d s = seen(imported.scene, p);
    EXPECT_GT(s.z, 0);
    EXPECT_LT(std::abs(s.x), screen.x1);
    EXPECT_LT(std::abs(s.y), screen.y1);
  }
  EXPECT_GT(seen(imported.scene, {100, 5, 0}).y, seen(imported.scene, {100, 0, 0}).y) << "+y is up";
  EXPECT_GT(seen(imported.scene, {101, 0, 0}).x, seen(imported.scene, {100, 0, 0}).x)
      << "and +x right: not mirrored";
  ASSERT_EQ(imported.scene.lights.size(), 3u);
  // Together 1 where a white surface faces sun and camera, and dimmer elsewhere, so that shapes can be seen.
  const double sky = luminance(std::get<InfiniteLight>(imported.scene.lights.at(0).model).radiance);
  const DistantLight& sun = std::get<DistantLight>(imported.scene.lights.at(1).model);
  const DistantLight& from_camera = std::get<DistantLight>(imported.scene.lights.at(2).model);
  EXPECT_NEAR(sky + luminance(sun.irradiance) / std::numbers::pi +
                  luminance(from_camera.irradiance) / std::numbers::pi,
              1, 1e-3);
  EXPECT_GT(luminance(from_camera.irradiance), 0) << "white turned to the camera is no sky";
  const Vector3d view =
      transform_vector(std::get<PerspectiveCamera>(imported.scene.camera).camera_to_world, {0, 0, 1});
  EXPECT_NEAR(dot(from_camera.direction, normalize(view)), 1, 1e-9);
  EXPECT_LT(sky, 0.5);
  EXPECT_LT(sun.direction.y, 0) << "it shines down";
}

// Of 8 bits, in sRGB's encoding, as programs that scan have them.
TEST(ImportScene, ShowsTheColoursOfAPly) {
  const TemporaryFolder folder;
  const std::string colored =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\nproperty float "
      "quality\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0 255 128 0 255 1\n1 0 0 0 0 0 255 1\n0 1 0 255 255 255 255 1\n3 0 1 2\n";
  const ImportedScene imported = import_scene(folder.write("a.ply", colored));
  const auto& diffuse = std::get<DiffuseMaterial>(imported.scene.materials.at(0).model);
  const Texture& texture = imported.scene.textures.at(std::get<Id<Texture>>(diffuse.reflectance).value);
  EXPECT_EQ(std::get<MeshAttributeTexture>(texture.model).name, "vertex_color");
  const TriangleMesh& mesh = imported.scene.meshes.at(0);
  ASSERT_EQ(mesh.attributes.size(), 1u);
  const auto half = static_cast<float>(srgb_decode(128 / 255.0));
  EXPECT_EQ(mesh.attributes[0].values, (std::vector<float>{1, half, 0, 0, 0, 0, 1, 1, 1}));
  EXPECT_TRUE(mentions(imported.diagnostics, "property quality"));
  EXPECT_FALSE(mentions(imported.diagnostics, "property red"));
  EXPECT_TRUE(import_scene(folder.write("b.ply", ply)).scene.textures.empty());
}

TEST(ImportScene, AddsNoSkyWhereSomethingShines) {
  const TemporaryFolder folder;
  const ImportedScene imported =
      read_pbrt(folder.write("part.pbrt", "AreaLightSource \"diffuse\" " + triangle));
  EXPECT_TRUE(imported.scene.lights.empty());
  EXPECT_FALSE(mentions(imported.diagnostics, "no light"));
}

TEST(ImportScene, NamesAllLostImages) {
  const TemporaryFolder folder;
  const auto file =
      folder.write("scene.pbrt",
                   "Camera \"perspective\" Film \"rgb\" WorldBegin LightSource \"infinite\" \"string "
                   "filename\" \"sky.exr\"\n"
                   "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"wood.png\" "
                   "Material \"diffuse\" \"texture reflectance\" \"t\" Shape \"sphere\"");
  try {
    import_scene(file);
    ADD_FAILURE() << "it has lost images";
  } catch (const Error& error) {
    EXPECT_EQ(error.location.line, 2);
    const std::string what = error.what();
    for (const char* part : {"wood.png\", nor", "sky.exr\" of ", "scene.pbrt:1:", "; --missing=replace"})
      EXPECT_NE(what.find(part), std::string::npos) << what;
  }
}

// A scene with lost files can be seen where the user asks for it, and is refused with a hint where not.
TEST(ImportScene, GoesOnWithoutLostFiles) {
  const TemporaryFolder folder;
  const auto pbrt =
      folder.write("scene.pbrt",
                   "Camera \"perspective\" Film \"rgb\" WorldBegin LightSource \"infinite\" \"string "
                   "filename\" \"sky.exr\" "
                   "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"wood.png\" "
                   "Material \"diffuse\" \"texture reflectance\" \"t\" \"string normalmap\" \"n.png\" "
                   "Shape \"plymesh\" \"string filename\" \"lost.ply\" Shape \"sphere\"");
  const auto mitsuba = folder.write(
      "scene.xml",
      "<scene version=\"3.0.0\"><emitter type=\"envmap\"><string name=\"filename\" "
      "value=\"sky.exr\"/></emitter>"
      "<bsdf type=\"normalmap\" id=\"m\"><texture type=\"bitmap\"><boolean name=\"raw\" value=\"true\"/>"
      "<string name=\"filename\" value=\"n.png\"/></texture><bsdf type=\"diffuse\"><texture type=\"bitmap\" "
      "name=\"reflectance\"><string name=\"filename\" value=\"wood.png\"/></texture></bsdf></bsdf>"
      "<shape type=\"obj\"><string name=\"filename\" value=\"lost.obj\"/><ref id=\"m\"/></shape>"
      "<shape type=\"sphere\"><ref id=\"m\"/></shape></scene>");
  for (const auto& file : {pbrt, mitsuba}) {
    SCOPED_TRACE(file.string());
    try {
      import_scene(file);
      ADD_FAILURE() << "it has lost files";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("--missing=replace"), std::string::npos) << error.what();
    }
    const ImportedScene imported =
        import_scene(file, MeshMemory{}, {}, {.definitions = {}, .replace_missing = true});
    EXPECT_EQ(imported.scene.shapes.size(), 1u);
    for (const char* lost : {"sky.exr", "wood.png", "lost."})
      EXPECT_TRUE(std::any_of(imported.diagnostics.begin(), imported.diagnostics.end(),
                              [&](const Diagnostic& d) {
                                return d.fidelity == Fidelity::dropped &&
                                       d.message.find(lost) != std::string::npos &&
                                       d.message.find("cannot find") != std::string::npos;
                              }))
          << lost;
    for (const Material& material : imported.scene.materials) EXPECT_FALSE(material.normal_map);
    ASSERT_EQ(imported.scene.lights.size(), 1u);
    EXPECT_TRUE(std::holds_alternative<InfiniteLight>(imported.scene.lights[0].model));
    for (const Texture& texture : imported.scene.textures)
      EXPECT_FALSE(std::holds_alternative<ImageTexture>(texture.model));
  }
}

// Of a plate that is half as high as the box around it is wide; its lamp has the emission Ke and its map.
double lights_of(const TemporaryFolder& folder, const std::string& emission) {
  folder.write("a.mtl", "newmtl a\nKd .8 .2 .1\n" + emission);
  return static_cast<double>(
      import_scene(
          folder.write(
              "a.obj",
              "mtllib a.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt "
              "0 1\nf 1/1 2/2 3/3 4/4\n"))
          .scene.lights.size());
}

TEST(DefaultLight, IsAddedWhereLampsHaveNoPower) {
  const TemporaryFolder folder;
  write_exr_image(folder.path() / "black.exr", black_image(2, 2, 3));
  Image one_white = black_image(2, 2, 3);
  one_white.values[0] = one_white.values[1] = one_white.values[2] = 1;
  write_exr_image(folder.path() / "corner.exr", one_white);
  EXPECT_EQ(lights_of(folder, ""), 3);
  EXPECT_EQ(lights_of(folder, "Ke 1 1 1\n"), 0);
  EXPECT_EQ(lights_of(folder, "Ke .001 .001 .001\n"), 3) << "black in a picture of 8 bits";
  EXPECT_EQ(lights_of(folder, "Ke .1 .1 .1\n"), 0);
  EXPECT_EQ(lights_of(folder, "Ke 1 1 1\nmap_Ke black.exr\n"), 3);
  EXPECT_EQ(lights_of(folder, "Ke 1 1 1\nmap_Ke corner.exr\n"), 0) << "a quarter shines";
  EXPECT_EQ(lights_of(folder, "Ke .01 .01 .01\nmap_Ke corner.exr\n"), 3);
}

TEST(DefaultLight, SaysWhy) {
  const TemporaryFolder folder;
  folder.write("a.mtl", "newmtl a\nKe 1e-4 1e-4 1e-4\n");
  const std::string obj = "mtllib a.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  EXPECT_TRUE(mentions(import_scene(folder.write("a.obj", obj)).diagnostics, "lamps light nearly nothing"));
}

// The view of a box is that of the quadrics in it: an ellipsoid, half a sphere, a disk that lies askew, and
// two spheres in an instance.
TEST(DefaultView, SeesQuadricsByTheirExtent) {
  const auto camera_of = [](ImportedScene imported) {
    add_default_view(imported, "a.xml");
    return std::get<PerspectiveCamera>(imported.scene.camera).camera_to_world;
  };
  const auto of_box = [&](Bounds3f box) {
    ImportedScene imported;
    imported.scene.meshes.push_back({{box.lower, box.upper}, {{0, 1, 0}}});
    imported.scene.shapes.emplace_back();
    return camera_of(imported);
  };
  const auto of_quadric = [&](const Quadric& quadric, const Transform& to_world) {
    ImportedScene imported;
    imported.scene.meshes.emplace_back().quadric = quadric;
    imported.scene.shapes.emplace_back().object_to_world = to_world;
    return camera_of(imported);
  };
  const auto expect_alike = [](const Transform& a, const Transform& b) {
    for (std::size_t row = 0; row < 3; ++row)
      for (std::size_t column = 0; column < 4; ++column)
        EXPECT_NEAR(a.m[row][column], b.m[row][column], 1e-5);
  };
  const Quadric sphere{.kind = QuadricKind::sphere};
  expect_alike(of_quadric(sphere, translate({10, 0, 0}) * scale({2, 1, 3})),
               of_box({{8, -1, -3}, {12, 1, 3}}));
  expect_alike(of_quadric({.kind = QuadricKind::sphere, .low = 0}, {}), of_box({{-1, -1, 0}, {1, 1, 1}}));
  const float half = std::sqrt(.5f);
  expect_alike(of_quadric({.kind = QuadricKind::disk, .low = 0}, rotate(std::numbers::pi / 4, {0, 1, 0})),
               of_box({{-half, -1, -half}, {half, 1, half}}));
  ImportedScene imported;
  imported.scene.meshes.emplace_back().quadric = sphere;
  Prototype pair;
  for (const double x : {-2, 2}) pair.shapes.emplace_back().object_to_world = translate({x, 0, 0});
  imported.scene.prototypes.push_back(pair);
  imported.scene.instances.push_back({Id<Prototype>{0}, scale({2, 2, 2}), {}});
  expect_alike(camera_of(imported), of_box({{-6, -2, -2}, {6, 2, 2}}));
}

}  // namespace
}  // namespace vitrail::import_test
