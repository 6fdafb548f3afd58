// SPDX-License-Identifier: Apache-2.0
// Materials of both versions, exact and approximated, and the textures that stand behind them.
#include "pbrt_text.h"
#include "scene/color.h"
#include "scene/named_spectra.h"
#include "scene/rgb_to_spectrum.h"

namespace vitrail {
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
// Mean reflectance of what becomes diffuse with a diagnostic.
double approximated(const std::string& directives, bool v3 = false) {
  const ImportedScene imported =
      v3 ? import_v3(directives + " " + triangle) : import_v4(directives + " " + triangle);
  EXPECT_FALSE(imported.diagnostics.empty()) << directives;
  for (const Diagnostic& d : imported.diagnostics) EXPECT_EQ(d.location.line, 3) << d.message;
  return luminance(std::get<DiffuseMaterial>(material_of(imported)).reflectance);
}

Material grey(float value) { return DiffuseMaterial{ConstantSpectrum{value}}; }

TEST(PbrtMaterials, DiffuseOnesAreExact) {
  EXPECT_EQ(exact_v4(""), grey(.5f));
  EXPECT_EQ(exact_v4("Material \"diffuse\""), grey(.5f));
  EXPECT_EQ(exact_v4("Material \"diffuse\" \"float reflectance\" .25"), grey(.25f));
  EXPECT_EQ(exact_v3("Material \"matte\" \"color Kd\" [.63 .065 .05] \"float sigma\" 0"),
            Material{DiffuseMaterial{reflectance_from_rgb({.63, .065, .05})}});
  const Spectrum sampled =
      std::get<DiffuseMaterial>(exact_v4("Material \"diffuse\" \"spectrum reflectance\" [400 .2 700 .8]"))
          .reflectance;
  EXPECT_NEAR(evaluate(sampled, 550), .5, 1e-6);
  EXPECT_EQ(evaluate(sampled, 380), 0) << "v4 is zero outside of inline samples";
  const Spectrum held =
      std::get<DiffuseMaterial>(exact_v3("Material \"matte\" \"spectrum Kd\" [400 .2 700 .8]")).reflectance;
  EXPECT_FLOAT_EQ(static_cast<float>(evaluate(held, 380)), .2f) << "v3 holds the ends";
  EXPECT_EQ(exact_v4("Material \"diffuse\" \"spectrum reflectance\" [360 .75 830 .75]"), grey(.75f));
}

TEST(PbrtMaterials, DielectricsAreExact) {
  EXPECT_EQ(exact_v4("Material \"dielectric\""), Material{DielectricMaterial{}});
  EXPECT_EQ(exact_v4("Material \"dielectric\" \"float eta\" 1.25"),
            Material{DielectricMaterial{ConstantSpectrum{1.25f}}});
  EXPECT_EQ(exact_v3("Material \"glass\" \"float index\" 1.25 \"rgb Kr\" [1 1 1]"),
            Material{DielectricMaterial{ConstantSpectrum{1.25f}}});
  EXPECT_EQ(exact_v3("Material \"glass\" \"float eta\" 1.25"),
            Material{DielectricMaterial{ConstantSpectrum{1.25f}}});
  EXPECT_EQ(exact_v4("Material \"dielectric\" \"spectrum eta\" \"glass-BK7\""),
            Material{DielectricMaterial{bk7()}});
  const auto flint =
      std::get<DielectricMaterial>(exact_v4("Material \"dielectric\" \"spectrum eta\" \"glass-F11\"")).eta;
  EXPECT_NEAR(evaluate(flint, 587.56), 1.7847, 2e-4) << "Schott's SF11";
}

TEST(PbrtMaterials, InterfacesAreExact) {
  for (const char* kind : {"interface", "none", ""})
    EXPECT_EQ(exact_v4("Material \"" + std::string(kind) + "\""), Material{InterfaceMaterial{}}) << kind;
}

TEST(PbrtMaterials, RoughOrTintedGlassIsReported) {
  for (const char* parameter : {"\"float roughness\" .1", "\"float uroughness\" .1", "\"rgb Kt\" [.5 1 1]"}) {
    const ImportedScene imported =
        import_v4("Material \"dielectric\" " + std::string(parameter) + " " + triangle);
    EXPECT_EQ(material_of(imported), Material{DielectricMaterial{}});
    EXPECT_EQ(imported.diagnostics.size(), 1u) << parameter;
  }
  EXPECT_TRUE(mentions(
      import_v4("Material \"dielectric\" \"spectrum eta\" [400 1.5 700 1.4] " + triangle).diagnostics,
      "held constant"));
}

TEST(PbrtMaterials, OthersBecomeTheNearest) {
  EXPECT_NEAR(approximated("Material \"matte\" \"rgb Kd\" [.3 .3 .3] \"float sigma\" 20"), .3, 1e-4);
  EXPECT_NEAR(approximated("Material \"coateddiffuse\" \"rgb reflectance\" [.3 .3 .3]"), .3, 1e-4);
  EXPECT_NEAR(approximated("Material \"plastic\"", true), .25, 1e-4);
  EXPECT_NEAR(approximated("Material \"substrate\"", true), .5, 1e-4);
  EXPECT_NEAR(approximated("Material \"uber\" \"rgb Kd\" [.6 .6 .6] \"rgb Ks\" [1 1 1]", true), .6, 1e-4);
  EXPECT_NEAR(approximated("Material \"mirror\" \"rgb Kr\" [.8 .8 .8]", true), .8, 1e-4);
  EXPECT_NEAR(approximated("Material \"diffusetransmission\""), .25, 1e-4);
  EXPECT_NEAR(approximated("Material \"disney\" \"rgb color\" [.7 .7 .7] \"float metallic\" 1", true), .7,
              1e-4);
  EXPECT_NEAR(approximated("Material \"subsurface\" \"string name\" \"Skimmilk\""), .5, 1e-4);
  EXPECT_NEAR(approximated("Material \"difuse\""), .5, 1e-4);
}

TEST(PbrtMaterials, MetalsReflectWhatTheyDoAtNormalIncidence) {
  EXPECT_NEAR(
      approximated("Material \"conductor\" \"spectrum eta\" \"metal-Ag-eta\" \"spectrum k\" \"metal-Ag-k\""),
      .96, .02);
  EXPECT_NEAR(approximated("Material \"metal\"", true), .68, .05) << "copper";
  EXPECT_NEAR(approximated("Material \"conductor\" \"rgb reflectance\" [.4 .4 .4]"), .4, 1e-4);
  // ((1.5 − 1)² + 2²) / ((1.5 + 1)² + 2²)
  EXPECT_NEAR(approximated("Material \"conductor\" \"float eta\" 1.5 \"float k\" 2"), 4.25 / 10.25, 1e-4);
  EXPECT_NEAR(
      approximated("Material \"coatedconductor\" \"float conductor.eta\" 1.5 \"float conductor.k\" 2"),
      4.25 / 10.25, 1e-4);
}

TEST(PbrtMaterials, TransparentOnesLetLightThrough) {
  EXPECT_EQ(material_of(import_v4("Material \"thindielectric\" " + triangle)), Material{InterfaceMaterial{}});
  EXPECT_EQ(material_of(import_v3("Material \"uber\" \"rgb opacity\" [.1 .1 .1] " + triangle)),
            Material{InterfaceMaterial{}});
  EXPECT_EQ(material_of(import_v3(
                "Material \"uber\" \"rgb Kd\" [0 0 0] \"rgb Kt\" [1 1 1] \"float index\" 1.25 " + triangle)),
            Material{DielectricMaterial{ConstantSpectrum{1.25f}}});
}

TEST(PbrtMaterials, OfAMixTheHeavierStands) {
  const std::string two =
      "MakeNamedMaterial \"a\" \"string type\" \"none\" MakeNamedMaterial \"b\" \"string type\" \"matte\" ";
  const std::string v4 = "Material \"mix\" \"string materials\" [\"a\" \"b\"] \"float amount\" ";
  const std::string v3 =
      "Material \"mix\" \"string namedmaterial1\" \"a\" \"string namedmaterial2\" \"b\" \"rgb amount\" ";
  EXPECT_EQ(material_of(import_v4(two + v4 + ".9 " + triangle)), grey(.5f)) << "v4 weights the second";
  EXPECT_EQ(material_of(import_v4(two + v4 + ".1 " + triangle)), Material{InterfaceMaterial{}});
  EXPECT_EQ(material_of(import_v3(two + v3 + "[.9 .9 .9] " + triangle)), Material{InterfaceMaterial{}})
      << "v3 weights the first";
}

TEST(PbrtMaterials, ColoursAreClampedToReflectances) {
  const ImportedScene imported = import_v4("Material \"diffuse\" \"rgb reflectance\" [2 .5 .5] " + triangle);
  EXPECT_TRUE(mentions(imported.diagnostics, "clamped"));
  EXPECT_EQ(material_of(imported), Material{DiffuseMaterial{reflectance_from_rgb({1, .5, .5})}});
}

TEST(PbrtMaterials, UnusedParametersAreReported) {
  const ImportedScene imported = import_v4(
      "Material \"diffuse\" \"rgb reflectanse\" [1 0 0] \"texture displacement\" \"t\" " + triangle);
  EXPECT_TRUE(mentions(imported.diagnostics, "did you mean \"reflectance\""));
}

// ---- Textures
// -------------------------------------------------------------------------------------------------------

double textured(const std::string& textures, bool is_exact) {
  const ImportedScene imported =
      import_v4(textures + " Material \"diffuse\" \"texture reflectance\" \"t\" " + triangle);
  EXPECT_EQ(imported.diagnostics.empty(), is_exact) << textures;
  return luminance(std::get<DiffuseMaterial>(material_of(imported)).reflectance);
}

TEST(PbrtTextures, OfConstantsAreExact) {
  EXPECT_NEAR(textured("Texture \"t\" \"spectrum\" \"constant\" \"rgb value\" [.3 .3 .3]", true), .3, 1e-4);
  EXPECT_NEAR(textured("Texture \"c\" \"spectrum\" \"constant\" \"rgb value\" [.8 .8 .8] "
                       "Texture \"t\" \"spectrum\" \"scale\" \"texture tex\" \"c\" \"float scale\" .5",
                       true),
              .4, 1e-4);
  EXPECT_NEAR(
      textured("Texture \"t\" \"color\" \"scale\" \"rgb tex1\" [.5 .5 .5] \"rgb tex2\" [.5 .5 .5]", true),
      .25, 1e-4);
  EXPECT_NEAR(textured("Texture \"t\" \"spectrum\" \"mix\" \"rgb tex1\" [.2 .2 .2] \"rgb tex2\" [.6 .6 .6] "
                       "\"float amount\" .25",
                       true),
              .3, 1e-4);
  EXPECT_NEAR(
      textured("Texture \"t\" \"spectrum\" \"checkerboard\" \"rgb tex1\" [.2 .2 .2] \"rgb tex2\" [.2 .2 .2]",
               true),
      .2, 1e-4);
}

TEST(PbrtTextures, OthersAreRepresentedByTheirMean) {
  EXPECT_NEAR(
      textured("Texture \"t\" \"spectrum\" \"checkerboard\" \"rgb tex1\" [.2 .2 .2] \"rgb tex2\" [.6 .6 .6]",
               false),
      .4, 1e-4);
  EXPECT_NEAR(textured("Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"x.png\"", false), .5,
              1e-4);
  EXPECT_NEAR(
      textured("Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"x.png\" \"float scale\" .5",
               false),
      .25, 1e-4);
  EXPECT_NEAR(textured("Texture \"i\" \"spectrum\" \"imagemap\" \"string filename\" \"x.png\" "
                       "Texture \"t\" \"spectrum\" \"scale\" \"texture tex\" \"i\" \"float scale\" .5",
                       false),
              .25, 1e-4);
  EXPECT_NEAR(textured("Texture \"t\" \"spectrum\" \"bilerp\"", false), .5, 1e-4);
  EXPECT_NEAR(
      textured("Texture \"t\" \"spectrum\" \"dots\" \"rgb inside\" [0 0 0] \"rgb outside\" [1 1 1]", false),
      .81, .01);
}

TEST(PbrtTextures, MayFollowTheMaterialsThatUseThem) {
  const ImportedScene imported = import_v4("Material \"diffuse\" \"texture reflectance\" \"t\" " + triangle +
                                           "Texture \"t\" \"spectrum\" \"constant\" \"float value\" .125");
  EXPECT_EQ(material_of(imported), grey(.125f));
}

TEST(PbrtTextures, OfNumbersAndOfSpectraHaveNamesOfTheirOwn) {
  const ImportedScene imported = import_v4(
      "Texture \"t\" \"float\" \"constant\" \"float value\" 0 Texture \"t\" \"spectrum\" \"constant\" "
      "\"float value\" .125 "
      "Material \"dielectric\" \"texture roughness\" \"t\" " +
      triangle + "Material \"diffuse\" \"texture reflectance\" \"t\" " + triangle);
  expect_no_diagnostics(imported);
  EXPECT_EQ(imported.scene.materials.at(imported.scene.shapes.at(1).material.value), grey(.125f));
}

}  // namespace
}  // namespace vitrail
