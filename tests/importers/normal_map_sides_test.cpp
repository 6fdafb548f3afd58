// SPDX-License-Identifier: Apache-2.0
// Normal maps of models that are symmetric about x = 0, under a sun in that plane: their pictures are
// symmetric, as bright as the normal in the map says.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "importers/export.h"
#include "importers/import.h"
#include "scene/models/normal_map.h"
#include "scene/records/material_traits.h"
#include "tests/importers/gltf/gltf_text.h"
#include "tests/importers/temporary_folder.h"
#include "tests/support/png.h"
#include "tests/support/render.h"

namespace vitrail::normal_map_sides_test {
namespace {

// A square of x and y from −1 to 1 that shows its image twice: on the right as it is, on the left mirrored.
constexpr const char* obj_square =
    "mtllib m.mtl\nusemtl m\nv -1 -1 0\nv 0 -1 0\nv 1 -1 0\nv 1 1 0\nv 0 1 0\nv -1 1 0\n"
    "vt 1 0\nvt 0 0\nvt 1 1\nvt 0 1\n"
    "f 1/1 2/2 5/4 6/3\nf 2/2 3/1 4/3 5/4\n";

// COLLADA and FBX: the same, or its right half alone, at these places.
struct Layout {
  std::string vertices, uvs, faces, uv_faces;
  std::vector<std::string> scales;  // of nodes that show it
};
const Layout whole{"-1 -1 0 0 -1 0 1 -1 0 1 1 0 0 1 0 -1 1 0",
                   "1 0 0 0 1 1 0 1",
                   "0 1 4 5 1 2 3 4",
                   "0 1 3 2 1 0 2 3",
                   {"1 1 1"}};
const Layout half{"0 -1 0 1 -1 0 1 1 0 0 1 0", "0 0 1 0 1 1 0 1", "0 1 2 3", "0 1 2 3", {"1 1 1", "-1 1 1"}};

std::string commas(std::string text) {
  std::ranges::replace(text, ' ', ',');
  return text;
}

// The numbers of faces of four corners, woven: vertex, (u,v).
std::string woven(const std::string& a, const std::string& b) {
  std::string out;
  for (std::size_t i = 0; i < a.size(); i += 2) out += fmt::format("{} {} ", a[i], b[i]);
  return out;
}

std::string collada(const Layout& layout) {
  const auto source = [](const char* id, const std::string& numbers, const std::string& names) {
    const auto count = std::ranges::count(numbers, ' ') + 1;
    const std::size_t stride = names.size();
    std::string params;
    for (const char name : names) params += fmt::format(R"(<param name="{}" type="float"/>)", name);
    return fmt::format(
        R"(<source id="{0}"><float_array id="{0}a" count="{1}">{2}</float_array><technique_common>
        <accessor source="#{0}a" count="{3}" stride="{4}">{5}</accessor></technique_common></source>)",
        id, count, numbers, static_cast<std::size_t>(count) / stride, stride, params);
  };
  std::string nodes;
  for (std::size_t i = 0; i < layout.scales.size(); ++i)
    nodes += fmt::format(
        R"(<node id="n{}"><scale>{}</scale><instance_geometry url="#g"><bind_material><technique_common>
        <instance_material symbol="m" target="#m"/></technique_common></bind_material></instance_geometry></node>)",
        i, layout.scales[i]);
  const auto faces = (layout.faces.size() + 1) / 8;
  std::string counts;
  for (std::size_t i = 0; i < faces; ++i) counts += "4 ";
  return R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><up_axis>Y_UP</up_axis></asset>
  <library_images><image id="i"><init_from>n.png</init_from></image></library_images>
  <library_effects><effect id="e"><profile_COMMON>
    <newparam sid="s"><surface type="2D"><init_from>i</init_from></surface></newparam>
    <newparam sid="t"><sampler2D><source>s</source></sampler2D></newparam>
    <technique sid="c"><lambert><diffuse><color>.5 .5 .5 1</color></diffuse></lambert>
      <extra><technique profile="FCOLLADA"><bump><texture texture="t" texcoord="UV"/></bump></technique></extra>
    </technique></profile_COMMON></effect></library_effects>
  <library_materials><material id="m" name="m"><instance_effect url="#e"/></material></library_materials>
  <library_geometries><geometry id="g" name="g"><mesh>)" +
         source("p", layout.vertices, "XYZ") + source("w", layout.uvs, "ST") +
         fmt::format(
             R"(<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
    <polylist count="{}" material="m"><input semantic="VERTEX" source="#v" offset="0"/>
    <input semantic="TEXCOORD" source="#w" offset="1"/><vcount>{}</vcount><p>{}</p></polylist>)",
             faces, counts, woven(layout.faces, layout.uv_faces)) +
         R"(</mesh></geometry></library_geometries><library_visual_scenes><visual_scene id="s">)" + nodes +
         R"(</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

