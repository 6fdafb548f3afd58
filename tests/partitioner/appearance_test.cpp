// SPDX-License-Identifier: Apache-2.0
// What the renderer shows instead of what it does not have.
#include "partitioner/appearance.h"

#include <gtest/gtest.h>

#include "scene/color.h"
#include "scene/rgb_to_spectrum.h"

namespace vitrail {
namespace {

// The last of `materials` is in use.
struct Reduced {
  bundle::Material material;
  Diagnostics diagnostics;
};
Reduced reduce(std::vector<Material> materials, std::vector<Texture> textures = {}) {
  Scene scene;
  scene.files = {"scene.pbrt"};
  scene.textures = std::move(textures);
  scene.materials = std::move(materials);
  scene.materials.back().origin = {0, 7, 3};
  Shape shape;
  shape.material = {static_cast<std::uint32_t>(scene.materials.size() - 1)};
  scene.meshes.emplace_back();
  scene.shapes = {shape};
  Appearance appearance = appearance_of(scene);
  return {appearance.materials.back(), std::move(appearance.diagnostics)};
}
Reduced reduce(MaterialModel model) { return reduce(std::vector{Material{std::move(model)}}); }

// Mean reflectance of what becomes diffuse with a diagnostic that has its place.
double approximated(MaterialModel model) {
  const Reduced reduced = reduce(std::move(model));
  EXPECT_FALSE(reduced.diagnostics.empty());
  for (const Diagnostic& d : reduced.diagnostics) EXPECT_EQ(to_string(d.location), "scene.pbrt:7:3");
  return luminance(std::get<bundle::DiffuseMaterial>(reduced.material).reflectance);
}
Spectrum grey(float value) { return ConstantSpectrum{value}; }

TEST(Appearance, WhatTheRendererHasIsExact) {
  for (const MaterialModel& model :
       std::vector<MaterialModel>{DiffuseMaterial{grey(.25f)}, DielectricMaterial{},
                                  DielectricMaterial{NamedSpectrum{"glass-BK7"}}, InterfaceMaterial{}})
    EXPECT_TRUE(reduce(model).diagnostics.empty()) << model.index();
  DielectricMaterial in_water;
  in_water.exterior_eta = grey(1.25f);
  EXPECT_EQ(reduce(in_water).material, bundle::Material{bundle::DielectricMaterial{grey(1.2f)}});
  EXPECT_TRUE(reduce(in_water).diagnostics.empty());
}

TEST(Appearance, OthersBecomeTheNearest) {
  EXPECT_NEAR(approximated(DiffuseMaterial{grey(.3f), 20.0f}), .3, 1e-4);
  EXPECT_NEAR(approximated(CoatedDiffuseMaterial{grey(.3f)}), .3, 1e-4);
  EXPECT_NEAR(approximated(PlasticMaterial{grey(.4f)}), .4, 1e-4);
  EXPECT_NEAR(approximated(DiffuseTransmissionMaterial{}), .25, 1e-4);
  EXPECT_NEAR(approximated(PrincipledMaterial{grey(.7f)}), .7, 1e-4);
  EXPECT_NEAR(approximated(SubsurfaceMaterial{}), .5, 1e-4);
  EXPECT_NEAR(approximated(HairMaterial{}), .5, 1e-4);
  Material one_sided{DiffuseMaterial{grey(.3f)}};
  one_sided.two_sided = false;
  EXPECT_EQ(reduce(std::vector{one_sided}).diagnostics.size(), 1u);
}

TEST(Appearance, MetalsReflectWhatTheyDoAtNormalIncidence) {
  EXPECT_NEAR(approximated(ConductorMaterial{
                  ComplexIndex{NamedSpectrum{"metal-Ag-eta"}, NamedSpectrum{"metal-Ag-k"}}}),
              .96, .02);
  EXPECT_NEAR(approximated(ConductorMaterial{}), .68, .05) << "copper";
  // ((1.5 − 1)² + 2²) / ((1.5 + 1)² + 2²)
  EXPECT_NEAR(approximated(ConductorMaterial{ComplexIndex{grey(1.5f), grey(2)}}), 4.25 / 10.25, 1e-4);
  EXPECT_NEAR(approximated(ConductorMaterial{PerfectReflector{}, {}, grey(.8f)}), .8, 1e-4);
}

TEST(Appearance, TheHeavierPartStands) {
  const Material glass{DielectricMaterial{}}, chalk{DiffuseMaterial{}};
  const auto blend = [&](float amount) {
    return reduce({glass, chalk, {BlendMaterial{{0}, {1}, amount}}}).material.index();
  };
  EXPECT_EQ(blend(.9f), 0u) << "diffuse";
  EXPECT_EQ(blend(.1f), 1u) << "dielectric";
  EXPECT_EQ(reduce({chalk, {MaskMaterial{.1f, {0}}}}).material,
            bundle::Material{bundle::InterfaceMaterial{}});
  EXPECT_EQ(reduce({chalk, {MaskMaterial{.9f, {0}}}}).material, bundle::Material{bundle::DiffuseMaterial{}});
  EXPECT_TRUE(reduce({chalk, {MaskMaterial{1.0f, {0}}}}).diagnostics.empty());
}

double textured(std::vector<TextureModel> models, bool is_exact) {
  std::vector<Texture> textures;
  for (TextureModel& model : models) textures.push_back({std::move(model)});
  const Id<Texture> last{static_cast<std::uint32_t>(textures.size() - 1)};
  const Reduced reduced = reduce({Material{DiffuseMaterial{last}}}, std::move(textures));
  EXPECT_EQ(reduced.diagnostics.empty(), is_exact);
  return luminance(std::get<bundle::DiffuseMaterial>(reduced.material).reflectance);
}

TEST(Appearance, TexturesBecomeTheirMean) {
  EXPECT_NEAR(textured({MixTexture{grey(.2f), grey(.6f), .25f}}, true), .3, 1e-4);
  EXPECT_NEAR(textured({CheckerboardTexture{grey(.2f), grey(.2f)}}, true), .2, 1e-4);
  EXPECT_NEAR(textured({CheckerboardTexture{grey(.2f), grey(.6f)}}, false), .4, 1e-4);
  EXPECT_NEAR(textured({ImageTexture{}}, false), .5, 1e-4);
  EXPECT_NEAR(textured({ImageTexture{}, ProductTexture{Id<Texture>{0}, grey(.5f)}}, false), .25, 1e-4);
  EXPECT_NEAR(textured({BilinearTexture{grey(0), grey(1), grey(0), grey(1)}}, false), .5, 1e-4);
  EXPECT_NEAR(textured({DotsTexture{grey(0), grey(1)}}, false), .81, .01);
}

TEST(Appearance, DoublingChainsOfTexturesAndMaterialsTakeLinearTime) {
  std::vector<TextureModel> textures{CheckerboardTexture{grey(.2f), grey(.6f)}};
  std::vector<Material> materials{{DiffuseMaterial{}}};
  for (std::uint32_t i = 0; i < 100; ++i) {
    textures.push_back(MixTexture{Id<Texture>{i}, Id<Texture>{i}, .5f});
    materials.push_back({BlendMaterial{{i}, {i}, .75f}});
  }
  EXPECT_NEAR(textured(std::move(textures), false), .4, 1e-4);
  EXPECT_EQ(reduce(std::move(materials)).material.index(), 0u);
}

TEST(Appearance, LightsAreReducedAndCamerasKept) {
  Scene scene;
  scene.lights = {{SpotLight{translate({1, 2, 3}), grey(2)}}, {EnvironmentLight{}}};
  PerspectiveCamera camera;
  camera.lens.radius = 1;
  scene.camera = camera;
  const Appearance appearance = appearance_of(scene);
  EXPECT_EQ(appearance.lights.at(0), (bundle::Light{bundle::PointLight{{1, 2, 3}, grey(2)}}));
  EXPECT_NEAR(luminance(std::get<bundle::InfiniteLight>(appearance.lights.at(1)).radiance), 1, 1e-4);
  EXPECT_EQ(appearance.camera, scene.camera);
  EXPECT_EQ(appearance.diagnostics.size(), 2u);
}

}  // namespace
}  // namespace vitrail
