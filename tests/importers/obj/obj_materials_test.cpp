// SPDX-License-Identifier: Apache-2.0
// Materials of OBJ files by their libraries.

#include "scene/spectra/color.h"
#include "scene/spectra/rgb_to_spectrum.h"
#include "tests/importers/obj/obj_fixture.h"

namespace vitrail::obj_materials_test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

TEST_F(Obj, Diffuse) {
  EXPECT_EQ(material("  Kd .2 .4 .6\nKa 0 0 0\nKs 0 0 0\nNs 10\nillum 2\nd 1\nTf 1 1 1\nNi 1.5\nKe 0 0 0\n"),
            MaterialModel(DiffuseMaterial{reflectance_from_rgb({.2, .4, .6})}));
  EXPECT_THAT(imported_.diagnostics, IsEmpty());
  EXPECT_THAT(imported_.scene.area_lights, IsEmpty());
  EXPECT_EQ(material("Kd .3\n"), MaterialModel(DiffuseMaterial{reflectance_from_rgb({.3, .3, .3})}));
  EXPECT_EQ(material(""), MaterialModel(DiffuseMaterial{reflectance_from_rgb({0, 0, 0})}));
  material("Kd 1.5 0 0\n");
  EXPECT_THAT(imported_.diagnostics, says("clamped"));
  material("Kd 1 1 1\nKs 1 1 1\nillum 1\n");
  EXPECT_TRUE(std::holds_alternative<DiffuseMaterial>(imported_.scene.materials[0].model));
  EXPECT_EQ(whole_material("Kd 1 1 1\n").name, "m");
}

TEST_F(Obj, MaterialsAndLightsKnowTheirPlaces) {
  const Material m = whole_material("Kd 1 1 1\nKe 1 1 1\nKs 1 1 1\n");
  const SourceLocation where = location(imported_.scene, m.origin);
  EXPECT_THAT(where.file, HasSubstr("m.mtl"));
  EXPECT_EQ(where.line, 1);
  EXPECT_THAT(location(imported_.scene, imported_.scene.area_lights.at(0).origin).file, HasSubstr("m.mtl"));
  const SourceLocation shape = location(imported_.scene, imported_.scene.shapes.at(0).origin);
  EXPECT_THAT(shape.file, HasSubstr("scene.obj"));
  EXPECT_EQ(shape.line, 6);
  ASSERT_THAT(imported_.diagnostics, SizeIs(1));
  EXPECT_EQ(to_string(imported_.diagnostics[0].item), to_string(where));
}

TEST_F(Obj, Dielectric) {
  const MaterialModel glass = DielectricMaterial{ConstantSpectrum{1.5f}};
  for (const std::string text :
       {"d 0.1\nNi 1.5\n", "Tr 0.9\nNi 1.5\n", "illum 4\nNi 1.5\n", "illum 6\nNi 1.5\nKs 1 1 1\nNs 100\n",
        "illum 7\nNi 1.5\n", "illum 9\nNi 1.5\n"}) {
    EXPECT_EQ(material(text), glass) << text;
    const bool has_d = text.starts_with("d ") || text.starts_with("Tr ");
    EXPECT_THAT(imported_.diagnostics, SizeIs(has_d ? 1 : 0)) << text;  // d says nothing of glass
  }
  const auto tinted = std::get<DielectricMaterial>(material("d 0\nNi 1.33\nTf .5 1 .5\n"));
  EXPECT_EQ(tinted.transmittance_factor, SpectrumParameter(Spectrum(unbounded_from_rgb({.5, 1, .5}))));
  EXPECT_EQ(material("d 0\n"), MaterialModel(InterfaceMaterial{}));
  EXPECT_EQ(material("Tr 1\nNi 1.5\n"), glass);
  material("illum 4\nNi 1\nKd 1 1 1\n");  // Maya's Lambert
  EXPECT_TRUE(std::holds_alternative<DiffuseMaterial>(imported_.scene.materials[0].model));
  EXPECT_THAT(imported_.diagnostics, says("illum 4"));
}

