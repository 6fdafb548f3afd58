// SPDX-License-Identifier: Apache-2.0
#include "importers/obj/write/write_obj.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "importers/obj/read/obj.h"
#include "scene/shapes/deferred_mesh.h"
#include "scene/spectra/color.h"
#include "scene/spectra/rgb_to_spectrum.h"
#include "tests/importers/temporary_folder.h"
#include "tests/support/paths.h"
#include "tests/support/png.h"

namespace vitrail::write_obj_test {
namespace {

using testing::Contains;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using Triangle = std::array<std::uint32_t, 3>;

auto says(const std::string& text) { return Contains(Field(&Diagnostic::message, HasSubstr(text))); }

class WriteObj : public testing::Test {
 protected:
  Scene written(const Scene& scene) {
    diagnostics_ = write_obj(scene, folder_ / "out.obj");
    return read_obj(folder_ / "out.obj").scene;
  }

  // What is read stays as it is.
  void expect_same(const std::string& obj, const std::string& mtl = "") {
    folder_.write("m.mtl", mtl);
    const Scene scene = read_obj(folder_.write("in.obj", "mtllib m.mtl\n" + obj)).scene;
    const Scene again = written(scene);
    EXPECT_EQ(again.meshes, scene.meshes) << mtl;
    EXPECT_EQ(again.textures, scene.textures) << mtl;
    std::vector<AreaLight> lights = scene.area_lights;
    for (AreaLight& light : lights) std::ranges::replace(light.name, ' ', '_');  // in names of objects
    EXPECT_EQ(again.area_lights, lights) << mtl;
    ASSERT_EQ(again.materials.size(), scene.materials.size()) << mtl;
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
      if (mtl.empty()) continue;  // the 0.5 of faces without a material is constant, that of Kd a colour
      EXPECT_EQ(again.materials[i].model, scene.materials[i].model) << mtl;
      EXPECT_EQ(again.materials[i].displacement, scene.materials[i].displacement) << mtl;
      EXPECT_EQ(again.materials[i].normal_map, scene.materials[i].normal_map) << mtl;
      if (!scene.materials[i].name.empty()) {
        EXPECT_EQ(again.materials[i].name, scene.materials[i].name);
      }
    }
    ASSERT_EQ(again.shapes.size(), scene.shapes.size());
    for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
      EXPECT_EQ(again.shapes[i].object_to_world, scene.shapes[i].object_to_world);
      EXPECT_EQ(again.shapes[i].area_light, scene.shapes[i].area_light);
      if (!scene.shapes[i].name.empty()) {
        EXPECT_EQ(again.shapes[i].name, scene.shapes[i].name);
      }
    }
  }

  static Scene triangle() {
    Scene scene;
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}};
    scene.meshes.push_back(mesh);
    scene.materials.push_back(Material{DiffuseMaterial{}});
    scene.shapes.push_back({});
    return scene;
  }

  const std::string square_ = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  TemporaryFolder folder_;
  Diagnostics diagnostics_;
};

TEST_F(WriteObj, GeometryOfItsOwnReaderStaysBitForBit) {
  expect_same(
      "v .1 .2 .3\nv 1e-30 16777217 -3.4e38\nv 0.333333333 1e10 7\nvt .1 .7\nvn .1 .2 .9\nf 1 2 3\n"
      "usemtl a\nf 1/1 2/1 3/1\nusemtl b\nf 1//1 2//1 3//1\nf 1/1/1 2/1/1 3/1/1\nf 3 2 1\n");
  EXPECT_THAT(diagnostics_, IsEmpty());
}

// In sRGB's encoding behind the positions; readers take them where no library defines the material.
TEST_F(WriteObj, NamesOfObjectsAndLampsStay) {
  const std::string mtl = "newmtl glow\nKd 0 0 0\nKe 1 1 1\nnewmtl red\nKd 0 0 0\nKe 2 0 0\n";
  for (const char* objects :
       {"usemtl glow\nf 1 2 3\nf 1/1 2/1 3/1\nusemtl red\nf 1 2 4\n",
        "o left\nusemtl glow\nf 1 2 3\no right\nusemtl glow\nf 1 2 4\n",
        "o lamp\nusemtl glow\nf 1 2 3\nusemtl red\nf 1 2 4\no other\nusemtl glow\nf 2 3 4\n"}) {
    expect_same(square_ + "vt 0 0\n" + objects, mtl);
    EXPECT_THAT(diagnostics_, IsEmpty());
  }
}

