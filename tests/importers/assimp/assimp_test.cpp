// SPDX-License-Identifier: Apache-2.0
#include "importers/assimp/read/assimp.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "importers/import.h"
#include "scene/records/scene.h"
#include "scene/spectra/rgb_to_spectrum.h"
#include "scene/system/diagnostics.h"
#include "tests/importers/temporary_folder.h"

namespace vitrail::assimp_test {
namespace {

using namespace std::string_literals;
using testing::HasSubstr;

// A triangle of COLLADA in the plane z = 0, +z up: the file's y is −z here.
constexpr const char* triangle = R"(
  <library_geometries><geometry id="g" name="g"><mesh>
    <source id="p"><float_array id="pa" count="9">0 0 0 1 0 0 0 0 2</float_array><technique_common>
      <accessor source="#pa" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor>
    </technique_common></source>
    <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
    <triangles count="1" material="m"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
  </mesh></geometry></library_geometries>)";

std::string phong(const std::string& parts) {
  return R"(<library_effects><effect id="e"><profile_COMMON><technique sid="t"><phong>)" + parts +
         R"(</phong></technique></profile_COMMON></effect></library_effects>
  <library_materials><material id="m" name="m"><instance_effect url="#e"/></material></library_materials>)";
}

std::string node(const std::string& name, const std::string& place) {
  return "<node id=\"" + name + "\" name=\"" + name + "\">" + place +
         R"(<instance_geometry url="#g"><bind_material><technique_common><instance_material symbol="m" target="#m"/>
  </technique_common></bind_material></instance_geometry></node>)";
}

std::string collada(const std::string& libraries, const std::string& nodes) {
  return R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><up_axis>Z_UP</up_axis></asset>)" +
         libraries + R"(<library_visual_scenes><visual_scene id="s">)" + nodes +
         R"(</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

