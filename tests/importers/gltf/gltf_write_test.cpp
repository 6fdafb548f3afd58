// SPDX-License-Identifier: Apache-2.0
// What is written as glTF, and read again.
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "images/image_files.h"
#include "importers/export.h"
#include "importers/gltf/units.h"
#include "importers/gltf/write/write_gltf.h"
#include "importers/import.h"
#include "tests/importers/gltf/gltf_text.h"
#include "tests/support/equal_scenes.h"
#include "tests/support/png.h"

namespace vitrail::test::gltf_write_test {
namespace {

// A scene of glTF with most of what comes back as it was.
std::string whole_scene(const std::string& image) {
  GltfText file;
  file.add_square();
  const int colors = file.floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}, 3);
  return file.text(
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":2},"indices":1,"material":0}]},)"
      R"({"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":1}]},)" +
      fmt::format(
          R"({{"primitives":[{{"attributes":{{"POSITION":0,"COLOR_0":{}}},"indices":1,"material":2}}]}}],)",
          colors) +
      R"("images":[{"uri":")" + image +
      R"("}],"textures":[{"source":0,"sampler":0}],"samplers":[{"wrapS":33648,"wrapT":33648}],)"
      R"("materials":[{"name":"floor","doubleSided":true,"alphaMode":"MASK","alphaCutoff":0.25,"pbrMetallicRoughness":{"metallicFactor":0.5,)"
      R"("roughnessFactor":0.75,"baseColorTexture":{"index":0,"extensions":{"KHR_texture_transform":{"offset":[0.5,0.25],"scale":[2,4]}}},)"
      R"("metallicRoughnessTexture":{"index":0}},"normalTexture":{"index":0}},)"
      R"({"name":"lamp","doubleSided":true,"emissiveFactor":[1,0.5,0.25],"extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":8}}},)"
      R"({"name":"colours","doubleSided":true,"extensions":{"KHR_materials_ior":{"ior":1.25}}}],)"
      R"("cameras":[{"type":"perspective","perspective":{"yfov":0.5,"aspectRatio":2,"znear":0.1}}],)"
      R"("extensions":{"KHR_lights_punctual":{"lights":[{"type":"point","intensity":100,"color":[1,0.5,0.25]},{"type":"directional","intensity":2}]}},)"
      R"("scenes":[{"nodes":[0,1,2,3,4,5,6]}],"nodes":[{"camera":0,"translation":[0,1,9]},{"mesh":0},{"mesh":1,"translation":[0,4,0],"scale":[-1,1,1]},)"
      R"({"mesh":2,"translation":[2,1,0]},{"mesh":2,"translation":[-2,1,0],"scale":[1,-1,1]},)"
      R"({"translation":[1,2,3],"extensions":{"KHR_lights_punctual":{"light":0}}},{"extensions":{"KHR_lights_punctual":{"light":1}}}])");
}

class WriteGltf : public ::testing::Test {
 protected:
  WriteGltf() {
    write_png(folder_ / "a.png", 2, 2, 4, {255, 0, 0, 255, 0, 99, 255, 0, 1, 2, 3, 4, 250, 240, 230, 220});
  }
  ImportedScene read() { return import_scene(folder_.write("in.gltf", whole_scene("a.png"))); }

  TemporaryFolder folder_;
};

TEST_F(WriteGltf, WhatIsReadComesBack) {
  const ImportedScene first = read();
  for (const char* name : {"out.glb", "out.gltf"}) {
    const Diagnostics said = export_scene(first.scene, folder_ / name);
    for (const Diagnostic& d : said) ADD_FAILURE() << d.message;
    ImportedScene second = import_scene(folder_ / name);
    ASSERT_EQ(second.scene.textures.size(), first.scene.textures.size());
    // The image lies in the new file.
    for (Texture& t : second.scene.textures)
      if (auto* image = std::get_if<ImageTexture>(&t.model)) image->filename = (folder_ / "a.png").string();
    EXPECT_EQ(second.scene.film.width, first.scene.film.width);
    EXPECT_EQ(difference(first.scene, second.scene), "") << name;
  }
}

// A chair of two materials is one node, and lamps of one material have one.
TEST_F(WriteGltf, ObjectsOfAnObjAreNodes) {
  folder_.write("m.mtl", "newmtl oak\nKd .5 .4 .3\nnewmtl glow\nKd 0 0 0\nKe 1 1 1\n");
  const ImportedScene scene = import_scene(folder_.write(
      "in.obj",
      "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 1\no chair\nusemtl oak\nf 1 2 3\nusemtl glow\nf 1 2 4\n"
      "o lamp\nf 1 3 4\no table\nusemtl oak\nf 2 3 4\n"));
  ASSERT_EQ(scene.scene.shapes.size(), 4u);
  export_scene(scene.scene, folder_ / "out.gltf");
  std::ifstream in(folder_ / "out.gltf");
  const auto json = nlohmann::json::parse(in);
  std::multiset<std::string> nodes;
  for (const auto& node : json.at("nodes"))
    if (node.contains("mesh")) nodes.insert(node.at("name").get<std::string>());
  EXPECT_EQ(nodes, (std::multiset<std::string>{"chair", "lamp", "table"}));
  EXPECT_EQ(json.at("materials").size(), 2u);
}