std::string fbx(const Layout& layout) {
  std::string corners;
  for (std::size_t i = 0; i < layout.faces.size(); i += 2) {
    const int corner = layout.faces[i] - '0';
    corners += fmt::format("{}{}", corners.empty() ? "" : ",", i % 8 == 6 ? -corner - 1 : corner);
  }
  const auto list = [](const char* name, const std::string& numbers) {
    return fmt::format("{}: *{} {{\n a: {}\n }}\n", name, std::ranges::count(numbers, ',') + 1, numbers);
  };
  std::string models, connections;
  for (std::size_t i = 0; i < layout.scales.size(); ++i) {
    models += fmt::format(
        "Model: {}, \"Model::q{}\", \"Mesh\" {{\n Version: 232\n Properties70:  {{\n"
        "P: \"Lcl Scaling\", \"Lcl Scaling\", \"\", \"A\",{}\n }}\n}}\n",
        11 + i, i, commas(layout.scales[i]));
    connections += fmt::format(" C: \"OO\",{0},0\n C: \"OO\",1,{0}\n C: \"OO\",5,{0}\n", 11 + i);
  }
  return "; FBX 7.3.0 project file\nFBXHeaderExtension:  {\n FBXHeaderVersion: 1003\n FBXVersion: 7300\n}\n"
         "GlobalSettings:  {\n Version: 1000\n Properties70:  {\n"
         "P: \"UnitScaleFactor\", \"double\", \"Number\", \"\",100\n }\n}\nObjects:  {\n"
         "Geometry: 1, \"Geometry::q\", \"Mesh\" {\n" +
         list("Vertices", commas(layout.vertices)) + list("PolygonVertexIndex", corners) +
         "GeometryVersion: 124\nLayerElementUV: 0 {\n Version: 101\n Name: \"UV\"\n"
         " MappingInformationType: \"ByPolygonVertex\"\n ReferenceInformationType: \"IndexToDirect\"\n" +
         list("UV", commas(layout.uvs)) + list("UVIndex", commas(layout.uv_faces)) +
         "}\nLayerElementMaterial: 0 {\n Version: 101\n Name: \"\"\n MappingInformationType: \"AllSame\"\n"
         " ReferenceInformationType: \"IndexToDirect\"\n Materials: *1 {\n a: 0\n }\n}\n"
         "Layer: 0 {\n Version: 100\n LayerElement:  {\n Type: \"LayerElementUV\"\n TypedIndex: 0\n }\n"
         " LayerElement:  {\n Type: \"LayerElementMaterial\"\n TypedIndex: 0\n }\n}\n}\n"
         "Material: 5, \"Material::m\", \"\" {\n Version: 102\n ShadingModel: \"lambert\"\n Properties70:  "
         "{\n"
         "P: \"DiffuseColor\", \"Color\", \"\", \"A\",0.5,0.5,0.5\n }\n}\n"
         "Texture: 6, \"Texture::t\", \"\" {\n Type: \"TextureVideoClip\"\n Version: 202\n"
         " TextureName: \"Texture::t\"\n FileName: \"n.png\"\n RelativeFilename: \"n.png\"\n}\n" +
         models + "}\nConnections:  {\n C: \"OP\",6,5, \"NormalMap\"\n" + connections + "}\n";
}

std::string gltf(const Layout& layout) {
  test::GltfText file;
  if (layout.scales.size() == 1) {
    file.floats({-1, -1, 0, 0, -1, 0, 0, 1, 0, -1, 1, 0, 0, -1, 0, 1, -1, 0, 1, 1, 0, 0, 1, 0}, 3);
    file.numbers<std::uint16_t>({0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7}, 5123, "SCALAR", 1);
    file.floats({1, 1, 0, 1, 0, 0, 1, 0, 0, 1, 1, 1, 1, 0, 0, 0}, 2);
  } else {
    file.floats({0, -1, 0, 1, -1, 0, 1, 1, 0, 0, 1, 0}, 3);
    file.numbers<std::uint16_t>({0, 1, 2, 0, 2, 3}, 5123, "SCALAR", 1);
    file.floats({0, 1, 1, 1, 1, 0, 0, 0}, 2);
  }
  std::string nodes, names;
  for (std::size_t i = 0; i < layout.scales.size(); ++i) {
    nodes += fmt::format(R"({}{{"mesh":0,"scale":[{}]}})", i ? "," : "", commas(layout.scales[i]));
    names += fmt::format("{}{}", i ? "," : "", i);
  }
  return file.text(
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":2},"indices":1,"material":0}]}],)"
      R"("materials":[{"normalTexture":{"index":0},"pbrMetallicRoughness":{"metallicFactor":0}}],)"
      R"("textures":[{"source":0}],"images":[{"uri":"n.png"}],"scenes":[{"nodes":[)" +
      names + R"(]}],"nodes":[)" + nodes + "]");
}