TEST_F(Obj, Masks) {
  const auto mask = std::get<MaskMaterial>(material("d 0.75\nTr 0.5\nKd 1 1 1\n"));
  EXPECT_EQ(mask.opacity, FloatParameter(.75f));
  EXPECT_EQ(imported_.scene.materials.at(mask.material.value).model,
            MaterialModel(DiffuseMaterial{reflectance_from_rgb({1, 1, 1})}));
  EXPECT_THAT(imported_.diagnostics, says("Tr: its d says otherwise"));
  // What MeshLab writes of an opaque material.
  EXPECT_TRUE(std::holds_alternative<DiffuseMaterial>(material("Kd 1 1 1\nTr 1.000000\nillum 2\nNs 0\n")));
  EXPECT_THAT(imported_.diagnostics, says("Tr 1 without d"));
  EXPECT_EQ(std::get<MaskMaterial>(material("Kd 1 1 1\nTr .75\n")).opacity, FloatParameter(.25f));
  folder_.write("leaf.png", "");
  const auto leaf = std::get<MaskMaterial>(material("Kd 1 1 1\nd 1\nNi 1.45\nmap_d leaf.png\n"));
  EXPECT_EQ(image(leaf.opacity).encoding, Encoding::linear);
  EXPECT_TRUE(imported_.scene.textures[0].is_float);
  EXPECT_THAT(imported_.diagnostics, IsEmpty());
}

TEST_F(Obj, Plastic) {
  const auto plastic = std::get<PlasticMaterial>(material("Kd .5 .5 .5\nKs .5 .5 .5\nNs 198\nNi 1.45\n"));
  EXPECT_EQ(plastic.diffuse_reflectance, SpectrumParameter(Spectrum(reflectance_from_rgb({.5, .5, .5}))));
  EXPECT_EQ(plastic.specular_reflectance, SpectrumParameter(Spectrum(reflectance_from_rgb({.5, .5, .5}))));
  EXPECT_EQ(plastic.eta, 1.45f);
  EXPECT_EQ(plastic.exterior_eta, 1);
  EXPECT_EQ(plastic.roughness.alpha_u, FloatParameter(.1f));
  EXPECT_EQ(plastic.roughness.alpha_v, FloatParameter(.1f));
  EXPECT_THAT(imported_.diagnostics, says("Ks and Ns"));
  EXPECT_EQ(std::get<PlasticMaterial>(material("Kd .5\nKs .5\nNi 1\n")).eta, 1.5f);
}

TEST_F(Obj, Conductor) {
  const auto metal = std::get<ConductorMaterial>(material("Kd 0 0 0\nKs .9 .8 .1\nNs 198\nillum 3\n"));
  EXPECT_EQ(std::get<NormalReflectance>(metal.metal).reflectance,
            SpectrumParameter(Spectrum(reflectance_from_rgb({.9, .8, .1}))));
  EXPECT_EQ(metal.roughness.alpha_u, FloatParameter(.1f));
  EXPECT_TRUE(std::holds_alternative<ConductorMaterial>(material("Kd .1 .1 .1\nKs .9 .9 .9\nillum 3\n")));
  EXPECT_TRUE(std::holds_alternative<PlasticMaterial>(material("Kd .1 .1 .1\nKs .9 .9 .9\nillum 2\n")));
  EXPECT_TRUE(std::holds_alternative<PlasticMaterial>(material("Kd 1 0 0\nKs .9 .8 .1\nillum 3\n")));
}

TEST_F(Obj, Principled) {
  folder_.write("m.png", "");
  const auto m =
      std::get<PrincipledMaterial>(material("Kd .2 .4 .6\nKs 1 1 1\nPr .25\nPm .5\nPs .125\nPc 1\nPcr "
                                            ".25\naniso .75\nanisor 0\nNi 1.6\nmap_Pm m.png\n"));
  EXPECT_EQ(m.base_color, SpectrumParameter(Spectrum(reflectance_from_rgb({.2, .4, .6}))));
  EXPECT_EQ(m.roughness, FloatParameter(.25f));
  EXPECT_EQ(image(m.metallic).encoding, Encoding::linear);
  EXPECT_EQ(m.sheen, FloatParameter(.125f));
  EXPECT_EQ(m.clearcoat, FloatParameter(1.0f));
  EXPECT_EQ(m.clearcoat_gloss, FloatParameter(.75f));
  EXPECT_EQ(m.anisotropic, FloatParameter(.75f));
  EXPECT_EQ(m.eta, 1.6f);
  EXPECT_THAT(imported_.diagnostics, IsEmpty());
}

// Blender 5.0 writes Tf for a principled material that transmits, with illum 2 and d 1.
TEST_F(Obj, TransmissionOfBlender) {
  const std::string blender =
      "Kd .8 .8 .8\nKs .5 .5 .5\nNi 1.5\nd 1\nillum 2\nPr 0\nPm 0\nPs 0\nPc 0\nPcr .03\naniso 0\nanisor 0\n";
  EXPECT_EQ(std::get<PrincipledMaterial>(material(blender)).spec_trans, FloatParameter(0.0f));
  EXPECT_EQ(std::get<PrincipledMaterial>(material(blender + "Tf .75 .75 .75\n")).spec_trans,
            FloatParameter(.75f));
  EXPECT_THAT(imported_.diagnostics, IsEmpty());
  // Of another program white says nothing, and a colour is lost.
  EXPECT_EQ(std::get<PrincipledMaterial>(material("Pr .2\nTf 1 1 1\n")).spec_trans, FloatParameter(0.0f));
  EXPECT_THAT(imported_.diagnostics, IsEmpty());
  material("Pr .2\nNi 1.5\nTf .5 1 1\n");
  EXPECT_THAT(imported_.diagnostics, SizeIs(1));
}

