// SPDX-License-Identifier: Apache-2.0
// The text that the Mitsuba writer makes. What Mitsuba makes of it: mitsuba_oracle.h.
#include "importers/mitsuba/write/write_mitsuba.h"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <pugixml.hpp>

#include "images/image_files.h"
#include "importers/mitsuba/read/mitsuba.h"
#include "importers/mitsuba/write/write_camera.h"
#include "tests/importers/curve_records.h"
#include "tests/importers/mitsuba/write_mitsuba_fixture.h"
#include "tests/importers/temporary_folder.h"
#include "tests/importers/written_scenes.h"

namespace vitrail {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;

// ---- The file

TEST_F(WriteMitsuba, HeaderOrderAndFiles) {
  Scene scene = square_scene({});
  scene.lights.push_back({PointLight{{1, 2, 3}, ConstantSpectrum{1}}, {}});
  const auto root = write(scene);
  EXPECT_THAT(text_, HasSubstr("Written by Vitrail 0."));
  std::vector<std::string> tags;
  for (const auto child : root) tags.emplace_back(child.name());
  EXPECT_THAT(tags, ElementsAre("integrator", "sensor", "bsdf", "emitter", "shape"));
  EXPECT_STREQ(root.attribute("version").value(), "3.0.0");
  EXPECT_EQ(value(root.child("shape"), "filename"), "scene-meshes/000000.ply");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "scene-meshes/000000.ply"));
  EXPECT_THAT(diagnostics_, IsEmpty());
}

TEST_F(WriteMitsuba, EqualScenesGiveEqualFiles) {
  const Scene scene = square_scene({});
  write(scene);
  const std::string first = text_;
  write(scene);
  EXPECT_EQ(text_, first);
}

// As those of an OBJ are.
TEST_F(WriteMitsuba, LampsNamedAsTheirShapeOrMaterialHaveNoIdOfTheirOwn) {
  Scene scene = square_scene({});
  scene.materials[0].name = "glow";
  scene.area_lights.push_back({Spectrum{ConstantSpectrum{1}}});
  scene.shapes[0].area_light = Id<AreaLight>{0};
  scene.shapes[0].name = "lamp";
  for (const auto& [name, id] : {std::pair("lamp", ""), std::pair("glow", ""), std::pair("other", "other")}) {
    scene.area_lights[0].name = name;
    const auto root = write(scene);
    EXPECT_STREQ(root.child("shape").child("emitter").attribute("id").value(), id) << name;
    EXPECT_STREQ(root.child("shape").attribute("id").value(), "lamp");
    EXPECT_THAT(diagnostics_, IsEmpty()) << name;
  }
}

TEST_F(WriteMitsuba, NamesAreEscapedAndUnique) {
  const std::string name = "a <b> & \"c\" 'd' ü\n\t";
  Scene scene = square_scene({});
  scene.materials[0].name = name;
  scene.shapes[0].name = name;
  const auto root = write(scene);
  EXPECT_EQ(root.child("bsdf").attribute("id").value(), name);
  EXPECT_EQ(reference(root.child("shape"), "bsdf"), name);
  EXPECT_EQ(root.child("shape").attribute("id").value(), name + "_2");
  EXPECT_THAT(diagnostics_, approximates("another record has it already"));
  scene.materials[0].name = "$x";
  EXPECT_THAT(write(scene).child("bsdf").attribute("id").value(), StartsWith("_unnamed_"));
}

TEST_F(WriteMitsuba, DiagnosticsSayWhere) {
  Scene scene = square_scene({});
  scene.files = {"a.pbrt"};
  scene.materials[0].model = CoatedDiffuseMaterial{};
  scene.materials[0].origin = {0, 7, 3};
  write(scene);
  ASSERT_THAT(diagnostics_, SizeIs(1));
  EXPECT_EQ(to_string(diagnostics_[0].location), "a.pbrt:7:3");
  EXPECT_EQ(to_string(diagnostics_[0].item), "a.pbrt:7:3");
}

