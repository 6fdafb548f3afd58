// SPDX-License-Identifier: Apache-2.0
// POV-Ray accepts whatever is written, and what is not exact is said.
#include <gmock/gmock.h>

#include <numbers>

#include "tests/importers/povray/povray_oracle.h"
#include "tests/support/png.h"

namespace vitrail::povray_materials_test {
namespace {

using testing::Contains;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

auto says(const std::string& text) { return Contains(Field(&Diagnostic::message, HasSubstr(text))); }

class PovrayMaterials : public testing::Test {
 protected:
  std::string text_of(const Scene& scene) {
    diagnostics_ = write_povray(scene, folder_ / "scene.pov");
    std::ifstream in(folder_ / "scene.pov");
    return {std::istreambuf_iterator<char>(in), {}};
  }

  TemporaryFolder folder_;
  Diagnostics diagnostics_;
};

Id<Texture> add_texture(Scene& scene, TextureModel model) {
  scene.textures.push_back({std::move(model)});
  return {static_cast<std::uint32_t>(scene.textures.size() - 1)};
}

// A row of squares, one a material, in front of each other.
void show_all(Scene& scene) {
  const std::size_t count = scene.materials.size();
  for (std::uint32_t i = 0; i < count; ++i) {
    Shape shape;
    shape.mesh = {static_cast<std::uint32_t>(scene.meshes.size())};
    shape.material = {i};
    const float x = -2 + 4 * static_cast<float>(i) / static_cast<float>(count);
    scene.meshes.push_back(square(x, x + .2f, -2, 2, static_cast<float>(i) * -.01f));
    scene.shapes.push_back(shape);
  }
}

Scene all_materials() {
  Scene scene = empty_povray_scene();
  scene.settings.max_depth = 3;
  Roughness rough;
  rough.alpha_u = 0.25f;
  rough.alpha_v = 0.125f;
  for (MaterialModel model : std::vector<MaterialModel>{
           DiffuseMaterial{ConstantSpectrum{.5f}, 20.0f}, DielectricMaterial{NamedSpectrum{"glass-BK7"}},
           DielectricMaterial{ConstantSpectrum{1.5f}, ConstantSpectrum{1}, rough}, ThinDielectricMaterial{},
           ConductorMaterial{}, ConductorMaterial{PerfectReflector{}, rough}, PlasticMaterial{},
           CoatedDiffuseMaterial{}, CoatedConductorMaterial{}, DiffuseTransmissionMaterial{},
           PrincipledMaterial{}, SubsurfaceMaterial{}, HairMaterial{}, MeasuredMaterial{},
           TabulatedMaterial{}, SlabMaterial{}, InterfaceMaterial{}})
    scene.materials.push_back({std::move(model)});
  scene.materials.push_back({BlendMaterial{{0}, {1}, 0.75f}});
  scene.materials.push_back({MaskMaterial{0.5f, {6}}});
  scene.materials.push_back({TwoSidedMaterial{{7}, {18}}});
  scene.materials.push_back({DiffuseMaterial{}, false});
  scene.materials.push_back({FinishMaterial{ConstantSpectrum{.5f}, ConstantSpectrum{1}, 2, .5f, 20, .5f}});
  scene.lights.push_back({PointLight{{0, 0, 3}, ConstantSpectrum{1}}});
  show_all(scene);
  return scene;
}

TEST_F(PovrayMaterials, AllAreAccepted) {
  if (!has_povray()) GTEST_SKIP() << "povray is not installed: nothing was rendered";
  EXPECT_FALSE(render_povray(all_materials(), folder_).values.empty());
}

TEST_F(PovrayMaterials, AllTexturesAreAccepted) {
  if (!has_povray()) GTEST_SKIP() << "povray is not installed: nothing was rendered";
  Scene scene = empty_povray_scene();
  const std::string file = folder_.write("a \"b\".ppm", "P3\n2 1\n255\n255 0 0  0 255 0\n").string();
  const Id<Texture> image = add_texture(scene, ImageTexture{file});
  ImageTexture odd{file, SphericalMapping{}, Wrap::clamp, TextureFilter::nearest, Encoding::gamma, 2.2f, .5f};
  const Id<Texture> ball = add_texture(scene, odd);
  odd.mapping = CylindricalMapping{};
  odd.invert = true;
  const Id<Texture> can = add_texture(scene, odd);
  odd.mapping = PlanarMapping{};
  const Id<Texture> sheet = add_texture(scene, odd);
  const Id<Texture> product = add_texture(scene, ProductTexture{image, ball});
  const Id<Texture> checks = add_texture(scene, CheckerboardTexture{product, can});
  add_texture(scene, CheckerboardTexture{image, Spectrum{ConstantSpectrum{.5f}}, {}, true});
  add_texture(scene, MixTexture{checks, sheet, image});
  add_texture(scene, MixTexture{checks, sheet, 0.25f});
  add_texture(scene, DirectionMixTexture{image, checks});
  const SpectrumParameter half = Spectrum{ConstantSpectrum{.5f}};
  add_texture(scene, BilinearTexture{half, image, checks, half});
  add_texture(scene, DotsTexture{image, checks});
  add_texture(scene, NoiseTexture{});
  add_texture(scene, PtexTexture{"none"});
  add_texture(scene, MeshAttributeTexture{"vertex_color"});
  add_texture(scene, UvTexture{});
  add_texture(scene, ImageTexture{(folder_ / "none.png").string()});
  add_texture(scene, ImageTexture{folder_.write("none.xyz", "").string()});
  for (std::uint32_t i = 0; i < scene.textures.size(); ++i)
    scene.materials.push_back({DiffuseMaterial{Id<Texture>{i}}});
  const auto last = static_cast<std::uint32_t>(scene.materials.size());
  scene.materials.push_back({MaskMaterial{image, {0}}});
  scene.materials.push_back({BlendMaterial{{1}, {last}, image}});
  scene.materials.push_back({ConductorMaterial{NormalReflectance{image}}});
  scene.materials.push_back({PrincipledMaterial{image, image, 0.0f, image}});
  scene.materials.back().displacement = image;
  scene.lights.push_back({PointLight{{0, 0, 3}, ConstantSpectrum{1}}});
  show_all(scene);
  Diagnostics diagnostics;
  EXPECT_FALSE(render_povray(scene, folder_, &diagnostics).values.empty());
  for (const std::string text :
       {"no such file", "does not read", "noise", "dots", "bilinear", "mesh attribute"})
    EXPECT_THAT(diagnostics, says(text));
}

TEST_F(PovrayMaterials, WhatIsNotExactIsSaid) {
  Scene scene = all_materials();
  scene.files = {"in.pbrt"};
  scene.materials[1].origin = {0, 3, 4};
  scene.media.push_back({"fog"});
  scene.lights.push_back({GoniometricLight{}});
  scene.lights.push_back({ProjectionLight{{}, ConstantSpectrum{1}}});
  std::get<PerspectiveCamera>(scene.camera).lens = {.1, 4};
  scene.film.filter = GaussianFilter{};
  text_of(scene);
  for (const std::string text :
       {"Oren",        "dispersion", "caustics", "roughness",    "anisotropic",
        "thin",        "conductor",  "plastic",  "coated",       "diffuse transmission",
        "principled",  "subsurface", "hair",     "measured",     "medium fog",
        "goniometric", "projection", "lens",     "pixel filter", "radiosity"})
    EXPECT_THAT(diagnostics_, says(text)) << text;
  for (const Diagnostic& d : diagnostics_)
    if (d.message.starts_with("dispersion")) {
      EXPECT_EQ(to_string(d.item), "in.pbrt:3:4");
    }
}

// Notes say how much, where it can be computed.
TEST_F(PovrayMaterials, NotesSayTheSize) {
  test::write_png(folder_ / "ramp.png", 4, 1, 1, {0, 51, 102, 255});
  test::write_png(folder_ / "tilted.png", 1, 1, 3, {218, 128, 218});  // 45 degrees
  Scene scene = empty_povray_scene();
  ImageTexture ramp{(folder_ / "ramp.png").string()}, tilted{(folder_ / "tilted.png").string()};
  ramp.encoding = tilted.encoding = Encoding::linear;
  ConductorMaterial mirror{PerfectReflector{}};
  mirror.roughness.alpha_u = mirror.roughness.alpha_v = add_texture(scene, ramp);
  Material bumpy{DiffuseMaterial{}};
  bumpy.normal_map = add_texture(scene, tilted);
  const Id<Texture> attribute = add_texture(scene, MeshAttributeTexture{"vertex_color"});
  const ConstantSpectrum glass{1.5f}, air{1};
  scene.materials = {{mirror},
                     {ThinDielectricMaterial{glass, air}},
                     {DielectricMaterial{glass, air}},
                     bumpy,
                     {DiffuseMaterial{attribute}}};
  show_all(scene);
  scene.meshes.back().attributes.push_back({"vertex_color", false, 3, {0, 0, 0, 1, 1, 1, 0, 0, 0, 1, 1, 1}});
  scene.lights.push_back({InfiniteLight{emission_from_rgb({1, 1, 1})}});
  text_of(scene);
  EXPECT_THAT(diagnostics_, says("its mean, 0.4, of 0 to 1"));
  EXPECT_THAT(diagnostics_, says("tilts them by 45 degrees in the mean"));
  EXPECT_THAT(diagnostics_, says("its mean, (0.5, 0.5, 0.5), from which its values go up to 0.5 away"));
  EXPECT_THAT(diagnostics_, says("without the 7.7 % that it mirrors"));
  EXPECT_THAT(diagnostics_, says("without the 4 % that a surface mirrors"));
  EXPECT_THAT(diagnostics_, says("within 1 % of the mean and 10 % of a block"));
}

TEST_F(PovrayMaterials, ExactScenesNeedNoWords) {
  Scene scene = empty_povray_scene();
  add(scene, square(-1, 1, -1, 1, 0), DiffuseMaterial{reflectance_from_rgb({.2, .4, .6})});
  scene.lights.push_back({DistantLight{{0, 0, -1}, emission_from_rgb({1, 1, 1})}});
  const std::string text = text_of(scene);
  EXPECT_THAT(diagnostics_, IsEmpty());
  EXPECT_THAT(text, HasSubstr("rgb <0.2,0.4,0.6>"));
  EXPECT_THAT(text, testing::Not(HasSubstr("radiosity {")));
}

TEST_F(PovrayMaterials, MeshesWithoutAreaAreLeftOut) {
  Scene scene = empty_povray_scene();
  add(scene, square(1, 1, -1, 1, 0), DiffuseMaterial{});
  add(scene, TriangleMesh{}, DiffuseMaterial{});
  EXPECT_THAT(text_of(scene), testing::Not(HasSubstr("mesh2")));
}

// ---- Materials and textures as POV-Ray shows them ------------------------------------------------

// The mean over the picture of a mirror of ±.1 at the origin, seen from (0,0,4), below a disk of radius 2
// that shines at the same height: the share of facets whose slope is below tan(atan(2/4)/2).
TEST_F(PovrayOracle, RoughMirrorsHaveTheSlopesOfTheirFacets) {
  using enum Roughness::Distribution;
  for (const auto distribution : {ggx, beckmann})
    for (const float alpha : {.1f, .3f, .5f}) {
      Scene scene = empty_povray_scene();
      scene.settings.max_depth = 2;
      scene.settings.direct_only = true;
      scene.film.width = scene.film.height = 96;
      scene.film.crop = {0, 96, 0, 96};
      std::get<PerspectiveCamera>(scene.camera).screen = {-.025, .025, -.025, .025};
      ConductorMaterial mirror{PerfectReflector{}};
      mirror.roughness.alpha_u = mirror.roughness.alpha_v = alpha;
      mirror.roughness.distribution = distribution;
      add(scene, square(-5, 5, -5, 5, 0), mirror);
      TriangleMesh disk;
      disk.quadric = Quadric{.kind = QuadricKind::disk, .low = 0};
      Shape& lamp = add_emitter(scene, disk, {.5, .5, .5});
      lamp.object_to_world = translate({0, 0, 4.01}) * scale({2, 2, -1});
      scene.area_lights.back().two_sided = true;
      const PovPicture picture = render_povray(scene, folder_);
      ASSERT_FALSE(picture.values.empty());
      double sum = 0;
      for (const double value : picture.values) sum += value;
      const double slope = std::tan(std::atan(.5) / 2), x = slope * slope / (alpha * alpha);
      const bool is_ggx = distribution == ggx;
      const double share = is_ggx ? x / (1 + x) : 1 - std::exp(-x);
      const double
          albedo =  // of what facets reflect, some is hidden by others: with G of Smith, at 32 degrees
          is_ggx ? (alpha == .1f   ? .986
                    : alpha == .3f ? .862
                                   : .682)
                 : (alpha == .1f   ? 1
                    : alpha == .3f ? .99
                                   : .9);
      EXPECT_NEAR(sum / static_cast<double>(picture.values.size()), .5 * share * albedo, .035 * .5)
          << alpha << (is_ggx ? " GGX" : " Beckmann");
    }
}

// From above, of a sky of one radiance: F + (1 − F)·ρ(1 − b)/(1 − ρb), b what the interface reflects inside.
TEST_F(PovrayOracle, PlasticsLetOutWhatTheirAngleLets) {
  Scene scene = plane();
  PlasticMaterial plastic;
  plastic.diffuse_reflectance = reflectance_from_rgb({.8, .4, .1});
  plastic.eta = 1.5f, plastic.exterior_eta = 1, plastic.nonlinear = true;
  scene.materials[0].model = plastic;
  scene.lights.push_back({InfiniteLight{emission_from_rgb({.8, .8, .8})}});
  scene.settings.max_depth = 2;
  std::get<PerspectiveCamera>(scene.camera).screen = {-.1, .1, -.1, .1};
  constexpr double facing = .04, inside = .5963;  // of index 1.5
  expect_plane(
      scene,
      [](double, double) -> std::array<double, 3> {
        const auto seen = [](double rho) {
          return .8 * (facing + (1 - facing) * rho * (1 - inside) / (1 - rho * inside));
        };
        return {seen(.8), seen(.4), seen(.1)};
      },
      0.02);
}

// Under a sky of one radiance and over nothing, from above. One surface of glass shows (1 − F)/n² of it.
TEST_F(PovrayOracle, PrincipledMaterialsHaveAllTheirParts) {
  const auto seen = [&](const PrincipledMaterial& principled) {
    Scene scene = plane();
    scene.materials[0].model = principled;
    scene.materials[0].two_sided = false;
    scene.lights.push_back({InfiniteLight{emission_from_rgb({.5, .5, .5})}});
    scene.settings.max_depth = 4;
    std::get<PerspectiveCamera>(scene.camera).screen = {-.1, .1, -.1, .1};
    return render_povray(scene, folder_).at(16, 16)[0];
  };
  constexpr double facing = .04, glass = facing + (1 - facing) / 2.25;
  PrincipledMaterial m;
  m.eta = 1.5f, m.roughness = 0.02f;
  m.base_color = ConstantSpectrum{0};
  const double bare = seen(m);
  EXPECT_NEAR(bare, .5 * facing, .001);
  m.clearcoat = 1.0f, m.clearcoat_gloss = 1.0f;
  EXPECT_NEAR(seen(m), bare + .5 * .04, .002);
  m.clearcoat = 0.0f;
  m.base_color = ConstantSpectrum{1};
  const double plastic = seen(m);
  m.spec_trans = 1.0f;
  EXPECT_NEAR(seen(m), .5 * glass, .005);
  m.spec_trans = 0.25f;
  EXPECT_NEAR(seen(m), .75 * plastic + .25 * .5 * glass, .01);
  m.spec_trans = 0.0f, m.metallic = 0.5f;
  EXPECT_NEAR(seen(m), .5 * plastic + .5 * .5, .01);
}

// A pane of two sheets is as bright as what is behind it, less what both reflect, to and fro: of that POV-Ray
// shows about one half.
TEST_F(PovrayOracle, SheetsOfGlassMakePanes) {
  Scene scene = empty_povray_scene();
  add(scene, square(-5, 5, -5, 5, 0), DielectricMaterial{ConstantSpectrum{1.5f}});
  TriangleMesh below = square(-5, 5, -5, 5, -.1f);
  std::swap(below.positions[1], below.positions[3]);
  Shape second = make_shape(scene, below, DielectricMaterial{ConstantSpectrum{1.5f}});
  second.material = scene.shapes[0].material;
  scene.shapes.push_back(second);
  TriangleMesh lamp = square(-5, 5, -5, 5, -1);
  add_emitter(scene, lamp, {.5, .5, .5});
  scene.settings.max_depth = 8;
  std::get<PerspectiveCamera>(scene.camera).screen = {-.1, .1, -.1, .1};
  expect_plane(
      scene,
      [](double, double) -> std::array<double, 3> {
        constexpr double seen = .5 * .96 / 1.04;
        return {seen, seen, seen};
      },
      .05);
}

// As they are rendered: numbers are 0, colours .5.
TEST_F(PovrayMaterials, AttributesThatNoMeshHas) {
  Scene scene = empty_povray_scene();
  const Id<Texture> nothing = add_texture(scene, MeshAttributeTexture{.name = "nothing"});
  ConductorMaterial mirror{PerfectReflector{}};
  mirror.roughness.alpha_u = mirror.roughness.alpha_v = nothing;
  scene.materials = {{DiffuseMaterial{nothing}}, {mirror}};
  show_all(scene);
  const std::string text = text_of(scene);
  EXPECT_THAT(text, HasSubstr("Material_0 = texture { pigment { rgb <0.5,0.5,0.5> } }"));
  EXPECT_THAT(text, Not(HasSubstr("normal {")));
  EXPECT_THAT(diagnostics_, says("mesh attribute nothing, which no mesh has: 0.5"));
}

// Of 2 × 2 texels on uvs from −1 to 2, without interpolation.
TEST_F(PovrayOracle, ImagesEndAsTheyAreWrapped) {
  test::write_png(folder_ / "four.png", 2, 2, 1, {51, 102, 153, 255});
  for (const Wrap wrap : {Wrap::repeat, Wrap::mirror, Wrap::clamp, Wrap::black}) {
    ImageTexture image{(folder_ / "four.png").string()};
    image.encoding = Encoding::linear;
    image.filter = TextureFilter::nearest;
    image.wrap = wrap;
    Scene scene = empty_povray_scene();
    scene.textures.push_back({image});
    TriangleMesh mesh = square(-2, 2, -2, 2, 0);
    mesh.uvs = {{-1, -1}, {2, -1}, {2, 2}, {-1, 2}};
    add(scene, mesh, DiffuseMaterial{Id<Texture>{0}});
    scene.lights.push_back({DistantLight{
        {0, 0, -1}, emission_from_rgb({std::numbers::pi, std::numbers::pi, std::numbers::pi})}});
    const auto texel = [&](double at) {  // of two along a side; −1: none
      const double turn = at - 2 * std::floor(at / 2);
      if (wrap == Wrap::clamp) return at < .5 ? 0 : 1;
      if (wrap == Wrap::mirror) return std::min(turn, 2 - turn) < .5 ? 0 : 1;
      if (wrap == Wrap::black && (at < 0 || at > 1)) return -1;
      return at - std::floor(at) < .5 ? 0 : 1;
    };
    expect_plane(
        scene,
        [&](double x, double y) -> std::array<double, 3> {
          const int s = texel(-1 + 3 * (x + 2) / 4), t = texel(-1 + 3 * (y + 2) / 4);
          constexpr double values[2][2] = {{.6, 1}, {.2, .4}};  // the lower row first
          const double value = s < 0 || t < 0 ? 0 : values[t][s];
          return {value, value, value};
        },
        0.02);
  }
}

// A board of weights .25 and .75 between white and black.
TEST_F(PovrayOracle, BlendsByAnyTexture) {
  Scene scene = plane();
  CheckerboardTexture board{ConstantSpectrum{.25f}, ConstantSpectrum{.75f}};
  board.mapping = UvMapping{2, 0, 0, 0, 2, 0};
  scene.textures.push_back({board, true});
  scene.meshes[0] = square(-2, 2, -2, 2, 0);
  scene.materials = {{diffuse({1, 1, 1})}, {diffuse({0, 0, 0})}, {BlendMaterial{{0}, {1}, Id<Texture>{0}}}};
  scene.shapes[0].material = {2};
  scene.lights.push_back(
      {DistantLight{{0, 0, -1}, emission_from_rgb({std::numbers::pi, std::numbers::pi, std::numbers::pi})}});
  expect_plane(scene, [](double x, double y) -> std::array<double, 3> {
    const double value = (x < 0) == (y < 0) ? .75 : .25;
    return {value, value, value};
  });
}

}  // namespace
}  // namespace vitrail::povray_materials_test
