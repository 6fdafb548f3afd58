// SPDX-License-Identifier: Apache-2.0
// What POV-Ray's normals become.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "importers/povray/read/povray.h"
#include "tests/importers/temporary_folder.h"

namespace vitrail::read_bumps_test {
namespace {

class ReadPovrayBumps : public ::testing::Test {
 protected:
  ImportedScene read(const std::string& text) {
    const auto path = folder_.path() / "scene.pov";
    std::ofstream(path) << "#version 3.7; global_settings { assumed_gamma 1 }\n" << text;
    return read_povray(path);
  }
  // Of a sphere with this `normal {}`.
  ImportedScene with_normal(const std::string& normal, const std::string& more = "") {
    return read("sphere { 0, 1 texture { pigment { rgb .5 } normal { " + normal + " } " + more + " } }");
  }
  static std::vector<const PatternTexture*> bumps_of(const Scene& scene) {
    std::vector<const PatternTexture*> found;
    for (const Material& material : scene.materials)
      if (material.displacement)
        found.push_back(&std::get<PatternTexture>(
            scene.textures.at(std::get<Id<Texture>>(*material.displacement).value).model));
    return found;
  }
  static double number(const SpectrumParameter& p) {
    return static_cast<double>(std::get<ConstantSpectrum>(std::get<Spectrum>(p)).value);
  }
  static bool says(const ImportedScene& scene, const std::string& text) {
    for (const auto& note : scene.diagnostics)
      if (note.message.find(text) != std::string::npos) return true;
    return false;
  }

  TemporaryFolder folder_;
};

TEST_F(ReadPovrayBumps, NormalsAreHeights) {
  const ImportedScene read = with_normal("marble 0.75 scale 2", "scale 3");
  const auto bumps = bumps_of(read.scene);
  ASSERT_EQ(bumps.size(), 1u);
  EXPECT_EQ(bumps[0]->kind, PatternTexture::Kind::marble);
  EXPECT_NEAR(bumps[0]->texture_to_world.m[0][0], 6, 1e-12);
  ASSERT_EQ(bumps[0]->map.size(), 2u);
  EXPECT_NEAR(number(bumps[0]->map[1].value), 0.75 * 2 / 15, 1e-7);
  EXPECT_FALSE(says(read, "smooth"));
}

TEST_F(ReadPovrayBumps, AmountsOfNormals) {
  const auto amount = [&](const std::string& normal) {
    const ImportedScene read = with_normal(normal);
    return number(bumps_of(read.scene).at(0)->map.back().value) * 15 / 2;
  };
  EXPECT_NEAR(amount("bumps"), 0.5, 1e-6);
  EXPECT_NEAR(amount("bumps 0.3"), 0.3, 1e-6);
  EXPECT_NEAR(amount("bumps 0.3 bump_size 2"), 2, 1e-6);
  EXPECT_NEAR(amount("bumps -1.5 scale 4"), -1.5, 1e-6);
  EXPECT_NEAR(amount("bumps 1 scale 4 no_bump_scale"), 0.25, 1e-6);
}

TEST_F(ReadPovrayBumps, SlopeMaps) {
  const ImportedScene straight =
      with_normal("gradient x, 1 slope_map { [0 <0, 1>] [0.5 <1, 1>] [0.5 <1, -1>] [1 <0, -1>] }");
  EXPECT_EQ(bumps_of(straight.scene).at(0)->map.size(), 4u);
  const ImportedScene curved = with_normal("gradient x, 1 slope_map { [0 <0, 0>] [1 <1, 0>] }");
  const PatternTexture& t = *bumps_of(curved.scene).at(0);
  ASSERT_EQ(t.map.size(), 17u);
  for (const PatternStop& stop : t.map) {
    const double at = static_cast<double>(stop.at);
    EXPECT_NEAR(number(stop.value), at * at * (3 - 2 * at) * 2 / 15, 1e-6);
  }
}

TEST_F(ReadPovrayBumps, SeveralNormalsAreSeveralMaterials) {
  const ImportedScene map = with_normal("gradient x normal_map { [0.4 bumps 1] [0.6 dents 2] }");
  const auto bumps = bumps_of(map.scene);
  ASSERT_EQ(bumps.size(), 2u);
  EXPECT_EQ(bumps[0]->kind, PatternTexture::Kind::bumps);
  EXPECT_EQ(bumps[1]->kind, PatternTexture::Kind::dents);
  EXPECT_TRUE(std::holds_alternative<BlendMaterial>(map.scene.materials.back().model));
  const ImportedScene list = with_normal("checker normal { bumps 1 } normal { gradient y, 1 }");
  EXPECT_EQ(bumps_of(list.scene).size(), 2u);
  const ImportedScene average = with_normal("average normal_map { [1 bumps 1] [3 dents 2] }");
  const auto& blend = std::get<BlendMaterial>(average.scene.materials.back().model);
  EXPECT_EQ(blend.amount, FloatParameter{0.75f});
}

TEST_F(ReadPovrayBumps, TheSameTextureElsewhereIsTilted) {
  const ImportedScene two = read(
      "#declare T = texture { pigment { rgb .5 } normal { bumps 1 } }"
      "sphere { 0, 1 texture { T } } sphere { 0, 1 texture { T } translate 3*x }"
      "sphere { 0, 1 texture { pigment { rgb .5 } } translate 6*x }");
  EXPECT_EQ(bumps_of(two.scene).size(), 2u);
}

}  // namespace
}  // namespace vitrail::read_bumps_test