// ---- Numbers

TEST_F(WriteMitsuba, NumbersAreBitExact) {
  Scene scene = square_scene({});
  const double awkward = 0.1 + 0.2, tiny = 4.9e-324;
  scene.shapes[0].object_to_world.m[0] = {awkward, tiny, -1.0 / 3, 1e300};
  scene.lights.push_back({PointLight{{awkward, -0.0, 1e-17}, ConstantSpectrum{0.1f}}, {}});
  const auto root = write(scene);
  std::istringstream matrix(
      root.child("shape").child("transform").child("matrix").attribute("value").value());
  for (const double expected : scene.shapes[0].object_to_world.m[0]) {
    std::string word;
    matrix >> word;
    EXPECT_EQ(std::strtod(word.c_str(), nullptr), expected) << word;
  }
  EXPECT_EQ(root.child("emitter").child("point").attribute("x").as_double(), awkward);
  EXPECT_EQ(value(root.child("emitter"), "intensity"), "0.1");
}

TEST_F(WriteMitsuba, EverythingIsFinite) {
  Scene scene = square_scene({});
  auto& camera = std::get<PerspectiveCamera>(scene.camera);
  camera.lens = {0.1, std::numeric_limits<double>::infinity()};
  write(scene);
  EXPECT_EQ(text_.find("inf"), std::string::npos);
  EXPECT_EQ(text_.find("nan"), std::string::npos);
}

TEST_F(WriteMitsuba, AnglesOfViewComeBackExactly) {
  const auto half_width = [](double fov) { return std::tan(fov / 2 * std::numbers::pi / 180); };
  for (const double fov : {90.0, 45.0, 39.3077, 1e-3, 179.5, 20.114292}) {
    EXPECT_EQ(mitsuba_writer::field_of_view_deg(half_width(fov)), fov);
  }
  int exact = 0;
  for (int i = 1; i <= 1000; ++i) {
    const double fov = 0.1739 * i;
    exact += half_width(mitsuba_writer::field_of_view_deg(half_width(fov))) == half_width(fov);
  }
  EXPECT_EQ(exact, 1000);
}

// ---- Spectra

TEST_F(WriteMitsuba, Spectra) {
  const auto reflectance = [&](const Spectrum& spectrum) {
    return write_material(DiffuseMaterial{spectrum}).find_child_by_attribute("name", "reflectance");
  };
  EXPECT_STREQ(reflectance(ConstantSpectrum{0.25f}).attribute("value").value(), "0.25");
  EXPECT_STREQ(reflectance(reflectance_from_rgb({0.1, 0.2, 0.3})).name(), "rgb");
  EXPECT_STREQ(reflectance(reflectance_from_rgb({0.1, 0.2, 0.3})).attribute("value").value(), "0.1 0.2 0.3");
  EXPECT_STREQ(reflectance(unbounded_from_rgb({0.5, 1, 0.25})).name(), "rgb");
  EXPECT_STREQ(reflectance(unbounded_from_rgb({0.5, 1.5, 0.25})).name(), "spectrum");  // <rgb> ends at 1
  const std::vector<std::array<double, 2>> samples{{360, 0.25}, {500, 0.5}, {830, 1}};
  EXPECT_STREQ(reflectance(tabulate(samples, true)).attribute("value").value(), "360:0.25, 500:0.5, 830:1");
  // A line of .2 nm is what was read, not a table of 1 nm.
  EXPECT_STREQ(
      reflectance(tabulate({{400, 0.1}, {546.05, 0.1}, {546.15, 0.9}, {546.25, 0.1}, {700, 0.1}}, false))
          .attribute("value")
          .value(),
      "400:0.1, 546.05:0.1, 546.15:0.9, 546.25:0.1, 700:0.1");
}