TEST_F(Obj, ImagesAndTheirOptions) {
  folder_.write("a b.png", "");
  const auto reflectance = [&](const std::string& mtl) {
    return std::get<DiffuseMaterial>(material(mtl)).reflectance;
  };
  EXPECT_EQ(image(reflectance("map_Kd a b.png\n")), (ImageTexture{(folder_ / "a b.png").string()}));
  EXPECT_EQ(image(reflectance("map_Kd \"a b.png\"\n")), (ImageTexture{(folder_ / "a b.png").string()}));
  EXPECT_EQ(image(reflectance("Kd 0 0 0\nmap_Kd a b.png\n")).scale, 1);
  EXPECT_EQ(image(reflectance("Kd .25 .25 .25\nmap_Kd a b.png\n")).scale, .25f);
  const ImageTexture placed =
      image(reflectance("map_Kd -blendu off -s 2 3 1 -o .5 .25 -clamp on -mm 0 .5 -texres 256 a b.png\n"));
  EXPECT_EQ(placed.mapping, TextureMapping(UvMapping{2, 0, .5f, 0, 3, .25f}));
  EXPECT_EQ(placed.wrap, Wrap::clamp);
  EXPECT_EQ(placed.scale, .5f);
  EXPECT_THAT(imported_.diagnostics, IsEmpty());
  EXPECT_EQ(std::get<UvMapping>(image(reflectance("map_Kd -s 2 a b.png\n")).mapping), (UvMapping{2}));
  const SpectrumParameter product = reflectance("Kd .2 .4 .6\nmap_Kd .\\a b.png\n");
  const Texture& texture = imported_.scene.textures.at(std::get<Id<Texture>>(product).value);
  EXPECT_EQ(std::get<ProductTexture>(texture.model).first,
            SpectrumParameter(Spectrum(unbounded_from_rgb({.2, .4, .6}))));
  EXPECT_EQ(image(std::get<ProductTexture>(texture.model).second).scale, 1);
  material("Kd 1\nmap_Kd -t 1 1 1 -mm .5 1 -imfchan r a b.png\n");
  for (const std::string text : {"-t of map_Kd", "-mm of map_Kd", "-imfchan r of map_Kd"})
    EXPECT_THAT(imported_.diagnostics, says(text));
}

TEST_F(Obj, WhichNumberAnImageIs) {
  folder_.write("m.png", "");
  const auto number = [&](const std::string& mtl) {
    material(mtl);
    return std::get<ImageTexture>(imported_.scene.textures.back().model).number;
  };
  EXPECT_EQ(number("Kd 1 1 1\nmap_Pm m.png\n"), ImageNumber::luminance);
  EXPECT_EQ(number("Kd 1 1 1\nmap_d m.png\n"), ImageNumber::alpha_or_luminance);
  EXPECT_EQ(number("Kd 1 1 1\nmap_d -imfchan l m.png\n"), ImageNumber::luminance);
  EXPECT_EQ(number("Kd 1 1 1\nmap_Bump -imfchan m m.png\n"), ImageNumber::alpha);
  EXPECT_EQ(number("Kd 1 1 1\nmap_Pr -imfchan g m.png\n"), ImageNumber::green);
  material("Kd 1 1 1\nmap_Pr -imfchan z m.png\n");
  EXPECT_THAT(imported_.diagnostics, says("-imfchan z of map_Pr"));
}

TEST_F(Obj, ImagesThatAreNotThereAreKeptByName) {
  EXPECT_EQ(image(std::get<DiffuseMaterial>(material("map_Kd -s 1 1 1 a b.png\n")).reflectance).filename,
            (folder_ / "a b.png").string());
  EXPECT_THAT(imported_.diagnostics, IsEmpty()) << "require_images speaks of them";
  EXPECT_THROW(material("map_Kd\n"), Error);
  EXPECT_THROW(material("map_Kd -s x a.png\n"), Error);
}