TEST_F(WriteGltf, OneFileGivesTheSameBytesTwice) {
  const ImportedScene first = read();
  export_scene(first.scene, folder_ / "a.glb"), export_scene(first.scene, folder_ / "b.glb");
  const auto bytes = [&](const char* name) {
    std::ifstream in(folder_ / name, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  EXPECT_EQ(bytes("a.glb"), bytes("b.glb"));
  EXPECT_EQ(bytes("a.glb").size() % 4, 0u);
}

TEST_F(WriteGltf, ImagesWithinItGoBesideOtherFormats) {
  export_scene(read().scene, folder_ / "middle.glb");
  const ImportedScene middle = import_scene(folder_ / "middle.glb");
  export_scene(middle.scene, folder_ / "out.pbrt");
  const auto bytes = [](const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  EXPECT_EQ(bytes(folder_ / "out-images/000000.png"), bytes(folder_ / "a.png"));
  EXPECT_FALSE(import_scene(folder_ / "out.pbrt").scene.textures.empty());
}

TEST_F(WriteGltf, MirroredViewsMirrorTheScene) {
  Scene scene = read().scene;
  auto& camera = std::get<PerspectiveCamera>(scene.camera);
  camera.camera_to_world = camera.camera_to_world * scale({-1, 1, 1});
  const auto seen = [](const Scene& s, std::size_t light) {
    const auto& c = std::get<PerspectiveCamera>(s.camera);
    const Point3d p =
        transform_point(inverse(c.camera_to_world), std::get<PointLight>(s.lights.at(light).model).position);
    return Point2d{p.x / p.z, p.y / p.z};
  };
  export_scene(scene, folder_ / "out.glb");
  const ImportedScene again = import_scene(folder_ / "out.glb");
  EXPECT_NEAR(seen(again.scene, 0).x, seen(scene, 0).x, 1e-9);
  EXPECT_NEAR(seen(again.scene, 0).y, seen(scene, 0).y, 1e-9);
  EXPECT_EQ(again.scene.shapes.at(0).flip_orientation, true) << "fronts stay";
}

TEST_F(WriteGltf, ChannelsOfTwoImagesBecomeOne) {
  write_png(folder_ / "r.png", 1, 1, 1, {51});
  Scene scene = read().scene;
  ImageTexture image;
  image.filename = (folder_ / "r.png").string(), image.encoding = Encoding::linear;
  scene.textures.push_back({image, true});
  const Id<Texture> id{static_cast<std::uint32_t>(scene.textures.size() - 1)};
  PrincipledMaterial material;
  material.roughness = id, material.metallic = 1.0f;
  scene.materials.at(scene.shapes.at(0).material.value).model = material;
  export_scene(scene, folder_ / "out.glb");
  const ImportedScene again = import_scene(folder_ / "out.glb");
  const auto& m = std::get<PrincipledMaterial>(again.scene.materials.at(0).model);
  const auto& packed =
      std::get<ImageTexture>(again.scene.textures.at(std::get<Id<Texture>>(m.roughness).value).model);
  const StoredImage stored = read_stored_image(packed.filename);
  EXPECT_FLOAT_EQ(stored.image.values.at(1), 0.2f) << "green";
  EXPECT_EQ(stored.image.values.at(2), 1.0f) << "blue: metal";
}

// Blender cuts at a zfar of 0, which tinygltf writes where none is set.
TEST_F(WriteGltf, CamerasReachAllThatThereIs) {
  export_scene(read().scene, folder_ / "out.gltf");
  std::ifstream in(folder_ / "out.gltf");
  const std::string text(std::istreambuf_iterator<char>(in), {});
  const std::size_t at = text.find("\"zfar\":");
  ASSERT_NE(at, std::string::npos);
  EXPECT_GT(std::stod(text.substr(at + 7)), 10) << "from (0,1,9) to (-3,1,-1)";
}

TEST_F(WriteGltf, SaysWhatIsLost) {
  Scene scene = read().scene;
  scene.lights.push_back({InfiniteLight{ConstantSpectrum{1}}});
  scene.materials.at(0).displacement = FloatParameter{1.0f};
  const Diagnostics said = write_gltf(scene, folder_ / "out.glb");
  EXPECT_TRUE(mentions(said, "light from all around: glTF has none"));
  EXPECT_TRUE(mentions(said, "displacement"));
}

TEST_F(WriteGltf, FadingLampsAreAsBrightAtTheMiddle) {
  Scene scene = read().scene;
  std::get<PointLight>(scene.lights.at(0).model).fading = Fading{};
  const Diagnostics said = write_gltf(scene, folder_ / "out.glb");
  EXPECT_TRUE(mentions(said, "it weakens as 1/d² and not as POV-Ray's"));
}

}  // namespace
}  // namespace vitrail::test::gltf_write_test