// Reading the list gives the same 471 values.
TEST_F(WriteMitsuba, TablesComeBackBitForBit) {
  std::vector<std::array<double, 2>> samples;
  for (int i = 0; i < 30; ++i) samples.push_back({350.5 + 17.3 * i, 0.1 + 0.03 * ((i * 7) % 13)});
  for (const TabulatedSpectrum& table :
       {tabulate(samples, true), blackbody(4000), tabulate({{400, 1}, {700, 2}}, false)}) {
    const auto element =
        write_material(DiffuseMaterial{Spectrum{table}}).find_child_by_attribute("name", "reflectance");
    std::vector<std::array<double, 2>> found;
    std::istringstream list(element.attribute("value").value());
    for (std::string pair; std::getline(list, pair, ',');) {
      const std::size_t colon = pair.find(':');
      found.push_back({std::stod(pair.substr(0, colon)), std::stod(pair.substr(colon + 1))});
    }
    EXPECT_EQ(tabulate(found, false), table);
  }
}

TEST_F(WriteMitsuba, Emission) {
  const auto radiance = [&](const Spectrum& spectrum) {
    Scene scene = square_scene({});
    scene.lights.push_back({InfiniteLight{spectrum}, {}});
    return write(scene).child("emitter").first_child();
  };
  EXPECT_STREQ(radiance(emission_from_rgb({3, 2, 1})).attribute("value").value(), "3 2 1");
  EXPECT_STREQ(radiance(ConstantSpectrum{3}).name(), "spectrum");  // <float> would be D65
  EXPECT_STREQ(radiance(reflectance_from_rgb({0.1, 0.2, 0.3})).name(), "spectrum");
  EXPECT_STREQ(radiance(NamedSpectrum{"stdillum-D65"}).attribute("type").value(), "d65");
  EXPECT_STREQ(radiance(BlackbodySpectrum{5000, 1}).attribute("type").value(), "");
}

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

// ---- Shapes, media, camera

TEST_F(WriteMitsuba, SidesAreReversedOnlyWhereTheyShow) {
  Scene scene = square_scene({}, true);
  scene.shapes[0].object_to_world = scale({-1, 1, 1});
  EXPECT_EQ(value(write(scene).child("shape"), "filename"), "scene-meshes/000000.ply");
  EXPECT_EQ(value(document_.child("scene").child("shape"), "flip_normals"), "false");
  scene.materials[0].two_sided = false;
  EXPECT_EQ(value(write(scene).child("shape"), "filename"), "scene-meshes/000000.sides.ply");
  EXPECT_EQ(value(document_.child("scene").child("shape"), "flip_normals"), "true");
}

TEST_F(WriteMitsuba, PrototypesComeInTheOrderOfTheirMeshes) {
  Scene scene = square_scene({});
  scene.meshes.push_back(square_mesh());
  scene.shapes[0].mesh = {1};
  Shape inner = scene.shapes[0];
  inner.mesh = {0};
  scene.prototypes.push_back({"group", {inner}, {}});
  scene.instances.push_back({{0}, {}, {}});
  std::vector<std::string> types;
  for (const auto shape : write(scene).children("shape")) types.emplace_back(shape.attribute("type").value());
  EXPECT_THAT(types, ElementsAre("shapegroup", "ply", "instance"));
}

