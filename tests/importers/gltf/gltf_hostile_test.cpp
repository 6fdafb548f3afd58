// SPDX-License-Identifier: Apache-2.0
// Files that are wrong: an error with its place, whatever they say.
#include "tests/importers/gltf/gltf_text.h"

namespace vitrail::test::gltf_hostile_test {
namespace {

// What is said of it, with its place.
std::string error_of(const std::string& text, const char* name = "scene.gltf") {
  const TemporaryFolder folder;
  try {
    read_gltf(folder.write(name, text));
  } catch (const Error& error) {
    return fmt::format("{}:{} {}", error.location.line, error.location.column, error.what());
  }
  return "it was read";
}

std::string of_square(const std::string& members) {
  GltfText file;
  file.add_square();
  return error_of(file.text(members));
}

#define EXPECT_SAYS(said, words) EXPECT_NE(std::string(said).find(words), std::string::npos) << said

TEST(GltfHostile, WhatIsNoGltf) {
  EXPECT_SAYS(error_of(""), "cannot read the glTF");
  EXPECT_SAYS(error_of("{"), "cannot read the glTF");
  EXPECT_SAYS(error_of("{\"asset\":{\"version\":\"1.0\"}}"), "glTF 1.0 is not read");
  EXPECT_SAYS(error_of("glTF", "scene.glb"), "ends within its header");
  EXPECT_SAYS(error_of(std::string("glTF\1\0\0\0\0\0\0\0\0\0\0\0JSON", 20), "scene.glb"),
              "glTF 1 is not read");
  EXPECT_SAYS(error_of(std::string("glTF\2\0\0\0\0\0\0\0\xff\xff\xff\0JSON", 20), "scene.glb"),
              "longer than the file");
}

TEST(GltfHostile, DeepNestingHasItsPlace) {
  std::string deep = "{\"asset\":{\"version\":\"2.0\"},\n\"extras\":";
  for (int i = 0; i < 100'000; ++i) deep += '[';
  EXPECT_SAYS(error_of(deep), "2:");
  EXPECT_SAYS(error_of(deep), "within one another");
}

TEST(GltfHostile, ReferencesAreInRange) {
  const std::string mesh = R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)";
  EXPECT_SAYS(of_square(mesh + R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":9}])"),
              "nodes[0]: refers to meshes[9]");
  EXPECT_SAYS(of_square(mesh + R"("scenes":[{"nodes":[7]}],"nodes":[{"mesh":0}])"), "refers to nodes[7]");
  EXPECT_SAYS(of_square(R"("meshes":[{"primitives":[{"attributes":{"POSITION":77}}]}],)" + one_node),
              "no accessors[77]");
  EXPECT_SAYS(
      of_square(R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":3}]}],)" + one_node),
      "refers to materials[3]");
  EXPECT_SAYS(of_square(square_mesh + "," + one_node + R"(,"materials":[{"normalTexture":{"index":4}}])"),
              "refers to textures[4]");
  EXPECT_SAYS(of_square(R"("scenes":[{"nodes":[0]}],"nodes":[{"camera":-3},{"camera":5}])"), "it was read");
}

TEST(GltfHostile, NodesFormTrees) {
  EXPECT_SAYS(of_square(R"("scenes":[{"nodes":[0]}],"nodes":[{"children":[1]},{"children":[0]}])"),
              "its own ancestor");
  EXPECT_SAYS(of_square(R"("scenes":[{"nodes":[0]}],"nodes":[{"children":[0]}])"), "its own ancestor");
  EXPECT_SAYS(of_square(R"("scenes":[{"nodes":[0]}],"nodes":[{"children":[2]},{"children":[2]},{}])"),
              "is a child of");
  EXPECT_SAYS(of_square("\n\n  \"scenes\":[{\"nodes\":[0]}],\"nodes\":[\n{\"children\":[99]}]"),
              "refers to nodes[99]");
}

TEST(GltfHostile, NumbersAreFinite) {
  EXPECT_SAYS(
      of_square(
          R"("scenes":[{"nodes":[0]}],"nodes":[{"translation":[1e308,1e308,1e308],"scale":[1e308,1,1]},{"matrix":[1,2]}])"),
      "matrix has 2 numbers");
  GltfText file;
  file.floats({0, 0, std::numeric_limits<float>::quiet_NaN(), 1, 0, 0, 0, 1, 0}, 3);
  EXPECT_SAYS(error_of(file.text(R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)" + one_node)),
              "vertex 0 is not finite");
}

TEST(GltfHostile, DataLiesInItsBuffer) {
  const std::string mesh = R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)" + one_node;
  const auto accessor = [&](const std::string& members, const std::string& view = R"("byteLength":48)") {
    GltfText file;
    file.view(std::string(48, '\0'));
    file.views = "{\"buffer\":0," + view + "}";
    file.accessor(members);
    return error_of(file.text(mesh));
  };
  const std::string vec3 = R"("bufferView":0,"componentType":5126,"type":"VEC3",)";
  EXPECT_SAYS(accessor(vec3 + R"("count":5)"), "accessors[0]: 5 elements of 12 bytes end behind");
  EXPECT_SAYS(accessor(vec3 + R"("count":4000000000000)"), "elements");
  EXPECT_SAYS(accessor(vec3 + R"("count":4,"byteOffset":8)"), "end behind");
  EXPECT_SAYS(accessor(vec3 + R"("count":3,"byteOffset":4294967292)"), "end behind");
  EXPECT_SAYS(accessor(vec3 + R"("count":4)", R"("byteLength":48,"byteOffset":4)"), "ends behind buffers[0]");
  EXPECT_SAYS(accessor(vec3 + R"("count":3)", R"("byteLength":48,"byteStride":4)"), "stride of 4 is less");
  EXPECT_SAYS(accessor(R"("bufferView":0,"componentType":5126,"type":"VEC2","count":3)"),
              "numbers an element");
  EXPECT_SAYS(accessor(R"("componentType":5126,"type":"VEC3","count":9999999999)"), "without data");
}

TEST(GltfHostile, IndicesLieInTheMesh) {
  GltfText file;
  file.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, 3);
  file.numbers<std::uint16_t>({0, 1, 3}, 5123, "SCALAR", 1);
  EXPECT_SAYS(error_of(file.text(R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)" +
                                 one_node)),
              "index 2 of its corners is 3");
}

TEST(GltfHostile, ExtensionsThatAreNeededAreRefusedByName) {
  const auto needs = [](const std::string& name) {
    return error_of(
        GltfText{}.text("\"extensionsUsed\":[\"" + name + "\"],\"extensionsRequired\":[\"" + name + "\"]"));
  };
  EXPECT_SAYS(needs("KHR_draco_mesh_compression"), "without compression");
  EXPECT_SAYS(needs("EXT_meshopt_compression"), "without compression");
  EXPECT_SAYS(needs("KHR_texture_basisu"), "PNG or JPEG");
  EXPECT_SAYS(needs("VENDOR_wonder"), "VENDOR_wonder, which is not known");
  EXPECT_TRUE(mentions(read_text(GltfText{}.text(R"("extensionsUsed":["VENDOR_wonder"])")).diagnostics,
                       "VENDOR_wonder"));
}

TEST(GltfHostile, PackedMeshesAreNotReadAsZeros) {
  GltfText file;
  file.view("draco");
  file.accessor(R"("componentType":5126,"type":"VEC3","count":3)");
  EXPECT_SAYS(
      error_of(file.text(
          R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"extensions":{"KHR_draco_mesh_compression":{}}}]}],)" +
          one_node)),
      "without compression");
  GltfText packed;
  packed.accessor(R"("componentType":5126,"type":"VEC3","count":3)");
  packed.accessor(R"("componentType":5123,"type":"SCALAR","count":3)");
  EXPECT_SAYS(
      error_of(packed.text(
          R"("extensionsRequired":["KHR_draco_mesh_compression"],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,)"
          R"("extensions":{"KHR_draco_mesh_compression":{}}}]}],)" +
          one_node)),
      "without compression");
}

TEST(GltfHostile, BuffersThatAreMissing) {
  EXPECT_SAYS(error_of(R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":4,"uri":"none.bin"}]})"),
              "cannot open");
}

}  // namespace
}  // namespace vitrail::test::gltf_hostile_test