TEST_F(WriteObj, ColoursOfVertices) {
  const Scene scene =
      read_obj(folder_.write("in.obj", "v 0 0 0 1 .5 0\nv 1 0 0 0 0 1\nv 0 1 .1 .2 .2 .2\nf 1 2 3\n")).scene;
  const Scene again = written(scene);
  EXPECT_THAT(diagnostics_, IsEmpty());
  EXPECT_EQ(again.textures, scene.textures);
  EXPECT_EQ(again.materials.at(0).model, scene.materials.at(0).model);
  EXPECT_EQ(again.meshes.at(0).positions, scene.meshes.at(0).positions);
  const std::vector<float>& values = again.meshes[0].attributes.at(0).values;
  ASSERT_EQ(values.size(), 9u);
  EXPECT_NEAR(values[1], srgb_decode(.5), 1e-6);
  EXPECT_NEAR(values[8], srgb_decode(.2), 1e-6);
  Scene bright = scene;
  bright.meshes[0].attributes[0].values[0] = 2;
  EXPECT_EQ(written(bright).meshes.at(0).attributes.at(0).values[0], 1);
  EXPECT_THAT(diagnostics_, says("outside of 0 to 1"));
  Scene other = scene;
  other.meshes[0].attributes[0].name = "vertex_heat";
  EXPECT_TRUE(written(other).meshes.at(0).attributes.empty());
  EXPECT_THAT(diagnostics_, says("colours of vertices alone"));
}

TEST_F(WriteObj, FarFromTheOriginToo) {
  expect_same("v 5000000.001 0 .125\nv 5000000.002 0 0\nv 5000000.001 0.0017 0\nf 1 2 3\n");
  expect_same("v 123456.789 98765.4321 -4321.5\nv 123457.1 98765.5 -4322\nv 123456.8 98766 -4321\nf 1 2 3\n");
}

TEST_F(WriteObj, MaterialsOfItsOwnReaderStay) {
  folder_.write("a b.png", "");
  folder_.write("c.png", "");
  for (const std::string text : {"Kd .2 .4 .6\n",
                                 "Kd 0.1 0.123456789 1\nKe 2 3 .1\n",
                                 "Kd .5\nKs .25 .5 .125\nNs 37.5\nNi 1.45\n",
                                 "Kd .5\nKs 1 1 1\nNs 0\n",
                                 "Kd 0 0 0\nKs .9 .8 .1\nNs 198\nillum 3\n",
                                 "illum 7\nNi 1.5\n",
                                 "d .1\nNi 1.33\nTf .5 1 .25\n",
                                 "illum 7\nNi 1.5\nPr .3\n",
                                 "d 0\n",
                                 "Kd 1 1 1\nd .25\n",
                                 "Kd 1 1 1\nKs .5\nNs 10\nd .25\n",
                                 "Kd 1 1 1\nNi 1.45\nmap_d c.png\n",
                                 "Kd 1 1 1\nd .5\nmap_d c.png\n",
                                 "map_Kd a b.png\n",
                                 "Kd .25 .25 .25\nmap_Kd -s 2 3 1 -o .5 .25 0 -clamp on a b.png\n",
                                 "Kd .2 .4 .6\nmap_Kd a b.png\n",
                                 "Kd 1 1 1\nKs .5\nmap_Ks c.png\nNs 5\n",
                                 "Kd 1 1 1\nmap_Bump -bm .25 c.png\nnorm c.png\n",
                                 "Kd 1 1 1\nKe 2 2 2\nmap_Ke c.png\n",
                                 "Kd .2 .4 .6\nPr .25\nPm .5\nPs .125\nPc 1\nPcr .25\naniso .75\nNi 1.6\n",
                                 "Kd .2 .4 .6\nmap_Pr c.png\nmap_Pm -mm 0 .5 c.png\n",
                                 "Kd .2 .4 .6\nmap_Pr -imfchan g c.png\nmap_d -imfchan l c.png\n"}) {
    expect_same(square_ + "usemtl my m\nf 1 2 3 4\n", "newmtl my m\n" + text);
    EXPECT_THAT(diagnostics_, IsEmpty()) << text << diagnostics_[0].message;
  }
}