// Bent curves of radii that end in 0, of which some go on smoothly and some do not, and straight ones.
TEST_F(WriteMitsuba, CurvesStayCurves) {
  const std::vector<CurvePoint> points{{{0, 0, 0}, .1},    {{1, .3, 0}, .07}, {{2, 1, .7}, .02},
                                       {{3, 1, 0}, 0},     {{4, 1, -.7}, .1}, {{5, 0, 0}, .2},
                                       {{1006, .1, 0}, .1}};
  const std::vector<PlacedCurve> smooth = placed_curves(bspline_segments(points), 0, 1, false, false),
                                 kinked = placed_curves(bezier_segments(points), 0, 1, false, false),
                                 straight = placed_curves(linear_segments(points), 0, 1, true, true);
  std::vector<PlacedCurve> all = smooth;
  all.insert(all.end(), kinked.begin(), kinked.end());
  Scene scene = square_scene({});
  scene.shapes = {test::add_curves(scene, all, QuadricUv::mitsuba)};
  scene.shapes.push_back(test::add_curves(scene, straight, QuadricUv::mitsuba));
  scene.shapes[1].object_to_world = rotate(1, {1, 2, 3}) * scale({2, 2, 2});
  all.insert(all.end(), straight.begin(), straight.end());
  scene.prototypes.push_back({"p", {test::add_curves(scene, all, QuadricUv::mitsuba)}, {}, {}});
  scene.instances.push_back({{0}, scale({1, 2, 1}), {}});
  const auto elements = write(scene);
  EXPECT_THAT(diagnostics_, IsEmpty());
  EXPECT_EQ(elements.select_nodes(".//shape[@type='bsplinecurve']").size(), 2u);
  EXPECT_EQ(elements.select_nodes(".//shape[@type='linearcurve']").size(), 2u);
  std::ifstream file(folder_ / "scene-meshes" / "000000.txt");
  const std::string text(std::istreambuf_iterator<char>(file), {});
  EXPECT_EQ(std::ranges::count(text, '\n'), 7 + 1 + 4 + 1 + 4) << text;
  const Scene again = read_mitsuba(folder_ / "scene.xml").scene;
  test::expect_near(test::curves_of(scene, scene.shapes), test::curves_of(again, again.shapes), 4e-6);
  test::expect_near(test::curves_of(scene, scene.prototypes.at(0).shapes),
                    test::curves_of(again, again.prototypes.at(0).shapes), 4e-6);
}

TEST_F(WriteMitsuba, CurvesThatMitsubaDoesNotHave) {
  const std::vector<CurvePoint> points{{{0, 0, 0}, .1}, {{1, .3, 0}, .1}, {{2, 1, .7}, .1}, {{3, 1, 0}, .1}};
  const auto written = [&](const Shape& of, Scene& scene, const char* report) {
    scene.shapes = {of};
    const auto elements = write(scene);
    EXPECT_THAT(diagnostics_, Contains(Field(&Diagnostic::message, HasSubstr(report))));
    return std::string(elements.child("shape").attribute("type").value());
  };
  Scene scene = square_scene({});
  const Shape open =
      test::add_curves(scene, placed_curves(linear_segments(points), 0, 1, true, false), QuadricUv::mitsuba);
  EXPECT_EQ(written(open, scene, "half balls"), "linearcurve");
  Shape bent =
      test::add_curves(scene, placed_curves(bezier_segments(points), 0, 1, false, false), QuadricUv::pbrt);
  scene.film.layers.add(Layer::uv);
  EXPECT_EQ(written(bent, scene, "(u,v) of curves"), "bsplinecurve");
  bent.object_to_world = vitrail::scale({1, 1, 2});
  EXPECT_EQ(written(bent, scene, "tubes of triangles"), "ply");
  bent.object_to_world = {};
  bent.flip_orientation = true;  // its front is inside
  scene.materials[0].two_sided = false;
  EXPECT_EQ(written(bent, scene, "tubes of triangles"), "ply");
}

TEST_F(WriteMitsuba, Media) {
  Scene scene = square_scene({});
  Medium medium;
  medium.coefficients = ExtinctionAlbedo{Spectrum{ConstantSpectrum{2}}, Spectrum{ConstantSpectrum{0.5f}}};
  medium.g = 0.25f;
  medium.emission = ConstantSpectrum{1};
  scene.media = {medium};
  scene.shapes[0].exterior = scene.camera_medium = Id<Medium>{0};
  const auto root = write(scene);
  EXPECT_EQ(value(root.child("medium"), "sigma_t"), "2");
  EXPECT_EQ(value(root.child("medium").child("phase"), "g"), "0.25");
  const std::string id = root.child("medium").attribute("id").value();
  EXPECT_EQ(reference(root.child("shape"), "exterior"), id);
  EXPECT_EQ(reference(root.child("sensor"), "medium"), id);
  EXPECT_THAT(diagnostics_, drops("emission of a medium"));
  Grid grid;
  grid.nx = grid.ny = grid.nz = 1;
  grid.values = {5};
  scene.media[0].density = grid;
  write(scene);
  EXPECT_EQ(std::filesystem::file_size(folder_ / "scene-volumes/000000.vol"), 52u);
}