TEST_F(Obj, BumpsAndNormalMaps) {
  folder_.write("n.png", "");
  Material m = whole_material("Kd 1 1 1\nmap_Bump -bm .5 n.png\nnorm n.png\n");
  EXPECT_EQ(image(*m.displacement).scale, .5f);
  EXPECT_EQ(image(*m.displacement).encoding, Encoding::linear);
  ASSERT_TRUE(m.normal_map);
  EXPECT_FALSE(imported_.scene.textures.at(m.normal_map->value).is_float);
  EXPECT_THAT(imported_.diagnostics, says("heights"));
  m = whole_material("Kd 1 1 1\nmap_d n.png\nbump n.png\n");
  EXPECT_FALSE(m.displacement);  // the surface inside the mask has it
  EXPECT_TRUE(imported_.scene.materials.at(std::get<MaskMaterial>(m.model).material.value).displacement);
}

TEST_F(Obj, Emission) {
  material("Kd 1 1 1\nKe 2 3 4\n");
  ASSERT_THAT(imported_.scene.area_lights, SizeIs(1));
  AreaLight expected;
  expected.radiance = Spectrum{emission_from_rgb({2, 3, 4})};
  expected.two_sided = true;
  expected.name = "m";  // the material
  EXPECT_EQ(imported_.scene.area_lights[0], expected);
  EXPECT_EQ(imported_.scene.shapes[0].area_light, Id<AreaLight>{0});
  folder_.write("e.hdr", "");
  material("Kd 1 1 1\nKe 2 2 2\nmap_Ke e.hdr\n");
  EXPECT_EQ(image(imported_.scene.area_lights.at(0).radiance).scale, 2);
}

TEST_F(Obj, WhatMaterialsLoseIsSaidWithEachPlace) {
  material(
      "Kd 1 1 1\nKa 1 1 1\nKa 1 1 1\nrefl a.png\nKt 1 1 1\nKd spectral a.rfl\nnewmtl other\nKa .5 .5 .5\n");
  EXPECT_THAT(imported_.diagnostics, SizeIs(6));
  for (const std::string text : {"Ka", "refl", "Kt", "Kd spectral"})
    EXPECT_THAT(imported_.diagnostics, says(text));
  EXPECT_THAT(imported_.diagnostics[0].location.file, HasSubstr("m.mtl"));
  EXPECT_EQ(imported_.diagnostics[0].location.line, 3);
  EXPECT_EQ(imported_.diagnostics[0].item.line, 1);
  EXPECT_EQ(imported_.diagnostics[1].location.line, 4);
  EXPECT_EQ(imported_.diagnostics[5].location.line, 9);
  EXPECT_EQ(imported_.diagnostics[5].item.line, 8);
  EXPECT_EQ(imported_.diagnostics[5].message, imported_.diagnostics[0].message) << "so they are counted";
}

TEST_F(Obj, BadMaterials) {
  EXPECT_THROW(material("Kd 1 x 1\n"), Error);
  EXPECT_THROW(material("Kd nan 1 1\n"), Error);
  EXPECT_THROW(material("Ni\n"), Error);
  folder_.write("m.mtl", "Kd 1 1 1\n");
  const Error error = error_of("mtllib m.mtl\n");
  EXPECT_THAT(error.location.file, HasSubstr("m.mtl"));
  EXPECT_EQ(error.location.line, 1);
}

TEST_F(Obj, LibrariesAndTheirNames) {
  const std::string faces = "usemtl my red\nf 1 2 3\n";
  const MaterialModel red = DiffuseMaterial{reflectance_from_rgb({1, 0, 0})};
  folder_.write("a b.mtl", "newmtl  my red \nKd 1 0 0\nnewmtl my red\nKd 0 1 0\n");
  folder_.write("c.mtl", "newmtl c\n");
  for (const std::string line : {"mtllib a b.mtl", "mtllib a\\ b.mtl", "mtllib c.mtl a\\ b.mtl",
                                 "mtllib c.mtl\nmtllib a b.mtl\nmtllib c.mtl"}) {
    const ImportedScene imported = read(line + "\n" + square + faces);
    ASSERT_THAT(imported.scene.materials, SizeIs(1)) << line;  // those that are used
    EXPECT_EQ(imported.scene.materials[0].model, red) << line;
    EXPECT_THAT(imported.diagnostics, SizeIs(1));
    EXPECT_THAT(imported.diagnostics, says("second definition"));
  }
  const ImportedScene after = read(square + faces + "mtllib a b.mtl\r\n");
  EXPECT_EQ(after.scene.materials.at(0).model, red);
  const ImportedScene missing = read("mtllib none.mtl\n" + square + faces);
  EXPECT_EQ(missing.scene.materials.at(0).model, MaterialModel(DiffuseMaterial{}));
  EXPECT_THAT(missing.diagnostics, says("'none.mtl'"));
}

}  // namespace
}  // namespace vitrail::obj_materials_test
