// SPDX-License-Identifier: Apache-2.0
// Geometry of OBJ files, tolerated deviations, what is refused.
#include <cmath>
#include <cstdlib>

#include "importers/obj/read/count_obj.h"
#include "scene/spectra/color.h"
#include "scene/spectra/rgb_to_spectrum.h"
#include "tests/importers/obj/obj_fixture.h"
#include "tests/support/paths.h"

namespace vitrail::obj_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using Triangle = std::array<std::uint32_t, 3>;

// ---- Geometry -----------------------------------------------------------------------------------

TEST_F(Obj, AllFormsOfFaces) {
  const std::string attributes = "vt .5 .25\nvt 1 0 0\nvn 0 0 1\n";
  const std::vector<std::pair<std::string, std::array<bool, 2>>> forms{
      {"f 1 2 3 4", {false, false}},
      {"f 1/1 2/2 3/1 4/1", {true, false}},
      {"f 1//1 2//1 3//1 4//1", {false, true}},
      {"f 1/1/1 2/2/1 3/1/1 4/1/1", {true, true}},
      {"f -4/-2/-1 -3/-1/-1 -2/-2/-1 -1/-2/-1", {true, true}},
      {"f 1/ 2/ 3/ 4/", {false, false}},
      {"f 1/1/ 2/2/ 3/1/ 4/1/", {true, false}},
      {"f\t+1  2 3   4 \t# a comment", {false, false}},
      {"f 1 2 \\\n 3\\\n4", {false, false}},
      {"f 1 2 \\\r\n 3 4\r", {false, false}},
      {"f 1/1/1 2/2/\\\n1 3/\\\r\n1/1 4/1/1", {true, true}},
      {"f 1/1 2/2 3/1 4/\\\n1", {true, false}}};
  for (const auto& [face, has] : forms) {
    const ImportedScene imported = read(square + attributes + face);
    ASSERT_THAT(imported.scene.meshes, SizeIs(1)) << face;
    const TriangleMesh& mesh = imported.scene.meshes[0];
    EXPECT_THAT(mesh.positions,
                ElementsAre(Point3f{0, 0, 0}, Point3f{1, 0, 0}, Point3f{1, 1, 0}, Point3f{0, 1, 0}));
    EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3})) << face;
    ASSERT_EQ(mesh.uvs.size(), has[0] ? 4u : 0u) << face;
    ASSERT_EQ(mesh.normals.size(), has[1] ? 4u : 0u) << face;
    if (has[0]) {
      EXPECT_EQ(mesh.uvs[0], (Point2f{.5f, .25f}));
      EXPECT_EQ(mesh.uvs[1], (Point2f{1, 0}));
    }
    if (has[1]) {
      EXPECT_EQ(mesh.normals[3], (Normal3f{0, 0, 1}));
    }
    EXPECT_THAT(imported.diagnostics, IsEmpty()) << face;
  }
}

TEST_F(Obj, IsCountedWithoutBeingRead) {
  const ObjCounts counts = count_obj(folder_.write(
      "counted.obj",
      square + "vt 0 0\nvn 0 0 1\nf 1 2 3 4\n o a\nusemtl m\nf 1/1 2/1 \\\n3/1\ng b\nf -1 -2 -3\nf 1 2"));
  EXPECT_EQ(counts.positions, 4u);
  EXPECT_EQ(counts.uvs, 1u);
  EXPECT_EQ(counts.normals, 1u);
  EXPECT_EQ(counts.corners, 12u);
  EXPECT_EQ(counts.triangles, 4u);
  EXPECT_THAT(counts.parts, ElementsAre(2u, 1u, 1u));
}

TEST_F(Obj, NumbersAndLineEnds) {
  const TriangleMesh expected = read("v .5 -.25e1 +3\nv 1. 0 0\nv 0 1E0 0\nf 1 2 3\n").scene.meshes.at(0);
  EXPECT_THAT(expected.positions, ElementsAre(Point3f{.5f, -2.5f, 3}, Point3f{1, 0, 0}, Point3f{0, 1, 0}));
  EXPECT_EQ(read("v .5 -2.5 3\r\n\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n").scene.meshes.at(0), expected);
  EXPECT_EQ(read("v .5 -2.5 3\rv 1 0 0\r# x\rv 0 1 0\rf 1 2 3").scene.meshes.at(0), expected);
  EXPECT_EQ(read("\t v .5 -2.5 3 # x\n#v 7 7 7\\\n  # y\nv 1 0 0\nv 0 1 0\nf 1 2 3").scene.meshes.at(0),
            expected);
}