TEST_F(WriteObj, WhichNumberAnImageIs) {
  test::write_png(folder_ / "a.png", 1, 1, 3, {1, 2, 3});
  Scene scene = triangle();
  ImageTexture image{(folder_ / "a.png").string()};
  image.encoding = Encoding::linear;
  image.number = ImageNumber::mean;
  scene.textures.push_back({image, true});
  PrincipledMaterial material;
  material.roughness = Id<Texture>{0};
  scene.materials[0].model = material;
  written(scene);
  EXPECT_THAT(diagnostics_, says("channels of the image of map_Pr"));
  test::write_png(folder_ / "a.png", 1, 1, 3, {2, 2, 2});
  written(scene);
  EXPECT_THAT(diagnostics_, Not(says("channels of the image")));
}

// A tint of any writer's making: pbrt's is behind the image.
TEST_F(WriteObj, ATintedImageKeepsItsImage) {
  folder_.write("a.png", "");
  Scene scene = triangle();
  scene.textures.push_back({ImageTexture{(folder_ / "a.png").string()}, false});
  scene.textures.push_back({ProductTexture{Id<Texture>{0}, Spectrum{ConstantSpectrum{.5f}}}, false});
  scene.materials[0].model = DiffuseMaterial{Id<Texture>{1}};
  const Scene again = written(scene);
  const auto& found = std::get<ImageTexture>(again.textures.at(0).model);
  EXPECT_EQ(found.scale, .5f);
  EXPECT_EQ(std::filesystem::path(found.filename).filename(), "a.png");
}

TEST_F(WriteObj, TransformsFlipsAndInstances) {
  Scene scene = triangle();
  scene.meshes[0].normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
  scene.shapes[0].object_to_world = scale({2, 1, 1});
  scene.shapes[0].flip_orientation = true;
  scene.prototypes.push_back({"p", {scene.shapes[0]}});
  scene.shapes.clear();
  scene.instances.push_back({{0}, translate({0, 0, 5}) * scale({1, -1, 1})});
  const Scene again = written(scene);
  ASSERT_THAT(again.meshes, SizeIs(1));
  const TriangleMesh& mesh = again.meshes[0];
  const auto at = [&](int corner) {
    return transform_point(again.shapes[0].object_to_world,
                           cast<double>(mesh.positions[mesh.triangles[0][static_cast<std::size_t>(corner)]]));
  };
  EXPECT_EQ(at(0), (Point3d{0, 0, 5}));
  // Clockwise was its front; the mirror turns that to counter-clockwise.
  EXPECT_EQ(at(1), (Point3d{2, 0, 5}));
  EXPECT_EQ(at(2), (Point3d{0, -1, 5}));
  EXPECT_THAT(diagnostics_, says("1 instances"));
}

TEST_F(WriteObj, InstancesShareTheirUvs) {
  Scene scene = triangle();
  scene.meshes[0].uvs = {{0, 0}, {.25f, 0}, {0, .75f}};
  scene.shapes.push_back(scene.shapes[0]);
  scene.prototypes.push_back({"p", {scene.shapes[0]}});
  for (const double z : {1.0, 2.0}) scene.instances.push_back({{0}, translate({0, 0, z})});
  const Scene again = written(scene);
  std::ifstream file(folder_ / "out.obj");
  int lines = 0;
  for (std::string line; std::getline(file, line);) lines += line.starts_with("vt ");
  EXPECT_EQ(lines, 3);
  std::size_t triangles = 0;
  for (const TriangleMesh& mesh : again.meshes)
    for (const auto& t : mesh.triangles) {
      ++triangles;
      for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(mesh.uvs.at(t[k]), scene.meshes[0].uvs[k]);
    }
  EXPECT_EQ(triangles, 4u);
}