TEST_F(WriteMitsuba, WhatCamerasAndFilmsCannotSay) {
  Scene scene = square_scene({});
  scene.film.filter = GaussianFilter{1.5, 1.5, 0.5};
  scene.settings.max_depth = unlimited_depth;
  EXPECT_EQ(value(write(scene).child("integrator"), "max_depth"), "-1");
  EXPECT_THAT(diagnostics_, approximates("4σ"));
  scene.camera = SphericalCamera{};
  write(scene);
  EXPECT_THAT(diagnostics_, drops("all directions"));
  scene.camera = PerspectiveCamera{{}, {-1, 1, -1, 1}, {}};  // the film is 8 × 4
  write(scene);
  EXPECT_THAT(diagnostics_, approximates("square"));
}

// Its film has none.
TEST_F(WriteMitsuba, ExposureIsInTheLights) {
  Scene scene = square_scene({});
  scene.film.imaging_ratio = 2;
  scene.lights = {{PointLight{{1, 2, 3}, ConstantSpectrum{3}}, {}}};
  scene.area_lights.push_back({.radiance = ConstantSpectrum{5}, .scale = 7});
  scene.shapes[0].area_light = Id<AreaLight>{0};
  const auto root = write(scene);
  EXPECT_THAT(diagnostics_, IsEmpty());
  EXPECT_EQ(value(root.child("emitter"), "intensity"), "6");
  EXPECT_EQ(value(root.child("shape").child("emitter"), "radiance"), "70");
  scene.lights = {{InfiniteLight{ConstantSpectrum{1}}, {}}, {InfiniteLight{ConstantSpectrum{2}}, {}}};
  EXPECT_EQ(value(write(scene).child("emitter"), "radiance"), "6");  // of both
}

TEST_F(WriteMitsuba, LightsKeepTheirNames) {
  Scene scene = square_scene({});
  scene.lights = {{PointLight{{1, 2, 3}, ConstantSpectrum{3}}, {}, "bulb"}};
  scene.area_lights.push_back({.radiance = ConstantSpectrum{5}, .name = "panel"});
  scene.shapes[0].area_light = Id<AreaLight>{0};
  const auto root = write(scene);
  EXPECT_STREQ(root.child("emitter").attribute("id").value(), "bulb");
  EXPECT_STREQ(root.child("shape").child("emitter").attribute("id").value(), "panel");
  scene.lights[0].name = "", scene.area_lights[0].name = "";
  EXPECT_FALSE(write(scene).child("emitter").attribute("id"));
}

TEST_F(WriteMitsuba, LightsThatMitsubaDoesNotHave) {
  Scene scene = square_scene({});
  EnvironmentLight light;
  light.filename = "/none.exr";
  light.portal = {};
  light.portal.emplace();
  GoniometricLight lamp;
  lamp.intensity = ConstantSpectrum{1};
  scene.lights = {{light, {}}, {lamp, {}}, {ProjectionLight{{}, Spectrum{ConstantSpectrum{1}}}, {}}};
  write(scene);
  EXPECT_THAT(diagnostics_, drops("portal"));
  EXPECT_THAT(diagnostics_, drops("none.exr"));
  EXPECT_THAT(diagnostics_, drops("cannot read the image"));
  EXPECT_THAT(diagnostics_, approximates("goniometric"));
  EXPECT_THAT(diagnostics_, drops("without an image"));
}