TEST_F(Obj, VerticesAreSharedWhereAllIndicesAgree) {
  const ImportedScene imported = read(square + "vt 0 0\nvt 1 1\nf 1/1 2/1 3/1\nf 1/1 3/2 4/1\nf 3/2 4/1 1/1");
  const TriangleMesh& mesh = imported.scene.meshes.at(0);
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 3, 4}, Triangle{3, 4, 0}));
  EXPECT_EQ(mesh.positions[2], mesh.positions[3]);
  EXPECT_NE(mesh.uvs[2], mesh.uvs[3]);
}

TEST_F(Obj, OneMeshAnObjectAndMaterialAndItsFacesInOrder) {
  const ImportedScene imported =
      read(square +
           "o one\ng a b\nf 1 2 3\nusemtl red\nf 1 2 4\ng c\nusemtl\tgreen \nf 2 3 4\nusemtl red\nf 1 3 4\n");
  const Scene& scene = imported.scene;
  ASSERT_THAT(scene.meshes, SizeIs(4));
  ASSERT_THAT(scene.shapes, SizeIs(4));
  EXPECT_THAT(scene.materials, SizeIs(3));
  // Those of one material are one after the other.
  EXPECT_EQ(scene.shapes[1].material, scene.shapes[2].material);
  EXPECT_THAT(scene.meshes[1].triangles, SizeIs(1));
  EXPECT_EQ(scene.shapes[3].mesh.value, 3u);
  EXPECT_THAT(scene.meshes[3].positions, ElementsAre(Point3f{1, 0, 0}, Point3f{1, 1, 0}, Point3f{0, 1, 0}));
  EXPECT_THAT(names_of(scene), ElementsAre("a b", "a b", "c", "c"));
  EXPECT_EQ(scene.shapes[3].origin.line, 10u);
  EXPECT_THAT(imported.diagnostics, SizeIs(2));  // red and green are not defined
  EXPECT_THAT(imported.diagnostics, says("'green' is not defined"));
  EXPECT_EQ(imported.diagnostics[0].location.line, 8);
}

TEST_F(Obj, ObjectsHaveTheirNames) {
  const auto names = [&](const std::string& text) { return names_of(read(square + text).scene); };
  EXPECT_THAT(names("f 1 2 3\n"), ElementsAre(""));
  EXPECT_THAT(names("o chair\nf 1 2 3\no table\ng leg\nf 1 2 4\ng top\nf 2 3 4\no chair\nf 1 3 4\n"),
              ElementsAre("chair", "table"));
  EXPECT_THAT(names("o all\ng chair\nf 1 2 3\ng table top\nf 1 2 4\n"), ElementsAre("chair", "table top"));
  EXPECT_THAT(names("o all\nf 1 2 3\n"), ElementsAre("all"));
  EXPECT_THAT(names("f 1 2 3\no chair\nf 1 2 4\no\nf 2 3 4\n"), ElementsAre("", "chair"));
}

// Where the file has an object at a time.
TEST_F(Obj, ObjectsDoNotChangeTheOrderOfTriangles) {
  const std::string vertices = square + "v 2 2 2\n";
  const std::vector<std::string> objects{"usemtl red\nf 1 2 3\nusemtl blue\nf 2 3 4\n",
                                         "usemtl blue\nf 1 2 5\nusemtl red\nf 2 3 5\n", "f 3 4 5\n"};
  const auto corners = [&](const std::string& word) {
    std::string text = vertices;
    for (std::size_t i = 0; i < objects.size(); ++i)
      text += (word.empty() ? "" : word + " " + std::to_string(i) + "\n") + objects[i];
    const Scene scene = read(text).scene;
    std::vector<std::pair<std::string, Point3f>> all;
    for (const Shape& shape : scene.shapes)
      for (const Triangle& t : scene.meshes[shape.mesh.value].triangles)
        for (const std::uint32_t i : t)
          all.emplace_back(scene.materials[shape.material.value].name,
                           scene.meshes[shape.mesh.value].positions[i]);
    return all;
  };
  const auto plain = corners("");
  EXPECT_THAT(plain, SizeIs(15));
  EXPECT_EQ(corners("o"), plain);
  EXPECT_EQ(corners("g"), plain);
}

