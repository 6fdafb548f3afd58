// SPDX-License-Identifier: Apache-2.0
// The text that the Mitsuba writer makes of materials and textures. What Mitsuba makes of it:
// mitsuba_oracle.h.
#include "importers/mitsuba/write/write_mitsuba.h"

#include <gmock/gmock.h>

#include <pugixml.hpp>

#include "importers/mitsuba/read/mitsuba.h"
#include "tests/importers/mitsuba/write_mitsuba_fixture.h"
#include "tests/importers/temporary_folder.h"
#include "tests/importers/written_scenes.h"

namespace vitrail::write_mitsuba_materials_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

// ---- Materials

TEST_F(WriteMitsuba, TwoSidedIsAWrapper) {
  EXPECT_STREQ(write_material(DiffuseMaterial{}, true).attribute("type").value(), "twosided");
  EXPECT_STREQ(write_material(DiffuseMaterial{}, false).attribute("type").value(), "diffuse");
  EXPECT_STREQ(write_material(DielectricMaterial{}, true).attribute("type").value(), "dielectric");
  EXPECT_STREQ(document_.child("scene").child("bsdf").attribute("id").value(), "_unnamed_material_0");
}

TEST_F(WriteMitsuba, AdaptersNest) {
  Scene scene = square_scene({});
  scene.textures = {{ImageTexture{"/n.exr"}, false, "n", {}}, {ImageTexture{"/h.exr"}, true, "h", {}}};
  scene.materials[0].normal_map = Id<Texture>{0};
  scene.materials[0].displacement = FloatParameter{Id<Texture>{1}};
  scene.materials[0].name = "wall";
  const auto outer = write(scene).child("bsdf");
  EXPECT_STREQ(outer.attribute("type").value(), "normalmap");
  EXPECT_STREQ(outer.attribute("id").value(), "wall");
  EXPECT_EQ(reference(outer, "normalmap"), "n");
  const auto bump = outer.child("bsdf");
  EXPECT_STREQ(bump.attribute("type").value(), "bumpmap");
  EXPECT_EQ(value(bump, "scale"), "1");
  EXPECT_STREQ(bump.child("bsdf").attribute("type").value(), "twosided");
  EXPECT_STREQ(bump.child("bsdf").child("bsdf").attribute("type").value(), "diffuse");
  EXPECT_EQ(value(document_.child("scene").child("texture"), "raw"), "true");
}

TEST_F(WriteMitsuba, BumpsBelongToWhatShowsThem) {
  Scene scene = square_scene({});
  scene.textures = {{ImageTexture{"/n.exr"}, false, "n", {}}};
  scene.materials.push_back({MaskMaterial{0.5f, Id<Material>{0}}});
  scene.materials.push_back({InterfaceMaterial{}});
  scene.materials.push_back({ThinDielectricMaterial{}});
  for (std::size_t i = 1; i < 4; ++i) scene.materials[i].normal_map = Id<Texture>{0};
  scene.settings.straight_counts = false;
  const auto outermost = write(scene).child("bsdf");
  std::vector<std::string> types;
  for (auto bsdf = outermost; bsdf; bsdf = bsdf.next_sibling("bsdf"))
    types.emplace_back(bsdf.attribute("type").value());
  EXPECT_THAT(types, ElementsAre("twosided", "mask", "null", "normalmap"));
  EXPECT_THAT(diagnostics_, SizeIs(4));
  EXPECT_THAT(diagnostics_, drops("bumps of a material that is made of others"));
  EXPECT_THAT(diagnostics_, approximates("lets no light of emitters through it"));
}

// Measured: Mitsuba 3.9.1 gives .696 for .7 of a mirror and .3 of a grey of .2, which is .76.
TEST_F(WriteMitsuba, BlendsOfMirrorsAreDarkerThere) {
  Scene scene = square_scene({});
  const auto add = [&](MaterialModel model) { return add_to(scene.materials, Material{std::move(model)}); };
  const Id<Material> diffuse{0}, mirror = add(ConductorMaterial{}), glass = add(DielectricMaterial{}),
                                 mask = add(MaskMaterial{0.5f, mirror});
  add(BlendMaterial{mirror, glass, 0.5f}), add(BlendMaterial{diffuse, diffuse, 0.5f});
  scene.settings.straight_counts = false;
  write(scene);
  EXPECT_THAT(diagnostics_, IsEmpty());
  add(BlendMaterial{mask, diffuse, 0.5f});
  write(scene);
  EXPECT_THAT(diagnostics_, approximates("makes it darker"));
  EXPECT_THAT(read_mitsuba(folder_ / "scene.xml").diagnostics, approximates("darker in Mitsuba"));
}

