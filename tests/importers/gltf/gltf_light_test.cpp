// SPDX-License-Identifier: Apache-2.0
// Light of glTF against closed forms: a picture shows cd/m².
#include <cmath>

#include "scene/geometry/pi.h"
#include "tests/importers/gltf/gltf_text.h"
#include "tests/support/render.h"

namespace vitrail::test::gltf_light_test {
namespace {

constexpr double albedo = 0.5;

// What a Lambertian floor of that albedo shows from above, of a scene with these lights and other nodes.
double shown(const std::string& nodes, const std::string& more) {
  GltfText file;
  file.add_square();
  const double h = std::sqrt(0.5);
  ImportedScene imported = read_text(file.text(
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]},{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":1}]}],)"
      R"("materials":[{"pbrMetallicRoughness":{"baseColorFactor":[0.5,0.5,0.5,1],"metallicFactor":0},"extensions":{"KHR_materials_specular":{"specularFactor":0}}},)"
      R"({"pbrMetallicRoughness":{"baseColorFactor":[0,0,0,1],"metallicFactor":0},"emissiveFactor":[1,1,1],"extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":50}}}],)"
      R"("cameras":[{"type":"perspective","perspective":{"yfov":0.002,"aspectRatio":1,"znear":0.1}}],)" +
      fmt::format(
          R"("scenes":[{{"nodes":[0,1,2]}}],"nodes":[{{"mesh":0,"scale":[9,9,9]}},{{"camera":0,"translation":[0,4,0],"rotation":[{},0,0,{}]}},{}])",
          -h, h, nodes) +
      more));
  FilmSettings& film = imported.scene.film;
  film.width = film.height = 4, film.crop = {0, 4, 0, 4};
  return brightness(render(imported.scene, 256).film).mean;
}

std::string light(const std::string& members) {
  return R"(,"extensions":{"KHR_lights_punctual":{"lights":[{)" + members + "}]}}";
}
constexpr const char* reference = R"("extensions":{"KHR_lights_punctual":{"light":0}}})";

TEST(GltfLight, CandelaOfAPoint) {
  const double expected = albedo / pi * 100 / (2 * 2);
  EXPECT_NEAR(shown(std::string(R"({"translation":[0,2,0],)") + reference,
                    light(R"("type":"point","intensity":100)")),
              expected, 2e-3 * expected);
}

TEST(GltfLight, LuxOfTheSun) {
  // Turned by 60° about x: from −z to 60° below the horizon.
  const double expected = albedo / pi * 1000 * std::sin(pi / 3);
  EXPECT_NEAR(
      shown(fmt::format(R"({{"rotation":[{},0,0,{}],)", -std::sin(pi / 6), std::cos(pi / 6)) + reference,
            light(R"("type":"directional","intensity":1000)")),
      expected, 2e-3 * expected);
}

TEST(GltfLight, CandelaPerSquareMetreOfALamp) {
  // 50 cd/m² over 0.1 × 0.1, 10 above, facing down: E = L·A/d².
  const double expected = albedo / pi * 50 * 0.01 / 100;
  EXPECT_NEAR(shown(R"({"mesh":1,"translation":[0,10,0],"rotation":[1,0,0,0],"scale":[0.05,0.05,0.05]})", ""),
              expected, 4e-3 * expected);
}

}  // namespace
}  // namespace vitrail::test::gltf_light_test