TEST_F(Obj, LampsAreObjects) {
  folder_.write("m.mtl", "newmtl glow\nKe 1 1 1\nnewmtl red\nKe 2 0 0\nnewmtl wall\nKd .5 .5 .5\n");
  const auto lamps = [&](const std::string& text) {
    imported_ = read("mtllib m.mtl\n" + square + text);
    std::vector<std::string> names;
    for (const AreaLight& light : imported_.scene.area_lights) names.push_back(light.name);
    return names;
  };
  EXPECT_THAT(lamps("usemtl glow\nf 1 2 3\nusemtl red\nf 1 2 4\n"), ElementsAre("glow", "red"));
  EXPECT_THAT(
      lamps("o left\nusemtl glow\nf 1 2 3\no wall\nusemtl wall\nf 2 3 4\no right\nusemtl glow\nf 1 2 4\n"),
      ElementsAre("left", "right"));
  EXPECT_EQ(imported_.scene.area_lights[1].radiance, imported_.scene.area_lights[0].radiance);
  EXPECT_EQ(imported_.scene.shapes[1].area_light->value, 1u);
  EXPECT_THAT(lamps("o lamp\nusemtl glow\nf 1 2 3\nusemtl red\nf 1 2 4\n"), ElementsAre("glow", "red"));
}

TEST_F(Obj, ObjectsBeyondAllMeasureAreOne) {
  constexpr std::size_t most = 20'000;
  std::string text = square;
  for (std::size_t i = 0; i < most + 5; ++i) text += "g part" + std::to_string(i) + "\nf 1 2 3\n";
  const ImportedScene imported = read(text);
  ASSERT_THAT(imported.scene.shapes, SizeIs(most + 1));
  EXPECT_EQ(imported.scene.shapes[most - 1].name, "part19999");
  EXPECT_EQ(imported.scene.shapes[most].name, "");
  EXPECT_THAT(imported.scene.meshes[most].triangles, SizeIs(5));
  ASSERT_THAT(imported.diagnostics, SizeIs(1));
  EXPECT_THAT(imported.diagnostics, says("objects after the first 20000"));
  EXPECT_EQ(imported.diagnostics[0].location.line, 5 + 2 * static_cast<int>(most));
}

TEST_F(Obj, FacesWithAndWithoutNormalsAreApart) {
  const ImportedScene imported = read(square + "vn 0 0 1\nf 1//1 2//1 3//1\nf 1 3 4\nf 1//1 2 4\n");
  ASSERT_THAT(imported.scene.meshes, SizeIs(2));
  EXPECT_THAT(imported.scene.meshes[0].normals, SizeIs(3));
  EXPECT_THAT(imported.scene.meshes[1].normals, IsEmpty());
  EXPECT_THAT(imported.scene.meshes[1].triangles, SizeIs(2));
  EXPECT_THAT(imported.scene.materials, SizeIs(1));
  EXPECT_THAT(imported.diagnostics, says("not all corners have them"));
}

TEST_F(Obj, ConcavePolygon) {
  const ImportedScene imported =
      read("v 0 2 0\nv 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nf 1 2 3 4 5 6\n");
  const TriangleMesh& mesh = imported.scene.meshes.at(0);
  float area = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const float z = cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]).z;
    EXPECT_GT(z, 0);
    area += z / 2;
  }
  EXPECT_EQ(area, 3);
}

TEST_F(Obj, FacesMayComeBeforeTheirVertices) {
  const ImportedScene imported = read("f 1/1 2/1 3/1 4/1\n" + square + "vt .5 .5\nf 1 2 3\n");
  ASSERT_THAT(imported.scene.meshes, SizeIs(2));
  EXPECT_THAT(imported.scene.meshes[1].triangles, SizeIs(2));
  EXPECT_THAT(imported.scene.meshes[1].uvs, SizeIs(4));
  EXPECT_EQ(error_of("v 0 0 0\nf 1 2 3\n" + square.substr(0, 8)).location.line, 2);
}

TEST_F(Obj, FilesThatCountFromZero) {
  const ImportedScene imported = read(square + "vn 0 0 1\nf 3//0 2//0 1//0\nf 0//0 1//0 2//0\n");
  const TriangleMesh& mesh = imported.scene.meshes.at(0);
  EXPECT_EQ(mesh.positions[mesh.triangles[1][0]], (Point3f{0, 0, 0}));
  EXPECT_EQ(mesh.positions[mesh.triangles[0][0]], (Point3f{0, 1, 0}));
  EXPECT_THAT(mesh.normals, SizeIs(4));
  EXPECT_THAT(imported.diagnostics, says("are counted from 0"));
  EXPECT_EQ(imported.diagnostics[0].location.line, 7);
  EXPECT_THAT(error_of(square + "f 0 1 4\n").what(), HasSubstr("counted from 0"));
}