// A blend with nothing lets light straight through as a mask does.
TEST_F(WriteMitsuba, EventsThatMitsubaDoesNotCount) {
  Scene scene = square_scene({});
  scene.materials.push_back({InterfaceMaterial{}});
  scene.materials.push_back({BlendMaterial{Id<Material>{0}, Id<Material>{1}, 0.5f}});
  write(scene);
  EXPECT_THAT(diagnostics_, approximates("the depth"));
  scene.settings.straight_counts = false;
  write(scene);
  EXPECT_THAT(diagnostics_, IsEmpty());
}

TEST_F(WriteMitsuba, ExactModels) {
  const Roughness rough{0.1f, 0.2f, Roughness::Distribution::beckmann};
  auto element = write_material(DielectricMaterial{.roughness = rough});
  EXPECT_STREQ(element.attribute("type").value(), "roughdielectric");
  EXPECT_EQ(value(element, "int_ior"), "1.5");
  EXPECT_EQ(value(element, "ext_ior"), "1");
  EXPECT_EQ(value(element, "alpha_u"), "0.1");
  EXPECT_EQ(value(element, "alpha_v"), "0.2");
  EXPECT_EQ(value(element, "distribution"), "beckmann");
  element = write_material(ConductorMaterial{});
  EXPECT_EQ(value(element, "material"), "Cu");
  EXPECT_EQ(value(element, "specular_reflectance"), "1");
  element = write_material(ConductorMaterial{PerfectReflector{}, {}, Spectrum{ConstantSpectrum{1}}});
  EXPECT_EQ(value(element, "material"), "none");
  element = write_material(PlasticMaterial{.roughness = {0.1f, 0.1f}, .nonlinear = true});
  EXPECT_STREQ(element.attribute("type").value(), "roughplastic");
  EXPECT_EQ(value(element, "nonlinear"), "true");
  EXPECT_EQ(value(element, "ext_ior"), "1.000277");
  element = write_material(PrincipledMaterial{});
  EXPECT_EQ(std::distance(element.begin(), element.end()), 12);
  EXPECT_STREQ(write_material(InterfaceMaterial{}).attribute("type").value(), "null");
  using Format = TabulatedMaterial::Format;
  EXPECT_STREQ(write_material(TabulatedMaterial{Format::adaptive, "/m.bsdf"}).attribute("type").value(),
               "measured");
  EXPECT_STREQ(write_material(MeasuredMaterial{"/m.pbsdf"}).attribute("type").value(), "measured_polarized");
  EXPECT_THAT(diagnostics_, IsEmpty());
}

// A clear coat takes as much from a metal as light loses on its way through, to and fro.
TEST_F(WriteMitsuba, CoatedMetalsReflectAsMuchInTheMean) {
  const auto factor = [&](float eta, float k, float coat) {
    CoatedConductorMaterial m;
    m.metal = ComplexIndex{Spectrum{ConstantSpectrum{eta}}, Spectrum{ConstantSpectrum{k}}};
    m.interface_eta = ConstantSpectrum{coat};
    const std::string values = value(write_material(m), "specular_reflectance");
    return std::stod(values.substr(values.find(':') + 1));
  };
  EXPECT_NEAR(factor(1.5f, 0, 1.5f), 1, 1e-4);  // glass on glass
  EXPECT_NEAR(factor(0.2f, 3, 1), 1, 1e-4);
  // At normal incidence (1, 2) reflects .5 alone; below an index of 1.5 .415, with the .04 of the coat .429.
  EXPECT_NEAR(factor(1, 2, 1.5f), .429 / .5, .03);
  CoatedConductorMaterial textured;
  textured.metal = NormalReflectance{SpectrumParameter{ConstantSpectrum{0.5f}}};
  EXPECT_EQ(value(write_material(textured), "specular_reflectance"), "1");
}

TEST_F(WriteMitsuba, ApproximatedModels) {
  const auto type = [&](MaterialModel model) {
    return std::string(write_material(std::move(model)).attribute("type").value());
  };
  EXPECT_EQ(type(DiffuseMaterial{Spectrum{ConstantSpectrum{0.5f}}, 20.0f}), "diffuse");
  EXPECT_THAT(diagnostics_, approximates("Oren and Nayar"));
  EXPECT_EQ(type(DielectricMaterial{.eta = NamedSpectrum{"glass-BK7"}}), "dielectric");
  EXPECT_THAT(diagnostics_, approximates("1.5167"));  // n_D of BK7 is 1.51673 in catalogues
  EXPECT_EQ(type(CoatedDiffuseMaterial{}), "plastic");
  EXPECT_THAT(diagnostics_, approximates("nonlinear plastic"));
  EXPECT_EQ(type(CoatedConductorMaterial{}), "conductor");
  EXPECT_THAT(diagnostics_, approximates("without its coating"));
  EXPECT_EQ(type(PrincipledMaterial{.below = true}), "principled");
  EXPECT_THAT(diagnostics_, approximates("the base of glTF's model"));
  EXPECT_EQ(type(DiffuseTransmissionMaterial{}), "principledthin");
  EXPECT_THAT(diagnostics_, approximates("diffuse transmission"));
  EXPECT_EQ(type(SubsurfaceMaterial{SubsurfaceMaterial::Named{"Skin3"}}), "dielectric");
  EXPECT_THAT(diagnostics_, drops("Skin3"));
  EXPECT_EQ(type(SubsurfaceMaterial{SubsurfaceMaterial::Coefficients{Spectrum{ConstantSpectrum{1}},
                                                                     Spectrum{ConstantSpectrum{2}}}}),
            "dielectric");
  const auto shape = document_.child("scene").child("shape");
  EXPECT_EQ(reference(shape, "interior"), document_.child("scene").child("medium").attribute("id").value());
  EXPECT_STREQ(document_.child("scene").child("integrator").attribute("type").value(), "volpath");
}