TEST_F(WriteMitsuba, UnwritableFolders) {
  folder_.write("file", "");
  EXPECT_THROW(write_mitsuba(square_scene({}), folder_ / "file" / "scene.xml"), MachineError);
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

// Mitsuba's masks leave the light of a surface alone.
TEST_F(WriteMitsuba, WhatIsNotThereDoesNotShine) {
  Scene scene = square_scene({});
  scene.area_lights.push_back({ConstantSpectrum{2}});
  scene.shapes[0].area_light = Id<AreaLight>{0};
  scene.shapes[0].opacity = 0.25f;
  const pugi::xml_node emitter = write(scene).child("shape").child("emitter");
  EXPECT_EQ(value(emitter, "radiance"), "0.5") << text_;
}

// pbrt's invisible lamps: spots that are together as bright, on the side that it shines to.
TEST_F(WriteMitsuba, LampsThatNothingMeetsAreSpots) {
  constexpr double pi = std::numbers::pi;
  Scene scene = square_scene({});
  scene.area_lights.push_back({ConstantSpectrum{2}});
  scene.shapes[0].area_light = Id<AreaLight>{0};
  scene.shapes[0].opacity = 0.0f;
  for (const bool two_sided : {false, true}) {
    scene.area_lights[0].two_sided = two_sided;
    const pugi::xml_node root = write(scene);
    EXPECT_FALSE(root.child("shape"));
    EXPECT_EQ(value(root.child("integrator"), "hide_emitters"), "false");
    double flux = 0, weight = 0, towards = 0;
    std::size_t count = 0;
    for (const pugi::xml_node spot : root.children("emitter")) {
      EXPECT_STREQ(spot.attribute("type").value(), "spot");
      const auto angle = [&](const char* name) { return std::stod(value(spot, name)) * pi / 180; };
      const double a = angle("beam_width"), b = angle("cutoff_angle");
      flux += std::stod(value(spot, "intensity")) * 2 * pi * (1 - (std::sin(b) - std::sin(a)) / (b - a));
      weight += std::stod(value(spot, "sampling_weight"));
      std::array<double, 3> from{}, to{};
      const pugi::xml_node looks = spot.child("transform").child("lookat");
      std::sscanf(looks.attribute("origin").value(), "%lf,%lf,%lf", &from[0], &from[1], &from[2]);
      std::sscanf(looks.attribute("target").value(), "%lf,%lf,%lf", &to[0], &to[1], &to[2]);
      towards += to[2] - from[2];
      ++count;
    }
    const double area = 4;  // of the square
    EXPECT_NEAR(flux, pi * 2 * area * (two_sided ? 2 : 1), 1e-4 * flux);
    EXPECT_NEAR(weight, 1, 1e-4);
    EXPECT_NEAR(towards / static_cast<double>(count), two_sided ? 0 : 1, 1e-6);
    EXPECT_THAT(diagnostics_, approximates(fmt::format("becomes {} spot lights", count)));
  }
}

// Of a ball as bright from each side: its triangles lie ring by ring.
TEST_F(WriteMitsuba, SpotsOfABallLieAllAround) {
  Scene scene = square_scene({});
  scene.meshes[0] = {};
  scene.meshes[0].quadric = Quadric{QuadricKind::sphere};
  scene.area_lights.push_back({ConstantSpectrum{2}});
  scene.shapes[0].area_light = Id<AreaLight>{0};
  scene.shapes[0].opacity = 0.0f;
  std::array<double, 3> sum{}, squares{};
  double count = 0;
  for (const pugi::xml_node spot : write(scene).children("emitter")) {
    std::array<double, 3> p{};
    std::sscanf(spot.child("transform").child("lookat").attribute("origin").value(), "%lf,%lf,%lf", &p[0],
                &p[1], &p[2]);
    for (std::size_t k = 0; k < 3; ++k) sum[k] += p[k], squares[k] += p[k] * p[k];
    ++count;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(sum[k] / count, 0, 0.02) << k;
    EXPECT_NEAR(squares[k] / count, 1.0 / 3, 0.02) << k;
  }
}

}  // namespace
}  // namespace vitrail