class Assimp : public testing::Test {
 protected:
  ImportedScene read(const std::string& text, const ImportOptions& options = {}) {
    return read_assimp(folder_.write("a.dae", text), MeshMemory{}, options);
  }
  std::string error_of(const std::string& name, const std::string& bytes) {
    try {
      import_scene(folder_.write(name, bytes));
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
  static bool says(const ImportedScene& imported, const std::string& words) {
    return std::ranges::any_of(imported.diagnostics, [&](const Diagnostic& d) {
      return d.message.find(words) != std::string::npos;
    });
  }

  TemporaryFolder folder_;
};

TEST_F(Assimp, NodesPlaceMeshesWithYUp) {
  const ImportedScene one = read(collada(phong("") + triangle, node("n", "<translate>0 0 3</translate>")));
  ASSERT_EQ(one.scene.shapes.size(), 1u);
  const Shape& shape = one.scene.shapes[0];
  EXPECT_EQ(shape.name, "n");
  const TriangleMesh& mesh = one.scene.meshes.at(shape.mesh.value);
  ASSERT_EQ(mesh.triangles.size(), 1u);
  const Point3f corner = mesh.positions.at(mesh.triangles[0][2]);
  const Point3d top = transform_point(shape.object_to_world, cast<double>(corner));
  EXPECT_NEAR(top.x, 0, 1e-6);
  EXPECT_NEAR(top.y, 5, 1e-6);
  EXPECT_NEAR(top.z, 0, 1e-6);
  EXPECT_TRUE(says(one, "no camera"));
  EXPECT_TRUE(says(one, "no light"));
}

TEST_F(Assimp, AMeshOfManyNodesIsAPrototype) {
  const ImportedScene two =
      read(collada(phong("") + triangle, node("a", "") + node("b", "<scale>-1 1 1</scale>") +
                                             node("flat", "<scale>0 1 1</scale>")));
  EXPECT_TRUE(two.scene.shapes.empty());
  EXPECT_EQ(two.scene.prototypes.size(), 1u);
  EXPECT_EQ(two.scene.meshes.size(), 1u);
  EXPECT_EQ(two.scene.instances.size(), 2u);
  EXPECT_TRUE(says(two, "'flat' is flat"));
}

TEST_F(Assimp, MaterialsAreThoseOfMtl) {
  const auto material = [&](const std::string& parts) {
    const ImportedScene imported = read(collada(phong(parts) + triangle, node("n", "")));
    return imported.scene.materials.at(imported.scene.shapes.at(0).material.value);
  };
  const std::string red = "<diffuse><color>.5 .25 .125 1</color></diffuse>";
  const Material diffuse = material(red);
  EXPECT_EQ(diffuse.name, "m");
  EXPECT_EQ(std::get<DiffuseMaterial>(diffuse.model).reflectance,
            SpectrumParameter(Spectrum(reflectance_from_rgb({.5, .25, .125}))));
  const Material shiny = material(
      red + "<specular><color>.5 .5 .5 1</color></specular><shininess><float>198</float></shininess>");
  EXPECT_EQ(std::get<PlasticMaterial>(shiny.model).roughness.alpha_u, FloatParameter(.1f));
  const Material glass = material(
      "<transparency><float>.1</float></transparency><index_of_refraction><float>1.5</float></"
      "index_of_refraction>");
  EXPECT_TRUE(std::holds_alternative<DielectricMaterial>(glass.model));
}

TEST_F(Assimp, WhatNobodyWouldSeeIsOpaque) {
  const ImportedScene imported = read(collada(
      phong("<diffuse><color>1 1 1 1</color></diffuse><transparency><float>0</float></transparency>") +
          triangle,
      node("n", "")));
  EXPECT_TRUE(std::holds_alternative<DiffuseMaterial>(imported.scene.materials.at(0).model));
  EXPECT_TRUE(says(imported, "opacity 0"));
}

TEST_F(Assimp, ImagesAreFoundBesideTheFile) {
  const std::string text =
      collada(R"(<library_images><image id="i"><init_from>wood.png</init_from></image></library_images>)" +
                  std::string(R"(<library_effects><effect id="e"><profile_COMMON>
  <newparam sid="s"><surface type="2D"><init_from>i</init_from></surface></newparam>
  <newparam sid="u"><sampler2D><source>s</source></sampler2D></newparam>
  <technique sid="t"><phong><diffuse><texture texture="u" texcoord="UV"/></diffuse></phong></technique>
  </profile_COMMON></effect></library_effects>
  <library_materials><material id="m" name="m"><instance_effect url="#e"/></material></library_materials>)") +
                  triangle,
              node("n", ""));
  EXPECT_TRUE(says(import_scene(folder_.write("a.dae", text)), "wood.png")) << "grey stands for it";
  folder_.write("wood.png", "");
  const ImportedScene imported = read(text);
  ASSERT_EQ(imported.scene.textures.size(), 1u);
  EXPECT_THAT(std::get<ImageTexture>(imported.scene.textures[0].model).filename, HasSubstr("wood.png"));
}

TEST_F(Assimp, LightsShowTheirColour) {
  const auto light = [&](const std::string& kind) {
    const ImportedScene imported = read(collada(
        phong("") + triangle + "<library_lights><light id=\"l\" name=\"l\"><technique_common>" + kind +
            "</technique_common></light></library_lights>",
        node("n", "") +
            "<node id=\"l\" name=\"l\"><translate>1 2 3</translate><instance_light url=\"#l\"/></node>"));
    EXPECT_EQ(imported.scene.lights.size(), 1u) << kind;
    return imported.scene.lights.at(0).model;
  };
  const std::string white = "<color>1 1 1</color>";
  const Spectrum shows_one = emission_from_rgb({std::numbers::pi, std::numbers::pi, std::numbers::pi});
  const auto point = std::get<PointLight>(light("<point>" + white + "</point>"));
  EXPECT_NEAR(point.position.y, 3, 1e-6);
  EXPECT_NEAR(point.position.z, -2, 1e-6);
  EXPECT_EQ(point.intensity, shows_one);
  EXPECT_EQ(point.fading, Fading{});
  const auto far = std::get<DistantLight>(light("<directional>" + white + "</directional>"));
  EXPECT_NEAR(far.direction.y, -1, 1e-6);
  EXPECT_EQ(far.irradiance, shows_one);
  // 1/(1 + d²/4): half of it at d = 2.
  const auto weak =
      std::get<PointLight>(light("<point>" + white +
                                 "<constant_attenuation>1</constant_attenuation><quadratic_attenuation>.25</"
                                 "quadratic_attenuation></point>"));
  EXPECT_EQ(weak.fading, (Fading{2, 2}));
  const auto physical =
      std::get<PointLight>(light("<point>" + white +
                                 "<constant_attenuation>0</constant_attenuation><quadratic_attenuation>1</"
                                 "quadratic_attenuation></point>"));
  EXPECT_EQ(physical.fading, std::nullopt);
  EXPECT_EQ(physical.intensity, shows_one);
  const auto spot = std::get<SpotLight>(light("<spot>" + white + "<falloff_angle>60</falloff_angle></spot>"));
  EXPECT_NEAR(spot.cutoff_deg, 30, 1e-4);
}

TEST_F(Assimp, TheCameraLooksAsTheFileSays) {
  const std::string camera =
      R"(<library_cameras><camera id="c" name="c"><optics><technique_common><perspective>
  <xfov>90</xfov><aspect_ratio>2</aspect_ratio></perspective></technique_common></optics></camera></library_cameras>)";
  // In COLLADA a camera looks along −z of its node: here down, with +y of the file up in the picture.
  const std::string text = collada(
      phong("") + triangle + camera,
      node("n", "") +
          "<node id=\"c\" name=\"c\"><translate>0 0 9</translate><instance_camera url=\"#c\"/></node>");
  const ImportedScene imported = read(text);
  const auto view = std::get<PerspectiveCamera>(imported.scene.camera);
  const Vector3d along = transform_vector(view.camera_to_world, {0, 0, 1});
  EXPECT_NEAR(along.y, -1, 1e-6);
  EXPECT_NEAR(transform_point(view.camera_to_world, {0, 0, 0}).y, 9, 1e-5);
  EXPECT_NEAR(view.screen.x1, 1, 1e-5);
  EXPECT_EQ(imported.scene.film.width, 2 * imported.scene.film.height);
  // +x of the file is right in the picture.
  EXPECT_GT(transform_vector(view.camera_to_world, {1, 0, 0}).x, .999);
  ImportOptions second;
  second.camera = 1;
  EXPECT_THROW(read(text, second), UsageError);
}

// Of a file whose camera's element and optics are so.
TEST_F(Assimp, CamerasOfColladaHaveTheirAngles) {
  const auto camera_of = [&](const std::string& names, const std::string& optics) {
    return read(collada(phong("") + triangle + "<library_cameras><camera " + names +
                            "><optics><technique_common>" + optics +
                            "</technique_common></optics></camera></library_cameras>",
                        node("n", "") + R"(<node id="view"><instance_camera url="#c"/></node>)"))
        .scene.camera;
  };
  const double half = std::tan(std::numbers::pi / 6);
  const auto perspective = [&](const std::string& names, const std::string& angles) {
    return std::get<PerspectiveCamera>(camera_of(names, "<perspective>" + angles + "</perspective>")).screen;
  };
  for (const char* names : {R"(id="c")", R"(id="c" name="c")"}) {
    EXPECT_NEAR(perspective(names, "<xfov>60</xfov>").x1, half, 1e-6) << names;
    EXPECT_NEAR(perspective(names, "<yfov>60</yfov>").y1, half, 1e-6) << names;
    const ScreenWindow wide = perspective(names, "<yfov>60</yfov><aspect_ratio>2</aspect_ratio>");
    EXPECT_NEAR(wide.x1, 2 * half, 1e-6) << names;
    const auto flat = std::get<OrthographicCamera>(
        camera_of(names, "<orthographic><xmag>2</xmag><ymag>1</ymag></orthographic>"));
    EXPECT_NEAR(flat.screen.x1, 2, 1e-6) << names;
    EXPECT_NEAR(flat.screen.y1, 1, 1e-6) << names;
  }
}

// An FBX of text: a quad in z = 0, a camera 5 m before it, a sun; more properties and connections.
std::string fbx(double centimetres, const std::string& camera, const std::string& sun,
                const std::string& more = "", const std::string& connections = "") {
  const auto model = [](int id, const char* name, const char* kind, const std::string& properties) {
    return fmt::format("Model: {}, \"Model::{}\", \"{}\" {{\n Version: 232\n Properties70:  {{\n{} }}\n}}\n",
                       id, name, kind, properties);
  };
  const std::string place = "P: \"Lcl Translation\", \"Lcl Translation\", \"\", \"A\",0,0,500\n";
  return "; FBX 7.3.0 project file\nFBXHeaderExtension:  {\n FBXHeaderVersion: 1003\n FBXVersion: 7300\n}\n"
         "GlobalSettings:  {\n Version: 1000\n Properties70:  {\n" +
         fmt::format("P: \"UnitScaleFactor\", \"double\", \"Number\", \"\",{}\n", centimetres) +
         " }\n}\nObjects:  {\n"
         "Geometry: 1, \"Geometry::q\", \"Mesh\" {\n Vertices: *12 {\n a: "
         "-100,-100,0,100,-100,0,100,100,0,-100,100,0\n }\n"
         " PolygonVertexIndex: *4 {\n a: 0,1,2,-4\n }\n GeometryVersion: 124\n}\n"
         "NodeAttribute: 2, \"NodeAttribute::c\", \"Camera\" {\n TypeFlags: \"Camera\"\n Properties70:  {\n"
         "P: \"FieldOfView\", \"FieldOfView\", \"\", \"A\",40\n" +
         more +
         " }\n}\n"
         "NodeAttribute: 3, \"NodeAttribute::l\", \"Light\" {\n TypeFlags: \"Light\"\n Properties70:  {\n"
         "P: \"LightType\", \"enum\", \"\", \"\",1\nP: \"Intensity\", \"Number\", \"\", \"A\",100\n }\n}\n" +
         model(11, "q", "Mesh", "") + model(12, "cam", "Camera", place + camera) +
         model(13, "sun", "Light", place + sun) +
         model(14, "aim", "Null", "P: \"Lcl Translation\", \"Lcl Translation\", \"\", \"A\",300,0,500\n") +
         "}\nConnections:  {\n C: \"OO\",11,0\n C: \"OO\",12,0\n C: \"OO\",13,0\n C: \"OO\",14,0\n C: "
         "\"OO\",1,11\n C: "
         "\"OO\",2,12\n C: \"OO\",3,13\n" +
         connections + "}\n";
}

std::string turned(const char* angles) {
  return fmt::format(
      "P: \"PostRotation\", \"Vector3D\", \"\", \"\",{}\nP: \"RotationActive\", \"bool\", \"\", \"\",1\n",
      angles);
}

// As FBX's own programs write them: the rotation behind the others has the camera look along −z, the sun too.
TEST_F(Assimp, CamerasAndLightsOfFbxTurnByTheirPostRotation) {
  const Scene scene =
      import_scene(folder_.write("a.fbx", fbx(1, turned("0,-90,0"), turned("-90,0,0")))).scene;
  const Transform& view = std::get<PerspectiveCamera>(scene.camera).camera_to_world;
  EXPECT_NEAR(transform_vector(view, {0, 0, 1}).z, -1, 1e-6);
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_NEAR(std::get<DistantLight>(scene.lights[0].model).direction.z, -1, 1e-6);
}

TEST_F(Assimp, FbxIsInMetres) {
  const auto right = [&](double centimetres) {
    const Scene scene = import_scene(folder_.write("a.fbx", fbx(centimetres, "", ""))).scene;
    const Point3f corner = scene.meshes.at(0).positions.at(1);
    const Point3d eye = transform_point(std::get<PerspectiveCamera>(scene.camera).camera_to_world, {0, 0, 0});
    EXPECT_NEAR(eye.z, 5 * centimetres, 1e-5);
    return std::abs(transform_point(scene.shapes.at(0).object_to_world, cast<double>(corner)).x);
  };
  EXPECT_NEAR(right(1), 1, 1e-6);
  EXPECT_NEAR(right(100), 100, 1e-4);
  EXPECT_NEAR(right(2.54), 2.54, 1e-5);
}

TEST_F(Assimp, CamerasAndLightsOfFbxLookAtTheirTargets) {
  const ImportedScene imported = import_scene(folder_.write(
      "a.fbx", fbx(1, turned("0,-90,0"), "", "",
                   " C: \"OP\",14,12, \"LookAtProperty\"\n C: \"OP\",11,13, \"LookAtProperty\"\n")));
  const Transform& view = std::get<PerspectiveCamera>(imported.scene.camera).camera_to_world;
  EXPECT_NEAR(transform_vector(view, {0, 0, 1}).x, 1, 1e-6) << "at what is right of it";
  EXPECT_NEAR(std::get<DistantLight>(imported.scene.lights.at(0).model).direction.z, -1, 1e-6);
}

TEST_F(Assimp, AnOrthographicCameraOfFbxIsTold) {
  const std::string projection = "P: \"CameraProjectionType\", \"enum\", \"\", \"\",";
  EXPECT_TRUE(says(import_scene(folder_.write("a.fbx", fbx(1, "", "", projection + "1\n"))), "orthographic"));
  EXPECT_FALSE(
      says(import_scene(folder_.write("b.fbx", fbx(1, "", "", projection + "0\n"))), "orthographic"));
}

// FBX's own programs write 2: the field of view is that of the height.
TEST_F(Assimp, AnglesOfFbxCamerasAreOfTheHeightWhereTheirApertureModeSaysSo) {
  double aspect = 0;
  const auto screen = [&](const std::string& more) {
    const std::string shape =
        "P: \"AspectWidth\", \"double\", \"Number\", \"\",300\n"
        "P: \"AspectHeight\", \"double\", \"Number\", \"\",200\n";
    const Scene scene = import_scene(folder_.write("a.fbx", fbx(1, "", "", shape + more))).scene;
    aspect = static_cast<double>(scene.film.width) / scene.film.height;  // of whole pixels
    return std::get<PerspectiveCamera>(scene.camera).screen;
  };
  const double half = std::tan(20 * std::numbers::pi / 180);
  const std::string mode = "P: \"ApertureMode\", \"enum\", \"\", \"\",";
  EXPECT_NEAR(screen(mode + "1\n").x1, half, 1e-5);
  EXPECT_NEAR(screen(mode + "2\n").y1, half, 1e-5);
  EXPECT_NEAR(screen(mode + "2\n").x1, aspect * half, 1e-5);
  EXPECT_NEAR(aspect, 1.5, 1e-3);
}

TEST_F(Assimp, BrokenFilesAreRefused) {
  EXPECT_THAT(error_of("a.fbx", "Kaydara FBX Binary  \x00\x1a\x00 and no more"s),
              HasSubstr("cannot read it"));
  EXPECT_THAT(error_of("a.3ds", "MM"), HasSubstr("cannot read it"));
  EXPECT_THAT(error_of("a.dae", "<COLLADA>"), HasSubstr("cannot read it"));
  EXPECT_THAT(error_of("a.dae", "no XML"), HasSubstr("cannot read it"));
  std::string text = collada(phong("") + triangle, node("n", ""));
  const std::size_t at = text.find("0 1 2</p>");
  EXPECT_NE(error_of("a.dae", text.replace(at, 5, "0 1 7")), "");
  EXPECT_THROW(read_assimp(folder_ / "none.fbx"), Error);
}

// Chunks of 3DS: a number of the kind, the length with this head, what is in it.
std::string chunk(std::uint16_t kind, const std::string& inside) {
  const auto length = static_cast<std::uint32_t>(inside.size() + 6);
  std::string bytes(6, '\0');
  std::memcpy(bytes.data(), &kind, 2);
  std::memcpy(bytes.data() + 2, &length, 4);
  return bytes + inside;
}
template <typename T>
std::string numbers(std::uint16_t count, const std::vector<T>& values) {
  std::string bytes(2 + values.size() * sizeof(T), '\0');
  std::memcpy(bytes.data(), &count, 2);
  std::memcpy(bytes.data() + 2, values.data(), values.size() * sizeof(T));
  return bytes;
}

TEST_F(Assimp, AnObjectOf3dsByItsSuffix) {
  const std::string mesh = chunk(0x4110, numbers<float>(3, {0, 0, 0, 1, 0, 0, 0, 0, 2})) +
                           chunk(0x4120, numbers<std::uint16_t>(1, {0, 1, 2, 7}));
  const std::string file =
      chunk(0x4d4d, chunk(0x3d3d, chunk(0x4000, std::string("box\0", 4) + chunk(0x4100, mesh))));
  const ImportedScene imported = import_scene(folder_.write("A.3DS", file));
  ASSERT_EQ(imported.scene.shapes.size(), 1u);
  EXPECT_EQ(imported.scene.meshes.at(0).triangles.size(), 1u);
  Bounds3d box;
  for (const Point3f& p : imported.scene.meshes[0].positions)
    extend(box, transform_point(imported.scene.shapes[0].object_to_world, cast<double>(p)));
  EXPECT_NEAR(box.upper.y, 2, 1e-6);  // +z of the file is up
}

}  // namespace
}  // namespace vitrail::assimp_test