struct Halves {
  double left = 0, right = 0;
};

class NormalMapSides : public testing::Test {
 protected:
  NormalMapSides() {
    std::vector<std::uint8_t> pixels;
    for (int i = 0; i < 4; ++i) pixels.insert(pixels.end(), colour.begin(), colour.end());
    test::write_png(folder_ / "n.png", 2, 2, 3, pixels);
    folder_.write("m.mtl", "newmtl m\nKd .5 .5 .5\nillum 1\nnorm n.png\n");
  }

  // Each half of the picture over that of the same model with all its material's maps left out.
  static Halves over_flat(Scene scene) {
    const Halves mapped = halves(scene);
    for (Material& material : scene.materials) material.normal_map.reset();
    const Halves flat = halves(scene);
    return {mapped.left / flat.left, mapped.right / flat.right};
  }

  void expect_symmetric(const Scene& scene, const std::string& what) {
    const Halves found = over_flat(scene);
    EXPECT_NEAR(found.right, expected(), 0.01) << what;
    EXPECT_NEAR(found.left, expected(), 0.01) << what;
  }

  // As it is read, and as it is read of what is written of it.
  void expect_symmetric(const std::string& name, const std::string& text) {
    const Scene scene = import_scene(folder_.write(name, text)).scene;
    expect_symmetric(scene, name);
    for (const char* other : {"out.obj", "out.gltf", "out.pbrt", "out.xml"}) {
      export_scene(scene, folder_ / other);
      expect_symmetric(import_scene(folder_ / other).scene, name + " to " + other);
    }
  }

  // Light by the map's normal over that by the square's.
  static double expected() {
    std::array<double, 3> n;
    for (std::size_t i = 0; i < 3; ++i) n[i] = 2 * colour[i] / 255.0 - 1;
    const double length = std::hypot(n[0], n[1], n[2]);
    return (0.6 * n[1] + 0.8 * n[2]) / length / 0.8;
  }

  TemporaryFolder folder_;

 private:
  static Halves halves(Scene scene) {
    scene.lights.clear();
    scene.lights.push_back({DistantLight{normalize(Vector3d{0, -0.6, -0.8}), ConstantSpectrum{1}}});
    for (Material& material : scene.materials)
      if (!is_made_of_others(material)) material.model = DiffuseMaterial{Spectrum{ConstantSpectrum{0.5f}}};
    constexpr int side = 8;
    test::set_camera(scene, {0, 0, 20}, {0, 0, 0}, {0, 1, 0}, 0.09, side, side);
    const Film film = test::render(scene, 16).film;
    Halves sum;
    for (int i = 0; i < side * side; ++i)
      (i % side < side / 2 ? sum.left : sum.right) += film.mean(static_cast<std::uint32_t>(i)).y;
    return sum;
  }

  static constexpr std::array<std::uint8_t, 3> colour{160, 190, 230};
};

TEST_F(NormalMapSides, OfMeshesThatAreMirrored) {
  expect_symmetric("a.obj", obj_square);
  expect_symmetric("a.gltf", gltf(whole));
  expect_symmetric("a.dae", collada(whole));
  expect_symmetric("a.fbx", fbx(whole));
}

TEST_F(NormalMapSides, OfInstancesThatAreMirrored) {
  expect_symmetric("b.gltf", gltf(half));
  expect_symmetric("b.dae", collada(half));
  expect_symmetric("b.fbx", fbx(half));
}

TEST_F(NormalMapSides, OfMaterialsWithinMasks) {
  folder_.write("m.mtl", "newmtl m\nKd .5 .5 .5\nillum 1\nnorm n.png\nmap_d n.png\n");
  const Scene scene = import_scene(folder_.write("c.obj", obj_square)).scene;
  const auto factor = [&](std::size_t shape) {
    const Material& outer = scene.materials.at(scene.shapes.at(shape).material.value);
    const Material& inner = scene.materials.at(std::get<MaskMaterial>(outer.model).material.value);
    return normal_map_of(scene.textures, inner.normal_map.value()).value().factors[1];
  };
  ASSERT_EQ(scene.shapes.size(), 2u);
  EXPECT_EQ(factor(0), 1);
  EXPECT_EQ(factor(1), -1);
}

}  // namespace
}  // namespace vitrail::normal_map_sides_test