TEST_F(WriteObj, QuadricsAreWrittenAsTriangles) {
  Scene scene = triangle();
  TriangleMesh quadric;
  quadric.quadric = Quadric{.kind = QuadricKind::cylinder};
  scene.meshes.push_back(quadric);
  scene.shapes.push_back(scene.shapes[0]);
  scene.shapes.back().mesh = Id<TriangleMesh>{1};
  scene.shapes.back().object_to_world = translate({0, 0, 2});
  const Scene again = written(scene);
  EXPECT_THAT(diagnostics_, says("a cylinder becomes triangles, 256 for a full turn"));
  EXPECT_THAT(again.meshes, SizeIs(2));
  EXPECT_THAT(again.meshes.back().triangles, SizeIs(2 * 256));
  EXPECT_EQ(bounds_of(again.meshes.back()), (Bounds3f{{-1, -1, 2}, {1, 1, 3}}));
}

TEST_F(WriteObj, NamesAreUniqueAndOnOneLine) {
  Scene scene = triangle();
  scene.materials[0].name = "a";
  scene.materials.push_back({DiffuseMaterial{reflectance_from_rgb({1, 0, 0})}});
  scene.materials[1].name = "a";
  scene.materials.push_back({DiffuseMaterial{reflectance_from_rgb({0, 1, 0})}});
  scene.materials[2].name = " b\nc ";
  for (std::uint32_t i = 1; i < 3; ++i) {
    scene.shapes.push_back({});
    scene.shapes[i].material = {i};
  }
  scene.shapes[0].name = "one two";
  const Scene again = written(scene);
  ASSERT_THAT(again.materials, SizeIs(3));
  EXPECT_EQ(again.materials[1].name, "a_2");
  EXPECT_EQ(again.materials[2].name, "b_c");
  for (std::size_t i = 0; i < 3; ++i)
    if (i > 0) {
      EXPECT_EQ(again.materials[i].model, scene.materials[i].model);
    }
  std::ifstream in(folder_ / "out.obj");
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  EXPECT_THAT(text, HasSubstr("o one_two\n"));
}

TEST_F(WriteObj, WhatIsLostIsSaidWithItsPlace) {
  Scene scene = triangle();
  scene.files = {"in.pbrt"};
  scene.camera_origin = {0, 1, 1};
  scene.lights.push_back({PointLight{{0, 0, 1}, ConstantSpectrum{1}}, {0, 5, 3}});
  scene.media.push_back({"fog"});
  scene.materials[0] = {CoatedDiffuseMaterial{}};
  scene.materials[0].origin = {0, 7, 2};
  scene.materials[0].two_sided = false;
  scene.area_lights.push_back({Spectrum{BlackbodySpectrum{}}});
  scene.shapes[0].area_light = Id<AreaLight>{0};
  const Scene again = written(scene);
  for (const std::string text : {"camera", "light: ", "medium fog", "coated diffuse", "MTL has no sides",
                                 "GGX", "smooth surface", "spectrum", "one-sided light"})
    EXPECT_THAT(diagnostics_, says(text));
  for (const Diagnostic& d : diagnostics_) {
    if (d.message.starts_with("light: ")) {
      EXPECT_EQ(to_string(d.location), "in.pbrt:5:3");
    }
    if (d.message.starts_with("coated")) {
      EXPECT_EQ(to_string(d.item), "in.pbrt:7:2");
    }
  }
  EXPECT_THAT(again.area_lights, SizeIs(1));
}

// Every kind of material becomes something, and textures never refer to nothing.
TEST_F(WriteObj, AllMaterials) {
  std::vector<MaterialModel> models{DiffuseMaterial{},
                                    DielectricMaterial{},
                                    ThinDielectricMaterial{},
                                    ConductorMaterial{},
                                    PlasticMaterial{},
                                    CoatedDiffuseMaterial{},
                                    CoatedConductorMaterial{},
                                    DiffuseTransmissionMaterial{},
                                    PrincipledMaterial{},
                                    SubsurfaceMaterial{},
                                    HairMaterial{},
                                    MeasuredMaterial{},
                                    TabulatedMaterial{},
                                    SlabMaterial{},
                                    InterfaceMaterial{}};
  Scene scene = triangle();
  for (MaterialModel& model : models) scene.materials.push_back({std::move(model)});
  scene.materials.push_back({BlendMaterial{{1}, {2}, 0.75f}});
  scene.materials.push_back({MaskMaterial{0.5f, {3}}});
  scene.materials.push_back({TwoSidedMaterial{{4}, {5}}});
  for (std::uint32_t i = 1; i < scene.materials.size(); ++i) {
    scene.shapes.push_back({});
    scene.shapes.back().material = {i};
  }
  EXPECT_THAT(written(scene).shapes, SizeIs(scene.shapes.size()));
}

