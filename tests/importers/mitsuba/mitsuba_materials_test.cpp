// SPDX-License-Identifier: Apache-2.0
// Materials and textures as Mitsuba 3 reads them from written files.
#include <cmath>

#include "images/image_files.h"
#include "scene/geometry/pi.h"
#include "tests/importers/mitsuba/mitsuba_oracle.h"

namespace vitrail::mitsuba_materials_test {
namespace {

using testing::Contains;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;

// Every model, with both ways to give its parameters.
std::vector<MaterialModel> all_models() {
  const Roughness rough{0.2f, 0.3f, Roughness::Distribution::beckmann}, round{0.25f, 0.25f};
  const Spectrum glass = NamedSpectrum{"glass-BK7"}, color = unbounded_from_rgb({2, 1, 0.5});
  HairMaterial hair, absorbing, colored;
  hair.eumelanin = 1.0f;
  hair.along_v = absorbing.along_v = true;
  absorbing.sigma_a = color;
  colored.color = rgb_reflectance(0.6, 0.4, 0.2);
  PrincipledMaterial clear, sheet;
  clear.spec_trans = 0.5f;
  sheet.thin = true;
  return {DiffuseMaterial{rgb_reflectance(0.2, 0.4, 0.6), 20.0f},
          DielectricMaterial{glass, ConstantSpectrum{1.1f}},
          DielectricMaterial{.roughness = rough, .transmittance_factor = color},
          ThinDielectricMaterial{},
          ConductorMaterial{},
          ConductorMaterial{PerfectReflector{}, round, rgb_reflectance(0.9, 0.8, 0.7)},
          ConductorMaterial{NormalReflectance{rgb_reflectance(0.9, 0.6, 0.3)}, rough,
                            Spectrum{ConstantSpectrum{1}}},
          ConductorMaterial{ComplexIndex{color, color}, {}, Spectrum{ConstantSpectrum{1}}},
          PlasticMaterial{},
          PlasticMaterial{.roughness = rough, .nonlinear = true},
          CoatedDiffuseMaterial{},
          CoatedConductorMaterial{},
          DiffuseTransmissionMaterial{},
          PrincipledMaterial{},
          clear,
          sheet,
          SubsurfaceMaterial{SubsurfaceMaterial::Coefficients{Spectrum{ConstantSpectrum{1}}, color}},
          SubsurfaceMaterial{SubsurfaceMaterial::Effective{rgb_reflectance(0.5, 0.4, 0.3),
                                                           Spectrum{ConstantSpectrum{0.1f}}}},
          SubsurfaceMaterial{SubsurfaceMaterial::Named{"Skin1"}},
          hair,
          absorbing,
          colored,
          InterfaceMaterial{},
          BlendMaterial{{0}, {8}, 0.25f},
          BlendMaterial{{0}, {1}, 0.25f},
          MaskMaterial{0.25f, {0}},
          TwoSidedMaterial{{0}, {8}},
          TwoSidedMaterial{{0}, {1}}};
}

TEST_F(MitsubaOracle, EveryMaterialLoads) {
  Scene scene = empty_scene();
  const auto mesh = add_to(scene.meshes, square_mesh());
  for (const MaterialModel& model : all_models())
    for (const bool two_sided : {true, false}) {
      Material material;
      material.model = model;
      material.two_sided = two_sided;
      // the second half of the list refers to the first records of it
      scene.materials.push_back(material);
    }
  for (Material& material : scene.materials)
    std::visit(
        [&](auto& m) {
          using Model = std::decay_t<decltype(m)>;
          if constexpr (std::is_same_v<Model, BlendMaterial>) m.first.value *= 2, m.second.value *= 2;
          if constexpr (std::is_same_v<Model, MaskMaterial>) m.material.value *= 2;
          if constexpr (std::is_same_v<Model, TwoSidedMaterial>) m.front.value *= 2, m.back.value *= 2;
        },
        material.model);
  for (std::uint32_t i = 0; i < scene.materials.size(); ++i) {
    Shape shape;
    shape.mesh = mesh;
    shape.material = {i};
    shape.object_to_world = translate({0, 0, static_cast<double>(i)});
    scene.shapes.push_back(shape);
  }
  const Json spectral = ask(scene, {{{"op", "shapes"}}});
  EXPECT_FALSE(spectral.at(0).empty());
  allowed_warning_ = "clamping out-of-gamut color";  // Mitsuba's colours end at 1 in rgb
  ask(scene, {{{"op", "shapes"}}}, "scalar_rgb");
}

class MitsubaMaterial : public MitsubaOracle {
 protected:
  // BSDF · cosine of light at 60° that is seen from straight above (or behind).
  Json evaluated(const Material& material, bool from_behind = false, double uv_x = 0.5) {
    Scene scene = square_scene(material);
    const double side = from_behind ? -1 : 1;
    Json query = ray("bsdf", {2 * uv_x - 1, 0.4, side * 3}, {0, 0, -side});
    query["wo"] = {std::sqrt(0.75), 0, side * 0.5};
    return ask(scene, Json::array({query})).at(0);
  }
};

TEST_F(MitsubaMaterial, DiffuseReflectanceOnBothSidesOrOne) {
  Material material;
  const Spectrum color = reflectance_from_rgb({0.2, 0.5, 0.7});
  material.model = DiffuseMaterial{color};
  expect_near(evaluated(material).at("value"), values(color, 0.5 / pi), 2e-3);
  expect_near(evaluated(material, true).at("value"), values(color, 0.5 / pi), 2e-3);
  material.two_sided = false;
  expect_near(evaluated(material, true).at("value"), {0, 0, 0, 0}, 0);
  EXPECT_THAT(diagnostics_, IsEmpty());
}

TEST_F(MitsubaMaterial, TabulatedReflectance) {
  const Spectrum color = tabulate({{400, 0.1}, {500, 0.7}, {700, 0.3}}, true);
  Material material;
  material.model = DiffuseMaterial{color};
  expect_near(evaluated(material).at("value"), values(color, 0.5 / pi), 1e-5);
}

TEST_F(MitsubaMaterial, BlendMaskAndTwoSided) {
  Scene scene = square_scene({});
  scene.materials.clear();
  const auto diffuse = [](float reflectance) {
    Material material;
    material.model = DiffuseMaterial{Spectrum{ConstantSpectrum{reflectance}}};
    return material;
  };
  const auto light = add_to(scene.materials, diffuse(0.8f)), dark = add_to(scene.materials, diffuse(0.2f));
  Material blend, mask, sides;
  blend.model = BlendMaterial{light, dark, 0.25f};
  mask.model = MaskMaterial{0.25f, light};
  sides.model = TwoSidedMaterial{light, dark};
  Json queries = Json::array();
  for (const Material& material : {blend, mask, sides}) {
    Shape shape = scene.shapes[0];
    shape.material = add_to(scene.materials, material);
    shape.object_to_world = translate({0, 0, 10.0 * shape.material.value});
    for (const double side : {1.0, -1.0}) {
      queries.push_back(ray("bsdf", {0.2, 0.4, 10.0 * shape.material.value + side}, {0, 0, -side}));
      queries.back()["wo"] = {0, 0, side};
    }
    scene.shapes.push_back(shape);
  }
  const Json answer = ask(scene, queries);
  const std::vector<double> expected{0.65, 0.65, 0.2, 0.2, 0.8, 0.2};
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(answer[i]["value"][0].get<double>(), expected[i] / pi, 1e-6) << i;
  EXPECT_NEAR(answer[2]["through"][0].get<double>(), 0.75, 1e-6);
  EXPECT_THAT(diagnostics_, IsEmpty());
}

TEST_F(MitsubaMaterial, MetalsByNameIndexAndReflectance) {
  const auto reflected = [&](const Metal& metal) {
    Material material;
    material.model = ConductorMaterial{metal, {}, Spectrum{ConstantSpectrum{1}}};
    Json query = ray("sampled", {0.2, 0.2, 3}, {0, 0, -1});
    query["u"] = 0.5;
    return ask(square_scene(material), Json::array({query})).at(0).at("weight");
  };
  const auto fresnel = [](double eta, double k) {
    return ((eta - 1) * (eta - 1) + k * k) / ((eta + 1) * (eta + 1) + k * k);
  };
  std::vector<double> copper;
  for (const double l : wavelengths_nm)
    copper.push_back(fresnel(evaluate(resolved(NamedSpectrum{"metal-Cu-eta"}), l),
                             evaluate(resolved(NamedSpectrum{"metal-Cu-k"}), l)));
  expect_near(reflected(ComplexIndex{}), copper, 2e-3, "Cu");
  const Spectrum gold = unbounded_from_rgb({0.2, 0.9, 1.4}), k = unbounded_from_rgb({3, 2.5, 1.9});
  std::vector<double> by_index;
  for (const double l : wavelengths_nm) by_index.push_back(fresnel(evaluate(gold, l), evaluate(k, l)));
  expect_near(reflected(ComplexIndex{gold, k}), by_index, 1e-4, "index");
  const Spectrum color = reflectance_from_rgb({0.9, 0.6, 0.3});
  expect_near(reflected(NormalReflectance{color}), values(color), 1e-4, "reflectance");
  expect_near(reflected(PerfectReflector{}), {1, 1, 1, 1}, 1e-6, "mirror");
}

// A thin sheet reflects and transmits about what it should.
TEST_F(MitsubaMaterial, DiffuseTransmission) {
  Material material;
  material.model =
      DiffuseTransmissionMaterial{Spectrum{ConstantSpectrum{0.3f}}, Spectrum{ConstantSpectrum{0.1f}}};
  Scene scene = square_scene(material);
  Json front = ray("bsdf", {0.2, 0.4, 3}, {0, 0, -1}), back = front;
  front["wo"] = {0.5, 0, std::sqrt(0.75)};
  back["wo"] = {0.5, 0, -std::sqrt(0.75)};
  const Json answer = ask(scene, {front, back});
  EXPECT_NEAR(answer[0]["value"][0].get<double>(), 0.3 / pi * std::sqrt(0.75), 0.05 * 0.3 / pi);
  EXPECT_NEAR(answer[1]["value"][0].get<double>(), 0.1 / pi * std::sqrt(0.75), 0.05 * 0.3 / pi);
}

// ---- Textures

class MitsubaTexture : public MitsubaMaterial {
 protected:
  // Red, green / blue, grey: the upper row first.
  std::string four_colors() {
    Image image = black_image(2, 2, 3);
    image.values = {0.8f, 0.1f, 0.1f, 0.1f, 0.8f, 0.1f, 0.1f, 0.1f, 0.8f, 0.5f, 0.5f, 0.5f};
    write_exr_image(folder_ / "four.exr", image);
    return (folder_ / "four.exr").string();
  }
  // The reflectance at 610, 530 and 440 nm over the square's four corners: lower left, lower right, upper
  // left, upper right.
  std::vector<std::array<double, 3>> corners(const Scene& scene) {
    Json queries = Json::array();
    for (const double y : {-0.9, 0.9})
      for (const double x : {-0.9, 0.9}) {
        queries.push_back(ray("bsdf", {x, y, 3}, {0, 0, -1}));
        queries.back()["wo"] = {0, 0, 1};
      }
    std::vector<std::array<double, 3>> result;
    for (const Json& answer : ask(scene, queries))
      result.push_back({answer["value"][2].get<double>() * pi, answer["value"][1].get<double>() * pi,
                        answer["value"][0].get<double>() * pi});
    return result;
  }
  static Scene textured(TextureModel model) {
    Material material;
    material.model = DiffuseMaterial{Id<Texture>{0}};
    Scene scene = square_scene(material);
    scene.textures.push_back({std::move(model), false, "colors", {}});
    return scene;
  }
};

char name_of(const std::array<double, 3>& color) {
  const auto [r, g, b] = color;
  if (r > 0.6) return 'r';
  if (g > 0.6) return 'g';
  if (b > 0.6) return 'b';
  return r > 0.4 ? 'w' : 'k';
}

std::string names_of(const std::vector<std::array<double, 3>>& colors) {
  std::string names;
  for (const auto& color : colors) names += name_of(color);
  return names;
}

TEST_F(MitsubaTexture, ImagesStandUpright) {
  ImageTexture image;
  image.filename = four_colors();
  image.filter = TextureFilter::nearest;
  EXPECT_EQ(names_of(corners(textured(image))), "bwrg");
  EXPECT_THAT(diagnostics_, IsEmpty());
  image.mapping = UvMapping{1, 0, 0.5f, 0, 1, 0};  // half a picture to the left
  EXPECT_EQ(names_of(corners(textured(image))), "wbgr");
  image.mapping = UvMapping{0, 1, 0, 1, 0, 0};  // s and t swapped
  EXPECT_EQ(names_of(corners(textured(image))), "brwg");
  image.mapping = UvMapping{1, 0, 0, 0, 0.5f, 0.5f};  // the upper half
  EXPECT_EQ(names_of(corners(textured(image))), "rgrg");
  image.wrap = Wrap::clamp;
  image.mapping = UvMapping{1, 0, 0, 0, 1, 3};
  EXPECT_EQ(names_of(corners(textured(image))), "rgrg");
}

TEST_F(MitsubaTexture, ScaledAndInvertedImages) {
  ImageTexture image;
  image.filename = four_colors();
  image.filter = TextureFilter::nearest;
  image.scale = 0.5f;
  image.invert = true;
  const auto found = corners(textured(image));
  EXPECT_NEAR(found[1][0], 0.75, 2e-3);
  EXPECT_NEAR(found[1][2], 0.75, 2e-3);
  EXPECT_THAT(diagnostics_, Contains(Field(&Diagnostic::message, HasSubstr("takes other values"))));
}

TEST_F(MitsubaTexture, Checkerboard) {
  CheckerboardTexture board;
  board.even = Spectrum{ConstantSpectrum{0.9f}};
  board.odd = Spectrum{ConstantSpectrum{0.1f}};
  board.mapping = UvMapping{2, 0, 0, 0, 2, 0};
  EXPECT_EQ(names_of(corners(textured(board))), "rkkr");
  board.mapping = UvMapping{2, 0, 1, 0, 2, 0};
  EXPECT_EQ(names_of(corners(textured(board))), "krrk");
}

TEST_F(MitsubaTexture, MeshAttributes) {
  Scene scene = textured(MeshAttributeTexture{"vertex_color", 0.5f});
  scene.meshes[0].attributes.push_back(
      {"vertex_color", false, 3, {0.8f, 0.2f, 0.2f, 0.8f, 0.2f, 0.2f, 0.8f, 0.2f, 0.2f, 0.8f, 0.2f, 0.2f}});
  const Spectrum color = reflectance_from_rgb({0.8, 0.2, 0.2});
  const auto found = corners(scene);
  EXPECT_NEAR(found[0][0], evaluate(color, 610) / 2, 2e-3);
  EXPECT_NEAR(found[3][1], evaluate(color, 530) / 2, 2e-3);
  scene.textures[0].model = MeshAttributeTexture{"face_tint", 1};
  scene.meshes[0].attributes = {{"face_tint", true, 1, {0.75f, 0.25f}}};
  EXPECT_NEAR(corners(scene)[1][1], 0.75, 2e-3);
  EXPECT_NEAR(corners(scene)[2][1], 0.25, 2e-3);
}

TEST_F(MitsubaTexture, FloatTexturesMasksBumpsAndNormals) {
  Image grey = black_image(2, 2, 1);
  grey.values = {0.25f, 0.25f, 0.25f, 0.75f};
  write_exr_image(folder_ / "grey.exr", grey);
  Scene scene = square_scene({});
  ImageTexture image;
  image.filename = (folder_ / "grey.exr").string();
  image.filter = TextureFilter::nearest;
  const auto height = add_to(scene.textures, Texture{image, true, "height", {}});
  image.filename = four_colors();
  image.filter = TextureFilter::bilinear;
  const auto normals = add_to(scene.textures, Texture{image, false, "normals", {}}),
             mean = add_to(scene.textures, Texture{image, true, "mean of a colour", {}});
  scene.materials[0].displacement = height;
  scene.materials[0].normal_map = normals;
  Material mask;
  mask.model = MaskMaterial{height, {0}};
  scene.shapes.push_back(scene.shapes[0]);
  scene.shapes[1].object_to_world = translate({0, 0, -5});
  scene.shapes[1].material = add_to(scene.materials, mask);
  Material rough;
  rough.model = ConductorMaterial{ComplexIndex{}, {mean, mean}, Spectrum{ConstantSpectrum{1}}};
  scene.shapes.push_back(scene.shapes[0]);
  scene.shapes[2].material = add_to(scene.materials, rough);
  Json query = ray("bsdf", {0.9, -0.9, -4}, {0, 0, -1});
  query["wo"] = {0, 0, 1};
  EXPECT_NEAR(ask(scene, Json::array({query})).at(0)["through"][0].get<double>(), 0.25, 1e-4);
  query = ray("bsdf", {0.9, -0.9, 3}, {0, 0, -1});
  query["wo"] = {0, 0, 1};
  ask(scene, Json::array({query}), "scalar_rgb");
}

// Mitsuba's plastic asks its texture for its mean, which attributes of meshes do not have.
TEST_F(MitsubaOracle, PlasticWithoutAttributes) {
  Scene scene = square_scene({PlasticMaterial{Id<Texture>{0}}});
  scene.textures.push_back({MeshAttributeTexture{"vertex_color"}, false, "", {}});
  scene.meshes[0].attributes.push_back({"vertex_color", false, 3, std::vector<float>(12, 0.5f)});
  ask(scene, Json::array());
  EXPECT_THAT(diagnostics_, Contains(Field(&Diagnostic::message, HasSubstr("an attribute of a mesh"))));
}

}  // namespace
}  // namespace vitrail::mitsuba_materials_test