TEST_F(Obj, FarFromTheOriginNothingIsLost) {
  const ImportedScene imported =
      read("v 5000000.001 0 0\nv 5000000.002 0 0\nv 5000000.001 0.001 0\nf 1 2 3\n");
  const TriangleMesh& mesh = imported.scene.meshes.at(0);
  const Transform& t = imported.scene.shapes.at(0).object_to_world;
  EXPECT_NEAR(transform_point(t, cast<double>(mesh.positions[1])).x, 5000000.002, 1e-9);
  EXPECT_NEAR(mesh.positions[1].x - mesh.positions[0].x, 0.001, 1e-9);
  EXPECT_EQ(read(square + "f 1 2 3").scene.shapes.at(0).object_to_world, Transform{});
}

TEST_F(Obj, WhatIsDroppedIsSaidOnce) {
  const ImportedScene imported = read(
      "v 0 0 0 .5\nv 1 0 0 1 0 0\nv 1 1 0 1 0 0\np 1 2\np 1\nl 1 2 \\\n3\nf 1 2\nfoo bar\ns 1\nf 1 2 3\nf "
      "1//5 2//5 3//5\n");
  EXPECT_THAT(imported.scene.meshes.at(0).triangles, SizeIs(2));
  const Diagnostics& diagnostics = imported.diagnostics;
  for (const std::string text : {"weights", "'p'", "'l'", "fewer than three", "'foo'", "normals"}) {
    EXPECT_THAT(diagnostics, says(text));
  }
  EXPECT_THAT(diagnostics, SizeIs(6));
  for (const Diagnostic& d : diagnostics) EXPECT_GT(d.location.line, 0) << d.message;
}

// .5 of the screen is .2140 of the light. Vertices without a colour are white.
TEST_F(Obj, ColoursOfVertices) {
  const ImportedScene imported = read("v 5 5 5\nv 0 0 0 1 0 .5\nv 1 0 0 .5 1 0\nv 0 1 0\nf 2 3 4\n");
  EXPECT_THAT(imported.diagnostics, IsEmpty());
  EXPECT_EQ(std::get<DiffuseMaterial>(imported.scene.materials.at(0).model).reflectance,
            SpectrumParameter{Id<Texture>{0}});
  EXPECT_EQ(std::get<MeshAttributeTexture>(imported.scene.textures.at(0).model).name, "vertex_color");
  const MeshAttribute& colors = imported.scene.meshes.at(0).attributes.at(0);
  const auto half = static_cast<float>(srgb_decode(.5));
  EXPECT_THAT(colors.values, ElementsAre(1, 0, half, half, 1, 0, 1, 1, 1));
  // The whole file as one mesh.
  const ImportedScene whole = read("v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nf 1 2 3\n");
  EXPECT_THAT(whole.scene.meshes.at(0).attributes.at(0).values, ElementsAre(1, 0, 0, 0, 1, 0, 0, 0, 1));
}

TEST_F(Obj, MaterialsOfLibrariesCountMoreThanColoursOfVertices) {
  folder_.write("a.mtl", "newmtl m\nKd 1 0 0\n");
  const ImportedScene imported =
      read("mtllib a.mtl\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nusemtl m\nf 1 2 3\n");
  EXPECT_THAT(imported.diagnostics, says("colours of vertices"));
  EXPECT_THAT(imported.scene.meshes.at(0).attributes, IsEmpty());
  EXPECT_THAT(imported.scene.textures, IsEmpty());
}

