// SPDX-License-Identifier: Apache-2.0
// POV-Ray accepts whatever is written, and what is not exact is said.
#include <gmock/gmock.h>

#include "tests/importers/povray/povray_render.h"

namespace vitrail {
namespace {

using testing::Contains;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;

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
  Scene scene = empty_scene();
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
  Scene scene = empty_scene();
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
       {"no such file", "does not read", "does not repeat", "noise", "dots", "bilinear", "mesh attribute"})
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

TEST_F(PovrayMaterials, ExactScenesNeedNoWords) {
  Scene scene = empty_scene();
  add(scene, square(-1, 1, -1, 1, 0), DiffuseMaterial{reflectance_from_rgb({.2, .4, .6})});
  scene.lights.push_back({DistantLight{{0, 0, -1}, emission_from_rgb({1, 1, 1})}});
  const std::string text = text_of(scene);
  EXPECT_THAT(diagnostics_, IsEmpty());
  EXPECT_THAT(text, HasSubstr("rgb <0.2,0.4,0.6>"));
  EXPECT_THAT(text, testing::Not(HasSubstr("radiosity {")));
}

TEST_F(PovrayMaterials, MeshesWithoutAreaAreLeftOut) {
  Scene scene = empty_scene();
  add(scene, square(1, 1, -1, 1, 0), DiffuseMaterial{});
  add(scene, TriangleMesh{}, DiffuseMaterial{});
  EXPECT_THAT(text_of(scene), testing::Not(HasSubstr("mesh2")));
}

}  // namespace
}  // namespace vitrail