// ---- Textures

TEST_F(WriteMitsuba, TexturesThatMitsubaDoesNotHave) {
  Scene scene = square_scene({});
  const auto constant = [](float value) { return SpectrumParameter{Spectrum{ConstantSpectrum{value}}}; };
  scene.textures = {{ImageTexture{"/i.exr"}, false, "i", {}},
                    {ProductTexture{constant(1), Id<Texture>{0}}, false, "p", {}},
                    {MixTexture{constant(0.25f), constant(0.75f), 0.5f}, false, "m", {}},
                    {NoiseTexture{}, false, "noise", {}}};
  const auto reflectance = [&](std::uint32_t texture) {
    scene.materials[0].model = DiffuseMaterial{Id<Texture>{texture}};
    return write(scene).child("bsdf").child("bsdf").first_child();
  };
  EXPECT_STREQ(reflectance(1).attribute("id").value(), "i");
  EXPECT_STREQ(reflectance(2).attribute("value").value(), "360:0.5, 830:0.5");
  EXPECT_STREQ(reflectance(3).attribute("value").value(), "0");
  EXPECT_THAT(diagnostics_, approximates("replaced by its mean"));
  EXPECT_THAT(diagnostics_, SizeIs(1));
}

TEST_F(WriteMitsuba, MappingsAndImages) {
  Scene scene = square_scene({});
  ImageTexture image{"/i.exr"};
  image.mapping = UvMapping{2, 0, 0.25f, 0, 3, 0.5f};
  image.wrap = Wrap::mirror;
  scene.textures = {{image, false, "i", {}}};
  const auto texture = write(scene).child("texture");
  EXPECT_EQ(value(texture, "wrap_mode"), "mirror");
  EXPECT_EQ(value(texture, "filter_type"), "bilinear");
  EXPECT_EQ(value(texture, "raw"), "false");
  EXPECT_STREQ(texture.child("transform").child("matrix").attribute("value").value(),
               "2 0 0 0.25 0 -3 0 0.5 0 0 1 0 0 0 0 1");
  image.mapping = SphericalMapping{};
  image.filter = TextureFilter::anisotropic;
  image.wrap = Wrap::black;
  scene.textures = {{image, false, "i", {}}};
  write(scene);
  EXPECT_THAT(diagnostics_, approximates("mapping by position"));
  EXPECT_THAT(diagnostics_, approximates("footprint"));
  EXPECT_THAT(diagnostics_, approximates("black outside"));
}

TEST_F(WriteMitsuba, FilesThatMitsubaCannotName) {
  Scene scene = square_scene({});
  scene.textures = {{ImageTexture{"/a$b.png"}, false, "i", {}}};
  write(scene);
  EXPECT_THAT(diagnostics_, drops("rename the file"));
}

TEST_F(WriteMitsuba, OpacitiesOfShapesAreMasks) {
  Scene scene = square_scene({});
  scene.shapes.resize(3, scene.shapes[0]);
  scene.shapes[1].opacity = scene.shapes[2].opacity = 0.25f;
  const pugi::xml_node root = write(scene);
  EXPECT_THAT(diagnostics_, IsEmpty());
  const pugi::xml_node mask = root.find_child_by_attribute("bsdf", "type", "mask");
  EXPECT_EQ(value(mask, "opacity"), "0.25");
  EXPECT_TRUE(mask.next_sibling("bsdf").empty()) << "one for both";
  std::vector<std::string> used;
  for (const pugi::xml_node shape : root.children("shape")) used.push_back(reference(shape, "bsdf"));
  EXPECT_THAT(used, ElementsAre(mask.child("ref").attribute("id").value(), mask.attribute("id").value(),
                                mask.attribute("id").value()));
  EXPECT_STREQ(root.child("integrator").attribute("type").value(), "volpath") << "where a mask is no event";
  // Sheets are events to a path, but not to that integrator.
  Material sheet;
  sheet.model = ThinDielectricMaterial{};
  scene.materials.push_back(sheet);
  write(scene);
  EXPECT_THAT(diagnostics_, approximates("the depth"));
  scene.settings.straight_counts = false;
  write(scene);
  EXPECT_THAT(diagnostics_, IsEmpty());
}

}  // namespace
}  // namespace vitrail::write_mitsuba_materials_test