// Two faces at a right angle share an edge. Normals of one group are half way; of two, those of the faces.
TEST_F(Obj, SmoothingGroups) {
  const std::string roof = "v 0 0 0\nv 0 1 0\nv 1 0 0\nv 0 0 -1\n", a = "f 1 3 2\n", b = "f 1 2 4\n";
  const auto normal = [&](const std::string& faces, std::size_t triangle) {
    const Scene scene = read(roof + faces).scene;
    for (const TriangleMesh& mesh : scene.meshes)
      for (const auto& t : mesh.triangles)
        if (triangle-- == 0) return mesh.normals.empty() ? Normal3f{} : mesh.normals.at(t[0]);
    return Normal3f{};
  };
  const float h = std::sqrt(.5f);
  for (const std::string& faces : {"s 1\n" + a + b, "s 7\n" + a + "usemtl m\n" + b, "s on\n" + a + b})
    for (const std::size_t triangle : {0u, 1u}) {
      EXPECT_NEAR(normal(faces, triangle).x, -h, 1e-6) << faces;
      EXPECT_NEAR(normal(faces, triangle).z, h, 1e-6) << faces;
    }
  EXPECT_NEAR(normal("s 1\n" + a + "s 2\n" + b, 0).z, 1, 1e-6);
  EXPECT_NEAR(normal("s 1\n" + a + "s 2\n" + b, 1).x, -1, 1e-6);
  EXPECT_EQ(normal("s 1\ns off\n" + a + b, 0), Normal3f{}) << "flat";
  EXPECT_NEAR(normal("vn 0 1 0\ns 1\nf 1//1 3//1 2//1\n", 0).y, 1, 1e-6) << "those of the file count";
}

TEST_F(Obj, Deterministic) {
  const std::string content = square + "vt 0 0\nf 1 2 3\nusemtl a\nf 1/1 2/1 4/1\nf 1 3 4\n";
  const ImportedScene a = read(content), b = read(content);
  EXPECT_EQ(a.scene.meshes, b.scene.meshes);
  EXPECT_EQ(a.scene.shapes, b.scene.shapes);
  EXPECT_EQ(a.scene.materials, b.scene.materials);
}

// ---- Courtesies: docs/reference/tolerated-deviations.md ----

TEST_F(Obj, AttributesThatAreNotFiniteAreLostAlone) {
  const ImportedScene imported =
      read(square + "vt 0.5 nan\nvt 1 1\nvn 0 0 1\nvn inf 0 1\nf 1/1/1 2/2/1 3/2/2\n");
  EXPECT_EQ(imported.scene.meshes.at(0).uvs.at(0), (Point2f{0.5f, 0}));
  EXPECT_THAT(imported.diagnostics, says("not finite: 0"));
}

TEST_F(Obj, ColoursThatAreNotFiniteAreLostAlone) {
  const ImportedScene imported = read("v 0 0 0 nan nan nan\nv 1 0 0 1 -1.#IND 0\nv 0 1 0 1 0 0\nf 1 2 3\n");
  EXPECT_EQ(imported.scene.meshes.at(0).attributes.at(0).values,
            (std::vector<float>{0, 0, 0, 1, 0, 0, 1, 0, 0}));
  EXPECT_THAT(imported.diagnostics, says("not finite: 0"));
}

TEST_F(Obj, MarksLetterCasesAndPathsOfOtherSystems) {
  const MaterialModel red = DiffuseMaterial{reflectance_from_rgb({1, 0, 0})};
  const std::string mark = "\xef\xbb\xbf", faces = square + "usemtl m\nf 1 2 3\n";
  folder_.write("Red.mtl", mark + "NewMtl m\nkd 1 0 0\n");
  for (const std::string name : {"Red.mtl", ".\\Red.mtl", "C:\\models\\Red.mtl", "C:/models/red.MTL"}) {
    const ImportedScene imported = read(mark + "mtllib " + name + "\n" + faces);
    EXPECT_EQ(imported.scene.materials.at(0).model, red) << name;
    EXPECT_THAT(imported.diagnostics, IsEmpty()) << name;
  }
  folder_.write("Wood.png", "");
  material("map_kd -S 2 3 1 -CLAMP On textures\\wood.PNG\n");
  const auto& texture = std::get<ImageTexture>(imported_.scene.textures.at(0).model);
  EXPECT_TRUE(texture.filename.ends_with("/Wood.png")) << texture.filename;
  EXPECT_EQ(texture.wrap, Wrap::clamp);
  EXPECT_EQ(std::get<UvMapping>(texture.mapping).a, 2);
  folder_.write("wOOD.png", "");
  material("map_Kd WOOD.png\n");
  EXPECT_TRUE(std::get<ImageTexture>(imported_.scene.textures.at(0).model).filename.ends_with("/WOOD.png"))
      << "two may be meant";
}

// ---- What has to be refused ---------------------------------------------------------------------