// MTL has an opacity of materials: shapes that differ in theirs have materials of their own.
TEST_F(WriteObj, OpacitiesOfShapes) {
  Scene scene = triangle();
  scene.materials = {{DiffuseMaterial{}}, {MaskMaterial{0.5f, {0}}}, {DielectricMaterial{}}};
  scene.shapes.resize(4, scene.shapes[0]);
  scene.shapes[1].opacity = scene.shapes[2].opacity = scene.shapes[3].opacity = 0.25f;
  scene.shapes[2].material = {1};
  scene.shapes[3].material = {2};
  const Scene again = written(scene);
  const auto model = [&](std::size_t shape) {
    return again.materials.at(again.shapes.at(shape).material.value).model;
  };
  EXPECT_TRUE(std::holds_alternative<DiffuseMaterial>(model(0)));
  EXPECT_EQ(std::get<MaskMaterial>(model(1)).opacity, FloatParameter{0.25f});
  EXPECT_EQ(std::get<MaskMaterial>(model(2)).opacity, FloatParameter{0.125f});
  EXPECT_TRUE(std::holds_alternative<ThinDielectricMaterial>(model(3)));  // of one face
  EXPECT_THAT(diagnostics_, says("glass of which"));
}

// ---- Files of others ----------------------------------------------------------------------------

// Vertices that no face uses are not written. Far from the origin they have a part in the place that a file
// is moved to: another one rounds the positions differently.
void expect_same_places(const Scene& a, const Scene& b, const std::string& what) {
  ASSERT_EQ(a.meshes.size(), b.meshes.size()) << what;
  for (std::size_t i = 0; i < a.shapes.size(); ++i) {
    const TriangleMesh &m = a.meshes[i], &n = b.meshes[i];
    const Transform &t = a.shapes[i].object_to_world, &u = b.shapes[i].object_to_world;
    if (t == u) {
      EXPECT_EQ(m, n) << what;
      continue;
    }
    EXPECT_EQ(m.triangles, n.triangles) << what;
    ASSERT_EQ(m.positions.size(), n.positions.size()) << what;
    for (std::size_t k = 0; k < m.positions.size(); ++k) {
      const Point3d p = transform_point(t, cast<double>(m.positions[k]));
      EXPECT_LE(length(p - transform_point(u, cast<double>(n.positions[k]))), 1e-7 * length(p - Point3d{}))
          << what;
    }
  }
}

TEST(WriteObjCorpus, MeshesAndMaterialsComeBack) {
  const char* const named = std::getenv("VITRAIL_CORPUS");
  const std::filesystem::path corpus = named ? named : test::project_file("../shared/corpus");
  if (!std::filesystem::is_directory(corpus / "obj"))
    GTEST_SKIP() << "no corpus at " << corpus << " (set VITRAIL_CORPUS)";
  const TemporaryFolder folder;
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(corpus / "obj")) {
    if (entry.path().extension() != ".obj") continue;
    Scene scene;
    try {
      scene = read_obj(entry.path()).scene;
    } catch (const Error&) {
      continue;
    }
    write_obj(scene, folder / "out.obj");
    const Scene again = read_obj(folder / "out.obj").scene;
    expect_same_places(scene, again, entry.path().string());
    EXPECT_EQ(again.textures, scene.textures) << entry.path();
    EXPECT_EQ(again.area_lights, scene.area_lights) << entry.path();
    ASSERT_EQ(again.materials.size(), scene.materials.size()) << entry.path();
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
      if (scene.materials[i].origin.line > 0 &&
          scene.materials[i].model != MaterialModel{DiffuseMaterial{}}) {
        EXPECT_EQ(again.materials[i].model, scene.materials[i].model) << entry.path();
      }
    ++count;
  }
  EXPECT_GT(count, 0);
}

}  // namespace
}  // namespace vitrail::write_obj_test
