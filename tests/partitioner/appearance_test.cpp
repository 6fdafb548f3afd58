// SPDX-License-Identifier: Apache-2.0
// What a bundle keeps of a scene's appearance.
#include "partitioner/appearance/appearance.h"

#include <gtest/gtest.h>

#include "scene/models/hair_color.h"
#include "scene/spectra/color.h"
#include "scene/spectra/rgb_to_spectrum.h"

namespace vitrail::appearance_test {
namespace {

// The last of `materials` is in use.
Appearance baked(std::vector<Material> materials, std::vector<Texture> textures = {}) {
  Scene scene;
  scene.files = {"scene.pbrt"};
  scene.textures = std::move(textures);
  scene.materials = std::move(materials);
  scene.materials.back().origin = {0, 7, 3};
  Shape shape;
  shape.material = {static_cast<std::uint32_t>(scene.materials.size() - 1)};
  scene.meshes.emplace_back();
  scene.shapes = {shape};
  return appearance_of(scene, {});
}
Appearance baked(MaterialModel model) { return baked(std::vector{Material{std::move(model)}}); }
Spectrum grey(float value) { return ConstantSpectrum{value}; }

TEST(Appearance, WhatTheRendererHasStaysAsItIs) {
  for (const MaterialModel& model : std::vector<MaterialModel>{
           DiffuseMaterial{grey(.25f), 20.0f}, DielectricMaterial{}, ThinDielectricMaterial{},
           ConductorMaterial{PerfectReflector{}}, PlasticMaterial{}, CoatedDiffuseMaterial{},
           DiffuseTransmissionMaterial{}, PrincipledMaterial{}, InterfaceMaterial{}, SlabMaterial{}}) {
    const Appearance a = baked(model);
    EXPECT_TRUE(a.diagnostics.empty()) << model.index();
    EXPECT_EQ(a.materials.at(0).model, model) << model.index();
  }
}

TEST(Appearance, SpectraAreResolved) {
  const Appearance a = baked(ConductorMaterial{});
  const auto& metal = std::get<ConductorMaterial>(a.materials.at(0).model).metal;
  EXPECT_EQ(std::get<ComplexIndex>(metal).eta, SpectrumParameter{resolved(NamedSpectrum{"metal-Cu-eta"})});
}

TEST(Appearance, SpectraOfEveryPlaceAreResolved) {
  const Spectrum named = NamedSpectrum{"metal-Cu-eta"};
  const SpectrumParameter expected = resolved(named);
  PrincipledMaterial principled;
  principled.base_color = named;
  const Appearance whole = baked(principled);
  EXPECT_EQ(std::get<PrincipledMaterial>(whole.materials.at(0).model).base_color, expected);
  const Appearance corners = baked({Material{DiffuseMaterial{Id<Texture>{0}}}},
                                   {Texture{BilinearTexture{named, named, named, named}}});
  const auto& bilinear = std::get<BilinearTexture>(corners.textures.at(0).model);
  for (const SpectrumParameter& corner : {bilinear.v00, bilinear.v01, bilinear.v10, bilinear.v11})
    EXPECT_EQ(corner, expected);
  Scene sky;
  sky.lights.resize(1);
  sky.lights[0].model = SkyLight{};
  std::get<SkyLight>(sky.lights[0].model).albedo = named;
  const Appearance day = appearance_of(sky, {});
  EXPECT_EQ(*std::get<SkyLight>(day.lights.at(0).model).albedo, resolved(named));
}

// As rough, light found behind it would be weighed against connections, which it blocks.
TEST(Appearance, RoughGlassBetweenEqualIndicesIsSmooth) {
  const DielectricMaterial rough{grey(1.5f), grey(1.5f), Roughness{0.2f, 0.2f}};
  const Appearance a = baked(rough);
  EXPECT_TRUE(a.diagnostics.empty());
  EXPECT_EQ(std::get<DielectricMaterial>(a.materials.at(0).model).roughness, Roughness{});
}

TEST(Appearance, OthersBecomeTheNearestAndSaySo) {
  const auto reflectance = [](MaterialModel model) {
    const Appearance a = baked(std::move(model));
    EXPECT_EQ(a.diagnostics.size(), 1u);
    for (const Diagnostic& d : a.diagnostics) EXPECT_EQ(to_string(d.location), "scene.pbrt:7:3");
    const auto& diffuse = std::get<DiffuseMaterial>(a.materials.at(0).model);
    return luminance(std::get<Spectrum>(diffuse.reflectance));
  };
  EXPECT_NEAR(reflectance(MeasuredMaterial{"table.pbsdf"}), .5, 1e-4);
}

TEST(Appearance, MelaninBecomesAbsorption) {
  HairMaterial hair;
  hair.eumelanin = 0.5f, hair.pheomelanin = 0.25f;
  const Appearance a = baked(hair);
  EXPECT_TRUE(a.diagnostics.empty());
  const auto& made = std::get<HairMaterial>(a.materials.at(0).model);
  EXPECT_FALSE(made.eumelanin || made.pheomelanin || made.color);
  EXPECT_EQ(made.sigma_a, SpectrumParameter{melanin_absorption(0.5, 0.25)});
  EXPECT_EQ(std::get<HairMaterial>(baked(HairMaterial{}).materials.at(0).model).sigma_a,
            SpectrumParameter{unbounded_from_rgb({0, 0, 0})});
}

TEST(Appearance, SubsurfaceMaterialsBringTheirMedium) {
  SubsurfaceMaterial jade;
  jade.interior = SubsurfaceMaterial::Coefficients{grey(.1f), grey(2)};
  jade.scale = 3;
  const Appearance a = baked(jade);
  EXPECT_TRUE(std::holds_alternative<DielectricMaterial>(a.materials.at(0).model));
  ASSERT_EQ(a.media.size(), 1u);
  EXPECT_EQ(a.material_interiors.at(0), 0);
  EXPECT_EQ(a.media[0].scale, 3);

  jade.interior = SubsurfaceMaterial::Effective{grey(.7f), grey(.25f)};
  const Medium effective = baked(jade).media.at(0);
  const auto& of_reflectance = std::get<ExtinctionAlbedo>(effective.coefficients);
  EXPECT_EQ(std::get<Spectrum>(of_reflectance.sigma_t), grey(4));
  EXPECT_FLOAT_EQ(effective.scale, 1.0f / 3);  // of the mean free path

  jade.interior = SubsurfaceMaterial::Named{"Marble"};
  jade.g = .5f;
  const Medium marble = baked(jade).media.at(0);
  EXPECT_EQ(marble.g, 0);  // its scattering is the reduced one
  const auto& measured = std::get<AbsorptionScattering>(marble.coefficients);
  EXPECT_EQ(std::get<Spectrum>(measured.sigma_s), unbounded_from_rgb({2.19, 2.62, 3.00}));
}

TEST(Appearance, TexturedInteriorsShowTheirReflectance) {
  SubsurfaceMaterial skin;
  skin.interior = SubsurfaceMaterial::Effective{Id<Texture>{0}, grey(1)};
  const Appearance a = baked({Material{skin}}, {{CheckerboardTexture{grey(.2f), grey(.6f)}}});
  EXPECT_TRUE(std::holds_alternative<DiffuseMaterial>(a.materials.at(0).model));
  EXPECT_TRUE(a.media.empty());
  EXPECT_EQ(a.diagnostics.size(), 1u);
}

TEST(Appearance, TexturedCoefficientsBecomeTheirMeans) {
  SubsurfaceMaterial skin;
  skin.interior = SubsurfaceMaterial::Coefficients{grey(.1f), Id<Texture>{1}};
  const Appearance a = baked({Material{skin}}, {{CheckerboardTexture{grey(.2f), grey(.6f)}},
                                                {ProductTexture{Id<Texture>{0}, grey(3)}}});
  EXPECT_TRUE(std::holds_alternative<DielectricMaterial>(a.materials.at(0).model));
  const auto& c = std::get<AbsorptionScattering>(a.media.at(0).coefficients);
  EXPECT_NEAR(evaluate(resolved(std::get<Spectrum>(c.sigma_s)), 550), 1.2, 1e-5);
  EXPECT_TRUE(std::ranges::any_of(a.diagnostics, [](const Diagnostic& d) {
    return d.message.find("rgb 1.2 1.2 1.2, from which it is 0.6 in") != std::string::npos;
  }));
}

TEST(Appearance, PartsOfMaterialsComeAlong) {
  const Material unused{InterfaceMaterial{}}, glass{DielectricMaterial{}}, chalk{DiffuseMaterial{}};
  const Appearance a = baked({unused, glass, unused, chalk, {BlendMaterial{{1}, {3}, .25f}}});
  ASSERT_EQ(a.materials.size(), 3u);
  EXPECT_EQ(a.materials[2].model, MaterialModel(BlendMaterial{{0}, {1}, .25f}));
  EXPECT_EQ(a.material_ids, (std::vector<std::int32_t>{-1, 0, -1, 1, 2}));
}

TEST(Appearance, DoublingChainsOfTexturesAndMaterialsTakeLinearTime) {
  std::vector<Texture> textures{{CheckerboardTexture{grey(.2f), grey(.6f)}}};
  std::vector<Material> materials{{DiffuseMaterial{}}};
  for (std::uint32_t i = 0; i < 100; ++i) {
    textures.push_back({MixTexture{Id<Texture>{i}, Id<Texture>{i}, .5f}});
    materials.push_back({BlendMaterial{{i}, {i}, .75f}});
  }
  materials.push_back({DiffuseMaterial{Id<Texture>{100}}});
  EXPECT_LE(baked(materials, textures).textures.size(), 101u);
  materials.pop_back();
  EXPECT_EQ(baked(materials, textures).materials.size(), 101u);
}

}  // namespace
}  // namespace vitrail::appearance_test