TEST_F(Obj, ErrorsHaveTheirPlace) {
  struct Case {
    std::string content;
    int line, column;
    std::string message;
  };
  for (const Case& c : std::vector<Case>{{square + "f 1 2 5\n", 5, 7, "vertex index 5"},
                                         {square + "f 1 2 -5\n", 5, 7, "vertex index -5"},
                                         {"f -4 -3 -2", 1, 3, "vertex index -4"},
                                         {"v 0 0 nan\n", 1, 7, "finite"},
                                         {"v 0 -inf 0\n", 1, 5, "finite"},
                                         {"v 0 1e39 0\n", 1, 5, "finite"},
                                         {"v 0 1e999 0\n", 1, 5, "finite"},
                                         {"v 0 0\n", 1, 6, "missing"},
                                         {"v 0 0 0x\n", 1, 7, "'0x'"},
                                         {"\n\nv 0 0, 0\n", 3, 5, "'0,'"},
                                         {square + "f 1 2 x\n", 5, 7, "'x'"},
                                         {square + "f 1 2 3.5\n", 5, 8, "corner"},
                                         {square + "f 1 2 3/1/1/1\n", 5, 12, "corner"},
                                         {square + "f 1 2 \\\n 77\n", 6, 2, "vertex index 77"},
                                         {square + "f 1 2 99999999999999999999\n", 5, 7, "64 bits"},
                                         {square + "f 1 2 9223372036854775807\n", 5, 7, "out of range"},
                                         {"solid cube\nfacet normal\n", 1, 1, "not an OBJ file"}}) {
    const Error error = error_of(c.content);
    EXPECT_THAT(error.what(), HasSubstr(c.message)) << c.content;
    EXPECT_EQ(error.location.line, c.line) << c.content;
    EXPECT_EQ(error.location.column, c.column) << c.content;
    EXPECT_THAT(error.location.file, HasSubstr("scene.obj"));
    EXPECT_FALSE(error.excerpt.empty()) << c.content;
  }
}

TEST_F(Obj, LongLinesAndControlCharactersAreShownShort) {
  const Error error = error_of(square + std::string(5000, ' ') + "f 1 2 \1" + std::string(5000, 'x') + "\n");
  EXPECT_LT(error.excerpt.size(), 200u);
  EXPECT_LT(std::string(error.what()).size(), 200u);
  EXPECT_THAT(error.excerpt, HasSubstr("f 1 2 ?xxx"));
}

// Names in Latin-1 or cut off must not reach a report as they are: it is JSON.
TEST_F(Obj, MessagesAreWellFormedText) {
  const ImportedScene imported =
      read(square + "usemtl gr\xfcn\xc3\nf 1 2 3\nusemtl gr\xc3\xbcn \xe2\x82\xac\xed\xa0\x80\nf 1 2 3\n");
  EXPECT_THAT(imported.diagnostics, says("'gr?n?'"));
  EXPECT_EQ(imported.scene.materials.at(0).name, "gr?n?");
  EXPECT_THAT(imported.diagnostics, says("'gr\xc3\xbcn \xe2\x82\xac?"
                                         "?"
                                         "?'"));
}

TEST_F(Obj, FilesThatAreNotThere) { EXPECT_THROW(read_obj(folder_.path() / "none.obj"), Error); }

// ---- Files of others ----------------------------------------------------------------------------

TEST(ObjCorpus, AllAreReadOrRefusedWithTheirPlace) {
  const char* const named = std::getenv("VITRAIL_CORPUS");
  const std::filesystem::path corpus = named ? named : test::project_file("../shared/corpus");
  if (!std::filesystem::is_directory(corpus / "obj"))
    GTEST_SKIP() << "no corpus at " << corpus << " (set VITRAIL_CORPUS)";
  int read = 0, refused = 0;
  for (const auto& entry : std::filesystem::directory_iterator(corpus / "obj")) {
    if (entry.path().extension() != ".obj") continue;
    const std::string name = entry.path().filename().string();
    const bool is_bad = name.starts_with("invalid-") || name.ends_with("-nan.obj");
    try {
      read_obj(entry.path());
      EXPECT_FALSE(is_bad) << name;
      ++read;
    } catch (const Error& error) {
      EXPECT_TRUE(is_bad) << name << ": " << to_string(error.location) << ": " << error.what();
      EXPECT_GT(error.location.column, 0) << name;
      EXPECT_FALSE(error.excerpt.empty()) << name;
      ++refused;
    }
  }
  EXPECT_GT(read, 0);
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace vitrail::obj_test
