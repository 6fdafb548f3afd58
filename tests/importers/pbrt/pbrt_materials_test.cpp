// SPDX-License-Identifier: Apache-2.0
// Materials of both versions in the Scene's terms.
#include "scene/spectra/color.h"
#include "scene/spectra/rgb_to_spectrum.h"
#include "tests/importers/pbrt/pbrt_text.h"

namespace vitrail::pbrt_materials_test {
namespace {

// The material of a triangle after `directives`.
Material material_of(const ImportedScene& imported) {
  return imported.scene.materials.at(imported.scene.shapes.at(0).material.value);
}
Material exact_v4(const std::string& directives) {
  const ImportedScene imported = import_v4(directives + " " + triangle);
  expect_no_diagnostics(imported);
  return material_of(imported);
}
Material exact_v3(const std::string& directives) {
  const ImportedScene imported = import_v3(directives + " " + triangle);
  expect_no_diagnostics(imported);
  return material_of(imported);
}
template <class Model>
Model model_of(const ImportedScene& imported) {
  return std::get<Model>(material_of(imported).model);
}
template <class Model>
Model exact(const std::string& directives, bool v3 = false) {
  return std::get<Model>((v3 ? exact_v3(directives) : exact_v4(directives)).model);
}

Material grey(float value) { return Material{DiffuseMaterial{ConstantSpectrum{value}}}; }
Spectrum number(float value) { return ConstantSpectrum{value}; }

// G = 1/(1 + Λ(ωo) + Λ(ωi)) of every rough material, in both versions; smooth ones have none.
TEST(PbrtMaterials, FacetsHideEachOtherByOneHeight) {
  const auto masking = [](const std::string& directives, bool v3) {
    return std::visit(
        [](const auto& m) {
          if constexpr (requires { m.roughness.masking; }) return m.roughness.masking;
          return Masking::separable;
        },
        (v3 ? exact_v3(directives) : exact_v4(directives)).model);
  };
  EXPECT_EQ(masking("Material \"conductor\" \"float roughness\" .3", false), Masking::correlated);
  EXPECT_EQ(masking("Material \"dielectric\" \"float uroughness\" .3", false), Masking::correlated);
  EXPECT_EQ(masking("Material \"coateddiffuse\" \"float roughness\" .3", false), Masking::correlated);
  EXPECT_EQ(masking("Material \"metal\" \"float roughness\" .3", true), Masking::correlated);
  EXPECT_EQ(masking("Material \"conductor\" \"float roughness\" 0", false), Masking::separable);
}

TEST(PbrtMaterials, DiffuseOnesAreExact) {
  EXPECT_EQ(exact_v4(""), grey(.5f));
  EXPECT_EQ(exact_v4("Material \"diffuse\""), grey(.5f));
  EXPECT_EQ(exact_v4("Material \"diffuse\" \"float reflectance\" .25"), grey(.25f));
  EXPECT_EQ(exact_v3("Material \"matte\" \"color Kd\" [.63 .065 .05] \"float sigma\" 20"),
            (Material{DiffuseMaterial{reflectance_from_rgb({.63, .065, .05}), 20.0f}}));
  const auto value = [](const DiffuseMaterial& m, double nm) {
    return evaluate(std::get<Spectrum>(m.reflectance), nm);
  };
  const auto sampled =
      exact<DiffuseMaterial>("Material \"diffuse\" \"spectrum reflectance\" [400 .2 700 .8]");
  EXPECT_NEAR(value(sampled, 550), .5, 1e-6);
  EXPECT_EQ(value(sampled, 380), 0) << "v4 is zero outside of inline samples";
  const auto held = exact<DiffuseMaterial>("Material \"matte\" \"spectrum Kd\" [400 .2 700 .8]", true);
  EXPECT_FLOAT_EQ(static_cast<float>(value(held, 380)), .2f) << "v3 holds the ends";
  EXPECT_EQ(exact_v4("Material \"diffuse\" \"spectrum reflectance\" [360 .75 830 .75]"), grey(.75f));
}

TEST(PbrtMaterials, DielectricsAreExact) {
  EXPECT_EQ(exact_v4("Material \"dielectric\""), Material{DielectricMaterial{}});
  for (const char* index : {"eta", "index"})
    EXPECT_EQ(
        exact_v3("Material \"glass\" \"float " + std::string(index) + "\" 1.25 \"rgb Kr\" [1 1 1]").model,
        exact_v4("Material \"dielectric\" \"float eta\" 1.25 ").model)
        << index;
  const auto flint = exact<DielectricMaterial>("Material \"dielectric\" \"spectrum eta\" \"glass-F11\"").eta;
  EXPECT_EQ(flint, Spectrum{NamedSpectrum{"glass-F11"}});
  EXPECT_NEAR(evaluate(flint, 587.56), 1.7847, 2e-4) << "Schott's SF11";
  const auto tinted = exact<DielectricMaterial>("Material \"glass\" \"rgb Kt\" [.5 1 1]", true);
  EXPECT_EQ(tinted.transmittance_factor, SpectrumParameter{reflectance_from_rgb({.5, 1, 1})});
  EXPECT_EQ(exact<ThinDielectricMaterial>("Material \"thindielectric\" \"float eta\" 1.25").eta,
            number(1.25f));
  EXPECT_TRUE(mentions(
      import_v4("Material \"dielectric\" \"spectrum eta\" [400 1.5 700 1.4] " + triangle).diagnostics,
      "held constant"));
}

TEST(PbrtMaterials, InterfacesAreExact) {
  for (const char* kind : {"interface", "none", ""})
    EXPECT_EQ(exact_v4("Material \"" + std::string(kind) + "\""), Material{InterfaceMaterial{}}) << kind;
}

TEST(PbrtMaterials, RoughnessBecomesAlpha) {
  const auto roughness = [](const std::string& parameters) {
    return exact<DielectricMaterial>("Material \"dielectric\" " + parameters).roughness;
  };
  const auto rough = [](float u, float v) {
    return Roughness{.alpha_u = u, .alpha_v = v, .masking = Masking::correlated};
  };
  EXPECT_EQ(roughness("\"float roughness\" .25"), rough(.5f, .5f)) << "v4: the square root";
  EXPECT_EQ(roughness("\"float roughness\" .25 \"bool remaproughness\" false"), rough(.25f, .25f));
  EXPECT_EQ(roughness("\"float uroughness\" .25 \"float vroughness\" .04"), rough(.5f, .2f));
  const auto v3 = exact<ConductorMaterial>("Material \"metal\" \"float roughness\" .1", true).roughness;
  // pbrt-v3's polynomial at ln 0.1.
  EXPECT_NEAR(std::get<float>(v3.alpha_u), .46176, 1e-5);
  const ImportedScene textured = import_v4(
      "Texture \"r\" \"float\" \"imagemap\" \"string filename\" \"r.png\" Material \"dielectric\" \"texture "
      "roughness\" \"r\" " +
      triangle);
  const Roughness& r = model_of<DielectricMaterial>(textured).roughness;
  EXPECT_EQ(r.alpha_u, FloatParameter{Id<Texture>{0}});
  EXPECT_TRUE(r.square_root);
}

TEST(PbrtMaterials, MetalsAreKeptByName) {
  const auto silver = exact<ConductorMaterial>(
      "Material \"conductor\" \"spectrum eta\" \"metal-Ag-eta\" \"spectrum k\" \"metal-Ag-k\"");
  EXPECT_EQ(silver.metal, (Metal{ComplexIndex{NamedSpectrum{"metal-Ag-eta"}, NamedSpectrum{"metal-Ag-k"}}}));
  EXPECT_EQ(exact<ConductorMaterial>("Material \"metal\"", true).metal, Metal{ComplexIndex{}}) << "copper";
  const auto brass = exact<ConductorMaterial>(
      "Material \"conductor\" \"spectrum eta\" \"metal-CuZn-eta\" \"spectrum k\" \"metal-CuZn-k\"");
  EXPECT_EQ(brass.metal,
            (Metal{ComplexIndex{NamedSpectrum{"metal-CuZn-eta"}, NamedSpectrum{"metal-CuZn-k"}}}));
  EXPECT_EQ(exact<ConductorMaterial>("Material \"conductor\" \"rgb reflectance\" [.4 .4 .4]").metal,
            Metal{NormalReflectance{reflectance_from_rgb({.4, .4, .4})}});
  const auto mirror = exact<ConductorMaterial>("Material \"mirror\" \"rgb Kr\" [.8 .8 .8]", true);
  EXPECT_EQ(mirror.metal, Metal{PerfectReflector{}});
  EXPECT_EQ(mirror.reflectance_factor, SpectrumParameter{reflectance_from_rgb({.8, .8, .8})});
  const auto coated = exact<CoatedConductorMaterial>(
      "Material \"coatedconductor\" \"float conductor.eta\" 1.5 \"float conductor.k\" 2 \"float "
      "interface.roughness\" "
      ".25 \"float thickness\" .5 \"integer nsamples\" 3");
  EXPECT_EQ(coated.metal, (Metal{ComplexIndex{number(1.5f), number(2)}}));
  EXPECT_EQ(coated.interface_roughness,
            (Roughness{.alpha_u = .5f, .alpha_v = .5f, .masking = Masking::correlated}));
  EXPECT_EQ(coated.volume.thickness, FloatParameter{.5f});
  EXPECT_EQ(coated.volume.samples, 3);
}

TEST(PbrtMaterials, OthersOfV4AreExact) {
  const auto coated =
      exact<CoatedDiffuseMaterial>("Material \"coateddiffuse\" \"rgb albedo\" [.3 .3 .3] \"float g\" .5");
  EXPECT_EQ(coated.volume.g, FloatParameter{.5f});
  EXPECT_EQ(coated.volume.albedo, SpectrumParameter{reflectance_from_rgb({.3, .3, .3})});
  EXPECT_EQ(exact<CoatedDiffuseMaterial>("Material \"coateddiffuse\"").volume, CoatingVolume{});
  const auto through =
      exact<DiffuseTransmissionMaterial>("Material \"diffusetransmission\" \"float scale\" 2");
  EXPECT_EQ(through, (DiffuseTransmissionMaterial{number(.25f), number(.25f), 2}));
  const auto milk =
      exact<SubsurfaceMaterial>("Material \"subsurface\" \"string name\" \"Skimmilk\" \"float scale\" 10");
  EXPECT_EQ(std::get<SubsurfaceMaterial::Named>(milk.interior).name, "Skimmilk");
  EXPECT_EQ(milk.scale, 10);
  const auto skin =
      exact<SubsurfaceMaterial>("Material \"subsurface\" \"rgb reflectance\" [.5 .4 .3] \"rgb mfp\" [1 2 3]");
  EXPECT_EQ(std::get<SubsurfaceMaterial::Effective>(skin.interior).mean_free_path,
            SpectrumParameter{unbounded_from_rgb({1, 2, 3})});
  const ImportedScene fur =
      import_v4("Material \"hair\" \"float eumelanin\" .5 \"float beta_m\" .25 " + triangle);
  EXPECT_EQ(fur.diagnostics.size(), 1u);  // on a triangle
  const auto hair = model_of<HairMaterial>(fur);
  EXPECT_FALSE(hair.along_v);
  EXPECT_EQ(hair.eumelanin, FloatParameter{.5f});
  EXPECT_EQ(hair.beta_m, FloatParameter{.25f});
  EXPECT_FALSE(hair.color || hair.sigma_a || hair.pheomelanin);
  HairMaterial brown;
  brown.eumelanin = 1.3f;
  EXPECT_EQ(model_of<HairMaterial>(import_v4("Material \"hair\" " + triangle)), brown);
  EXPECT_EQ(model_of<HairMaterial>(import_v4("Material \"hair\" \"float eta\" 1.25 " + triangle)).eta, 1.25f);
}

double value(const SpectrumParameter& parameter) { return luminance(std::get<Spectrum>(parameter)); }

template <class T>
T part(const ImportedScene& imported, Id<Material> id) {
  return std::get<T>(imported.scene.materials.at(id.value).model);
}

// v3 adds its lobes: a blend weighs them, and each is divided by its weight.
TEST(PbrtMaterials, OfV3AreSumsOfTheirLobes) {
  for (const auto& [kd, ks] : {std::pair{.5, .25}, {.9, .4}, {.1, .05}}) {
    const ImportedScene imported = import_v3(fmt::format(
        "Material \"plastic\" \"rgb Kd\" [{0} {0} {0}] \"rgb Ks\" [{1} {1} {1}] {2}", kd, ks, triangle));
    expect_no_diagnostics(imported);
    const auto blend = model_of<BlendMaterial>(imported);
    const auto amount = static_cast<double>(std::get<float>(blend.amount));
    const auto base = part<DiffuseMaterial>(imported, blend.first);
    const auto gloss = part<PlasticMaterial>(imported, blend.second);
    EXPECT_LE(value(base.reflectance), 1.0 + 1e-6);
    EXPECT_NEAR(value(base.reflectance) * (1 - amount), kd, 1e-4);
    EXPECT_NEAR(value(gloss.specular_reflectance) * amount, ks, 1e-4);
    EXPECT_EQ(value(gloss.diffuse_reflectance), 0);
    EXPECT_EQ(gloss.eta, 1.5f);
    EXPECT_EQ(gloss.exterior_eta, 1);
    if (kd + ks <= 1) {
      EXPECT_NEAR(value(gloss.specular_reflectance), 1, 1e-4) << "a coat as it is";
    }
  }
  const ImportedScene leaf = import_v3("Material \"translucent\" \"rgb reflect\" [1 1 1] " + triangle);
  const auto blend = model_of<BlendMaterial>(leaf);
  const auto amount = static_cast<double>(std::get<float>(blend.amount));
  const auto diffuse = part<DiffuseTransmissionMaterial>(leaf, blend.first);
  EXPECT_NEAR(value(diffuse.reflectance) * (1 - amount), .25, 1e-4);
  EXPECT_NEAR(value(diffuse.transmittance) * (1 - amount), .125, 1e-4);
  const auto glass = part<DielectricMaterial>(leaf, blend.second);
  EXPECT_NEAR(value(glass.reflectance_factor) * amount, .25, 1e-4);
  EXPECT_NEAR(value(glass.transmittance_factor) * amount, .125, 1e-4);
}

// R₀ = ((η − 1)/(η + 1))² is Ks.
TEST(PbrtMaterials, SubstrateHasItsReflectanceAtNormalIncidence) {
  const ImportedScene imported = import_v3("Material \"substrate\" \"rgb Ks\" [.25 .25 .25] " + triangle);
  EXPECT_NEAR(model_of<PlasticMaterial>(imported).eta, 3, 1e-5);
  EXPECT_TRUE(mentions(imported.diagnostics, "stands for it"));
}

TEST(PbrtMaterials, OfV3AreMappedWithoutDroppingParts) {
  const auto disney =
      exact<PrincipledMaterial>("Material \"disney\" \"float metallic\" .75 \"bool thin\" true", true);
  PrincipledMaterial expected;
  expected.metallic = .75f;
  expected.sheen_tint = .5f;
  expected.clearcoat_gloss = expected.diff_trans = 1.0f;
  expected.thin = true;
  EXPECT_EQ(disney, expected);
}

TEST(PbrtMaterials, UberKeepsOpacityMirrorAndTransmission) {
  const std::string kinds = "Material \"uber\" \"rgb Ks\" [0 0 0] ";
  const ImportedScene masked = import_v3(kinds + "\"rgb opacity\" [.25 .25 .25] " + triangle);
  expect_no_diagnostics(masked);
  const auto mask = model_of<MaskMaterial>(masked);
  EXPECT_EQ(mask.opacity, FloatParameter{.25f});
  EXPECT_LT(mask.material.value, masked.scene.shapes[0].material.value) << "materials refer to smaller ids";
  EXPECT_TRUE(std::holds_alternative<DiffuseMaterial>(masked.scene.materials.at(mask.material.value).model));

  const ImportedScene mirrored =
      import_v3(kinds + "\"rgb Kd\" [.25 .25 .25] \"rgb Kr\" [.75 .75 .75] " + triangle);
  expect_no_diagnostics(mirrored);
  const auto blend = model_of<BlendMaterial>(mirrored);
  const auto amount = static_cast<double>(std::get<float>(blend.amount));
  EXPECT_NEAR(value(part<DiffuseMaterial>(mirrored, blend.first).reflectance) * (1 - amount), .25, 1e-4);
  const auto mirror = part<PlasticMaterial>(mirrored, blend.second);
  EXPECT_NEAR(value(mirror.specular_reflectance) * amount, .75, 1e-4);
  EXPECT_EQ(mirror.roughness, Roughness{});

  const ImportedScene clear =
      import_v3(kinds + "\"rgb Kd\" [0 0 0] \"rgb Kt\" [1 1 1] \"float index\" 1.25 " + triangle);
  EXPECT_EQ(model_of<DielectricMaterial>(clear).eta, number(1.25f));
}

TEST(PbrtMaterials, MixesReferToTheirParts) {
  const std::string two =
      "MakeNamedMaterial \"a\" \"string type\" \"none\" MakeNamedMaterial \"b\" \"string type\" \"matte\" ";
  const auto parts = [](const ImportedScene& imported) {
    const auto blend = model_of<BlendMaterial>(imported);
    return std::pair(imported.scene.materials.at(blend.first.value).name,
                     imported.scene.materials.at(blend.second.value).name);
  };
  const ImportedScene v4 = import_v4(
      "Material \"mix\" \"string materials\" [\"a\" \"b\"] \"float amount\" .875 " + triangle + two);
  EXPECT_EQ(parts(v4), std::pair(std::string("a"), std::string("b")));
  EXPECT_EQ(model_of<BlendMaterial>(v4).amount, FloatParameter{.875f}) << "of the second";
  const ImportedScene v3 = import_v3(two +
                                     "Material \"mix\" \"string namedmaterial1\" \"a\" \"string "
                                     "namedmaterial2\" \"b\" \"rgb amount\" [.9 .9 .9] " +
                                     triangle);
  EXPECT_EQ(parts(v3), std::pair(std::string("b"), std::string("a"))) << "v3's amount weights the first";
}

TEST(PbrtMaterials, MixesThatContainThemselvesAreErrors) {
  EXPECT_THROW(import_v4("MakeNamedMaterial \"a\" \"string type\" \"mix\" \"string materials\" [\"a\" \"a\"] "
                         "NamedMaterial \"a\" " +
                         triangle),
               Error);
  std::string chain = "MakeNamedMaterial \"m0\" \"string type\" \"diffuse\" ";
  for (int i = 1; i < 1000; ++i)
    chain += "MakeNamedMaterial \"m" + std::to_string(i) +
             "\" \"string type\" \"mix\" \"string materials\" [\"m" + std::to_string(i - 1) + "\" \"m" +
             std::to_string(i - 1) + "\"]\n";
  EXPECT_NO_THROW(import_v4(chain + "NamedMaterial \"m999\" " + triangle))
      << "in order there is nothing to descend into";
}

FloatParameter opacity_of(const ImportedScene& imported) { return imported.scene.shapes.at(0).opacity; }

TEST(PbrtAlpha, IsTheOpacityOfTheShape) {
  const ImportedScene imported =
      import_v4("Material \"dielectric\" " + triangle + "\"float alpha\" .5 " + triangle);
  expect_no_diagnostics(imported);
  EXPECT_EQ(opacity_of(imported), FloatParameter{.5f});
  EXPECT_EQ(imported.scene.shapes[1].opacity, FloatParameter{1.0f});
  EXPECT_EQ(imported.scene.materials.size(), 1u);
  const std::string texture = "Texture \"leaf\" \"float\" \"checkerboard\" ";
  EXPECT_EQ(opacity_of(import_v4(texture + triangle + "\"texture alpha\" \"leaf\"")),
            FloatParameter{Id<Texture>{0}});
  EXPECT_EQ(opacity_of(import_v4(triangle + "\"float alpha\" 2")), FloatParameter{1.0f});
  EXPECT_TRUE(import_v4(triangle + "\"float alpha\" 0").scene.shapes.empty()) << "nothing shows";
}

TEST(PbrtAlpha, OfNothingLeavesTheLight) {
  const std::string light = "AreaLightSource \"diffuse\" ";
  const ImportedScene invisible = import_v4(light + triangle + "\"float alpha\" 0");
  expect_no_diagnostics(invisible);
  EXPECT_EQ(opacity_of(invisible), FloatParameter{0.0f});
  EXPECT_TRUE(invisible.scene.shapes[0].area_light);
  EXPECT_TRUE(mentions(import_v4(light + triangle + "\"float alpha\" .5").diagnostics, "its square"));
  const std::string in_object = "ObjectBegin \"o\" " + light + triangle + "\"float alpha\" 0 ObjectEnd";
  EXPECT_TRUE(import_v4(in_object).scene.prototypes.at(0).shapes.empty());
}

// To v3 a surface is there wherever its alpha is not 0, and shadowalpha lets shadow rays alone pass.
TEST(PbrtAlpha, OfVersion3) {
  EXPECT_EQ(opacity_of(import_v3(triangle + "\"float alpha\" .5")), FloatParameter{1.0f});
  const std::string leaf = "Texture \"leaf\" \"float\" \"checkerboard\" ",
                    by_leaf = "\"texture alpha\" \"leaf\" ";
  const ImportedScene twice = import_v3(leaf + triangle + by_leaf + triangle + by_leaf);
  ASSERT_EQ(twice.diagnostics.size(), 1u) << "once a texture";
  EXPECT_TRUE(mentions(twice.diagnostics, "is not 0"));
  const auto shadows = [&](const std::string& shadow) {
    return mentions(import_v3(leaf + triangle + by_leaf + shadow).diagnostics, "shadowalpha");
  };
  EXPECT_FALSE(shadows("\"texture shadowalpha\" \"leaf\""));
  EXPECT_FALSE(shadows("\"float shadowalpha\" 1"));
  EXPECT_TRUE(shadows("\"float shadowalpha\" 0"));
}

TEST(PbrtAlpha, IsNoEventAndAThinSheetIsOne) {
  for (const char* integrator : {"", "Integrator \"path\" ", "Integrator \"volpath\" "})
    EXPECT_TRUE(import_text(std::string(integrator) +
                            "WorldBegin MakeNamedMedium \"m\" \"string type\" "
                            "\"homogeneous\" " +
                            triangle)
                    .scene.settings.straight_counts)
        << integrator;
}

TEST(PbrtMedia, KeepTheirNamesScalesAndTemperatures) {
  for (const char* kind : {"homogeneous\" \"rgb Le\" [1 1 1]", "uniformgrid\" \"float density\" [1]"}) {
    const Medium medium =
        import_v4(
            "Translate 1 2 3 MakeNamedMedium \"fog\" \"float scale\" 3 \"float g\" .25 "
            "\"float temperaturescale\" 2 \"float temperatureoffset\" 100 \"string type\" \"" +
            std::string(kind))
            .scene.media.at(0);
    EXPECT_EQ(medium.name, "fog") << kind;
    EXPECT_EQ(medium.scale, 3) << kind;
    EXPECT_EQ(medium.g, 0.25f) << kind;
    EXPECT_EQ(medium.medium_to_world, translate({1, 2, 3})) << kind;
    const bool has_temperature = std::string(kind).starts_with("uniformgrid");
    EXPECT_EQ(medium.temperature_scale, has_temperature ? 2 : 1) << kind;
    EXPECT_EQ(medium.temperature_offset, has_temperature ? 100 : 0) << kind;
  }
}

TEST(PbrtMaterials, UnknownMeasuredMediaAreTheDefault) {
  for (const char* text :
       {"WorldBegin Material \"subsurface\" \"string name\" \"Skin3\" ",
        "WorldBegin MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"string preset\" "
        "\"Skin3\" "}) {
    const ImportedScene imported = import_text(std::string(text) + triangle);
    EXPECT_TRUE(mentions(imported.diagnostics, "did you mean \"Skin1\"")) << text;
    for (const Medium& medium : imported.scene.media)
      EXPECT_TRUE(std::holds_alternative<AbsorptionScattering>(medium.coefficients));
    for (const Material& material : imported.scene.materials) {
      const auto* m = std::get_if<SubsurfaceMaterial>(&material.model);
      EXPECT_TRUE(!m || std::holds_alternative<SubsurfaceMaterial::Coefficients>(m->interior));
    }
  }
}

// uber with opacity or a mirror is made of others, which have its bumps.
TEST(PbrtMaterials, BumpsAreOfTheParts) {
  const std::string bumps = "Texture \"d\" \"float\" \"fbm\" Material \"uber\" \"texture bumpmap\" \"d\" ";
  const ImportedScene imported =
      import_v3(bumps + "\"rgb opacity\" [.5 .5 .5] \"rgb Kr\" [.5 .5 .5] " + triangle);
  EXPECT_FALSE(material_of(imported).displacement);
  std::size_t bumped = 0;
  for (const Material& material : imported.scene.materials) {
    const bool is_leaf = !std::holds_alternative<MaskMaterial>(material.model) &&
                         !std::holds_alternative<BlendMaterial>(material.model);
    EXPECT_EQ(material.displacement.has_value(), is_leaf);
    bumped += is_leaf;
  }
  EXPECT_EQ(bumped, 3u);
}

TEST(PbrtMaterials, BumpsAreKept) {
  const ImportedScene imported = import_v4(
      "Texture \"d\" \"float\" \"fbm\" Material \"diffuse\" \"texture displacement\" \"d\" \"string "
      "normalmap\" "
      "\"n.png\" " +
      triangle);
  const Material material = material_of(imported);
  EXPECT_EQ(material.displacement, FloatParameter{Id<Texture>{0}});
  const auto& image =
      std::get<ImageTexture>(imported.scene.textures.at(material.normal_map.value().value).model);
  EXPECT_EQ(image.encoding, Encoding::linear);
}

TEST(PbrtMaterials, ColoursAreClampedToReflectances) {
  const ImportedScene imported = import_v4("Material \"diffuse\" \"rgb reflectance\" [2 .5 .5] " + triangle);
  EXPECT_TRUE(mentions(imported.diagnostics, "clamped"));
  EXPECT_EQ(material_of(imported), (Material{DiffuseMaterial{reflectance_from_rgb({1, .5, .5})}}));
}

TEST(PbrtMaterials, UnknownWordsAreReported) {
  const ImportedScene imported = import_v4(
      "Texture \"t\" \"float\" \"fbm\" Material \"diffuse\" \"rgb reflectanse\" [1 0 0] \"texture "
      "displacement\" \"t\" " +
      triangle);
  EXPECT_TRUE(mentions(imported.diagnostics, "did you mean \"reflectance\""));
  EXPECT_TRUE(mentions(import_v4("Material \"difuse\" " + triangle).diagnostics, "did you mean \"diffuse\""));
}

TEST(PbrtMaterials, DiagnosticsSayWhichDirectiveTheyAreAbout) {
  const ImportedScene imported = import_v3("Material \"plastic\"\n  \"rgb Kq\" [.5 .5 .5] " + triangle);
  ASSERT_FALSE(imported.diagnostics.empty());
  for (const Diagnostic& d : imported.diagnostics) EXPECT_EQ(d.item.line, 3) << d.message;
  EXPECT_EQ(location(imported.scene, material_of(imported).origin).line, 3);
}

}  // namespace
}  // namespace vitrail::pbrt_materials_test
