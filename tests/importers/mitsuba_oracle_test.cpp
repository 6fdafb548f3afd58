// SPDX-License-Identifier: Apache-2.0
// What the writer says, asked back from Mitsuba 3: cameras, sides, materials, textures, media, instances.
#include "tests/importers/mitsuba_oracle.h"

#include <cmath>
#include <numbers>

#include "importers/images/image_files.h"

namespace vitrail {
namespace {

constexpr double pi = std::numbers::pi;
using testing::Contains;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;

// ---- Cameras

struct Ray {
  Point3d o;
  Vector3d d;
};

// The Scene's ray through (x,y) in [0,1]² of the cropped picture.
Ray expected_ray(const Scene& scene, double x, double y) {
  const FilmSettings& film = scene.film;
  const double u = (film.crop.x0 + x * (film.crop.x1 - film.crop.x0)) / film.width,
               v = (film.crop.y0 + y * (film.crop.y1 - film.crop.y0)) / film.height;
  const auto on_screen = [&](const ScreenWindow& s) {
    return Point3d{s.x0 + u * (s.x1 - s.x0), s.y1 - v * (s.y1 - s.y0), 0};
  };
  if (const auto* camera = std::get_if<OrthographicCamera>(&scene.camera))
    return {transform_point(camera->camera_to_world, on_screen(camera->screen)),
            normalize(transform_vector(camera->camera_to_world, {0, 0, 1}))};
  const auto& camera = std::get<PerspectiveCamera>(scene.camera);
  const Point3d p = on_screen(camera.screen);
  return {transform_point(camera.camera_to_world, {0, 0, 0}),
          normalize(transform_vector(camera.camera_to_world, {p.x, p.y, 1}))};
}

class MitsubaCamera : public MitsubaOracle {
 protected:
  void expect_rays(const Scene& scene) {
    const std::vector<std::array<double, 2>> points{{0, 0}, {1, 0}, {0.25, 0.75}, {1, 1}};
    const Json answer = ask(scene, {{{"op", "camera"}, {"points", points}}}).at(0);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Ray ray = expected_ray(scene, points[i][0], points[i][1]);
      expect_near(answer.at(i).at("d"), {ray.d.x, ray.d.y, ray.d.z}, 1e-5, "direction");
      const auto& o = answer.at(i).at("o");  // moved to the near plane
      const Vector3d along{o[0].get<double>() - ray.o.x, o[1].get<double>() - ray.o.y,
                           o[2].get<double>() - ray.o.z};
      EXPECT_LT(length(cross(along, ray.d)), 1e-5) << "origin of ray " << i;
    }
  }
};

TEST_F(MitsubaCamera, Perspective) {
  Scene scene = square_scene({});
  std::get<PerspectiveCamera>(scene.camera).camera_to_world = look_at({3, 2, 5}, {0.5, 0, 0}, {0, 1, 0.2});
  expect_rays(scene);
  EXPECT_THAT(diagnostics_, IsEmpty());
}

TEST_F(MitsubaCamera, OffCentreWindowAndCrop) {
  Scene scene = square_scene({});
  std::get<PerspectiveCamera>(scene.camera).screen = {-0.3, 0.7, -0.4, 0.1};
  scene.film.crop = {2, 6, 1, 3};
  expect_rays(scene);
  EXPECT_THAT(diagnostics_, IsEmpty());
}

TEST_F(MitsubaCamera, TallPictureWithTheAngleOnItsWidth) {
  Scene scene = square_scene({});
  scene.film.width = 3, scene.film.height = 7, scene.film.crop = {0, 3, 0, 7};
  const double x = std::tan(20 * pi / 180);
  std::get<PerspectiveCamera>(scene.camera).screen = {-x, x, -x * 7 / 3, x * 7 / 3};
  expect_rays(scene);
  EXPECT_THAT(text(), HasSubstr(R"(name="fov" value="40")"));
}

TEST_F(MitsubaCamera, ScaledAndMirrored) {
  Scene scene = square_scene({});
  auto& camera = std::get<PerspectiveCamera>(scene.camera);
  camera.camera_to_world = camera.camera_to_world * scale({-2, 2, 4});
  expect_rays(scene);
}

TEST_F(MitsubaCamera, Orthographic) {
  Scene scene = square_scene({});
  scene.camera = OrthographicCamera{look_at({3, 2, 5}, {0.5, 0, 0}, {0, 1, 0.2}), {-1, 1, -0.5, 0.5}, {}};
  expect_rays(scene);
  EXPECT_THAT(diagnostics_, IsEmpty());
}

TEST_F(MitsubaCamera, OrthographicWithAnyWindow) {
  Scene scene = square_scene({});
  scene.camera = OrthographicCamera{look_at({3, 2, 5}, {0.5, 0, 0}, {0, 1, 0.2}), {-2, 5, -1, 0.5}, {}};
  expect_rays(scene);
}

TEST_F(MitsubaCamera, ThinLens) {
  Scene scene = square_scene({});
  auto& camera = std::get<PerspectiveCamera>(scene.camera);
  camera.lens = {0.25, 4};
  const Json points{{0.25, 0.25}};
  const Json answer = ask(scene, {{{"op", "camera"}, {"points", points}, {"aperture", {0.5, 0.5}}},
                                  {{"op", "camera"}, {"points", points}, {"aperture", {0.9, 0.3}}}});
  const Ray centre = expected_ray(scene, 0.25, 0.25);
  const double t = 4 / -centre.d.z;  // both rays meet in the plane of focus
  for (const Json& found : answer) {
    const auto &o = found[0].at("o"), &d = found[0].at("d");
    const double s = (1 - o[2].get<double>()) / d[2].get<double>();
    EXPECT_NEAR(o[0].get<double>() + s * d[0].get<double>(), centre.o.x + t * centre.d.x, 1e-4);
    EXPECT_NEAR(o[1].get<double>() + s * d[1].get<double>(), centre.o.y + t * centre.d.y, 1e-4);
  }
  EXPECT_GT(std::abs(answer[1][0]["o"][0].get<double>() - answer[0][0]["o"][0].get<double>()), 0.05);
}

TEST_F(MitsubaCamera, NothingNearOrFarIsCutAway) {
  Scene scene = square_scene({});
  scene.shapes[0].object_to_world = translate({0, 0, -1e6}) * scale({1e6, 1e6, 1});
  const Json answer =
      ask(scene, {{{"op", "camera"}, {"points", {{0.5, 0.5}}}}, ray("hit", {0, 0, 5}, {0, 0, -1})});
  EXPECT_LT(5 - answer[0][0]["o"][2].get<double>(), 0.1);
  EXPECT_NE(text().find(R"(name="far_clip" value="10000000")"), std::string::npos) << text();
}

TEST_F(MitsubaOracle, FilmAndIntegrator) {
  Scene scene = square_scene({});
  scene.film.crop = {2, 6, 1, 3};
  scene.film.filter = GaussianFilter{1.6, 1.6, 0.4};
  scene.settings = {77, 9, false};
  const Json film = ask(scene, {{{"op", "film"}}}).at(0);
  expect_near(film.at("size"), {8, 4}, 0);
  expect_near(film.at("crop_offset"), {2, 1}, 0);
  expect_near(film.at("crop_size"), {4, 2}, 0);
  EXPECT_THAT(film.at("filter").get<std::string>(), HasSubstr("stddev=0.40, radius=1.60"));
  EXPECT_EQ(film.at("samples"), 77);
  EXPECT_THAT(film.at("integrator").get<std::string>(), HasSubstr("max_depth = 10"));
  for (const Filter& filter : {Filter{BoxFilter{}}, Filter{TriangleFilter{1.5, 1.5}},
                               Filter{MitchellFilter{}}, Filter{SincFilter{3, 3, 3}}}) {
    scene.film.filter = filter;
    scene.settings.direct_only = true;
    ask(scene, Json::array());
  }
}

// ---- Geometry and sides

TEST_F(MitsubaOracle, FrontsOfAllKindsOfMesh) {
  Scene scene = empty_scene();
  const auto plain = add_to(scene.meshes, square_mesh()), smooth = add_to(scene.meshes, square_mesh(true));
  Material one_sided;
  one_sided.two_sided = false;
  const auto material = add_to(scene.materials, one_sided);
  const auto light = add_to(scene.area_lights, AreaLight{Spectrum{ConstantSpectrum{2}}});
  std::vector<double> fronts;  // +1 where the front faces +z
  Json queries = Json::array();
  for (const auto mesh : {plain, smooth})
    for (const double mirror : {1.0, -1.0})
      for (const bool flip : {false, true}) {
        const double x = 10.0 * static_cast<double>(fronts.size());
        scene.shapes.push_back(
            {mesh, material, light, translate({x, 0, 0}) * vitrail::scale({mirror, 1, 1}), flip});
        fronts.push_back((mirror > 0) != flip ? 1 : -1);
        for (const double side : {1.0, -1.0}) {
          queries.push_back(ray("hit", {x + 0.5, 0.25, side * 3}, {0, 0, -side}));
          queries.push_back(ray("bsdf", {x + 0.5, 0.25, side * 3}, {0, 0, -side}));
          queries.back()["wo"] = {0, 0, side};
        }
      }
  const Json answer = ask(scene, queries);
  for (std::size_t i = 0; i < fronts.size(); ++i)
    for (std::size_t side = 0; side < 2; ++side) {
      const Json &hit = answer.at(4 * i + 2 * side), &bsdf = answer.at(4 * i + 2 * side + 1);
      const bool front = (fronts[i] > 0) == (side == 0);
      EXPECT_NEAR(hit["n"][2].get<double>(), fronts[i], 1e-6) << i;
      EXPECT_NEAR(hit["shading_n"][2].get<double>(), fronts[i], 1e-6) << i;
      EXPECT_NEAR(hit["emission"][0].get<double>(), front ? 2 : 0, 1e-6) << i;
      EXPECT_NEAR(bsdf["value"][0].get<double>(), front ? 0.5 / pi : 0, 1e-6) << i;
    }
}

TEST_F(MitsubaOracle, GlassHasItsIndexBehindTheFront) {
  Material glass;
  glass.model = DielectricMaterial{};
  Scene scene = square_scene(glass, true);
  for (const bool mirrored : {false, true}) {
    scene.shapes[0].object_to_world = vitrail::scale({mirrored ? -1.0 : 1.0, 1, 1});
    scene.shapes[0].flip_orientation = mirrored;
    Json from_front = ray("sampled", {0.1, 0.2, 3}, {0, 0, -1}),
         from_behind = ray("sampled", {0.1, 0.2, -3}, {0, 0, 1});
    from_front["u"] = from_behind["u"] = 0.9;  // refracted
    const Json answer = ask(scene, {from_front, from_behind});
    EXPECT_NEAR(answer[0]["eta"].get<double>(), 1.5, 1e-6);
    EXPECT_NEAR(answer[1]["eta"].get<double>(), 1 / 1.5, 1e-6);
  }
}

TEST_F(MitsubaOracle, TransformsAndNames) {
  Scene scene = square_scene({});
  scene.shapes[0].name = "a <\"strange\"> & näme";
  scene.shapes[0].object_to_world =
      translate({1, 2, 3}) * rotate(pi / 2, {0, 1, 0}) * vitrail::scale({2, 3, 1});
  const Json box = ask(scene, {{{"op", "shapes"}}}).at(0).at(0);
  EXPECT_EQ(box["id"], scene.shapes[0].name);
  expect_near(box["min"], {1, -1, 1}, 1e-6);
  expect_near(box["max"], {1, 5, 5}, 1e-6);
}

TEST_F(MitsubaOracle, InstancesAndTheirLights) {
  Scene scene = square_scene({});
  const auto light = add_to(scene.area_lights, AreaLight{Spectrum{ConstantSpectrum{3}}});
  Shape shape = scene.shapes[0];
  shape.object_to_world = translate({0, 0, 1});
  Shape shining = shape;
  shining.area_light = light;
  shining.object_to_world = translate({0, 0, 2});
  scene.shapes.clear();
  const auto group = add_to(scene.prototypes, Prototype{"group", {shape, shining}, {}});
  scene.instances.push_back({group, translate({10, 0, 0}), {}});
  scene.instances.push_back({group, translate({20, 0, 0}) * vitrail::scale({-1, 1, 1}), {}});
  const Json answer =
      ask(scene, {ray("hit", {10.3, 0.2, 9}, {0, 0, -1}), ray("hit", {20.3, 0.2, 9}, {0, 0, -1}),
                  ray("hit", {20.3, 0.2, -9}, {0, 0, 1})});
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(answer[i]["p"][2].get<double>(), 2, 1e-5);
    EXPECT_NEAR(answer[i]["emission"][0].get<double>(), 3, 1e-5);
  }
  EXPECT_NEAR(answer[2]["p"][2].get<double>(), 1, 1e-5);
  EXPECT_THAT(diagnostics_, Contains(Field(&Diagnostic::message, HasSubstr("instances no area lights"))));
}

TEST_F(MitsubaOracle, TwoSidedEmission) {
  for (const bool flip : {false, true}) {
    Scene scene = square_scene({}, flip);
    scene.shapes[0].area_light = add_to(scene.area_lights, AreaLight{Spectrum{ConstantSpectrum{3}}, 1, true});
    scene.shapes[0].flip_orientation = flip;
    scene.shapes[0].object_to_world = vitrail::scale({flip ? -1.0 : 1.0, 1, 1});
    const Json answer =
        ask(scene, {ray("hit", {0.3, 0.2, 9}, {0, 0, -1}), ray("hit", {0.3, 0.2, -9}, {0, 0, 1})});
    for (const Json& side : answer) EXPECT_NEAR(side["emission"][0].get<double>(), 3, 1e-5);
  }
}

// ---- Materials

// Every model, with both ways to give its parameters.
std::vector<MaterialModel> all_models() {
  const Roughness rough{0.2f, 0.3f, Roughness::Distribution::beckmann}, round{0.25f, 0.25f};
  const Spectrum glass = NamedSpectrum{"glass-BK7"}, color = unbounded_from_rgb({2, 1, 0.5});
  HairMaterial hair, absorbing, colored;
  hair.eumelanin = 1.0f;
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
  EXPECT_THAT(diagnostics_, Contains(Field(&Diagnostic::message, HasSubstr("cannot decode"))));
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

// ---- Media

TEST_F(MitsubaOracle, HomogeneousMedia) {
  Scene scene = square_scene({});
  scene.materials[0].model = InterfaceMaterial{};
  Medium medium;
  const Spectrum absorption = unbounded_from_rgb({0.5, 1, 2}), scattering = ConstantSpectrum{3};
  medium.coefficients = AbsorptionScattering{absorption, scattering};
  medium.scale = 2;
  medium.g = 0.5f;
  medium.name = "fog";
  scene.shapes[0].interior = add_to(scene.media, medium);
  scene.camera_medium = Id<Medium>{0};
  const Json answer =
      ask(scene, {{{"op", "medium"}, {"index", 0}, {"p", {0, 0, 0}}, {"wavelengths", wavelengths_nm}},
                  ray("hit", {0.3, 0.2, 3}, {0, 0, -1})});
  std::vector<double> extinction;
  for (const double a : values(absorption)) extinction.push_back(2 * (a + 3));
  expect_near(answer[0]["sigma_t"], extinction, 1e-4);
  expect_near(answer[0]["sigma_s"], {6, 6, 6, 6}, 1e-3);
  EXPECT_NEAR(answer[0]["forward"][0].get<double>(), 0.75 / (4 * pi * 0.125), 1e-4);  // (1−g²)/(4π(1−g)³)
  EXPECT_EQ(answer[1]["interior"], "fog");
  EXPECT_EQ(answer[1]["exterior"], "");
}

TEST_F(MitsubaOracle, GridsOfDensity) {
  Scene scene = square_scene({});
  Grid grid;
  grid.nx = 2, grid.ny = 1, grid.nz = 1;
  grid.values = {1, 3};
  grid.bounds = {{0, 0, 0}, {4, 1, 1}};
  Medium medium;
  medium.coefficients =
      AbsorptionScattering{Spectrum{ConstantSpectrum{0.5f}}, Spectrum{ConstantSpectrum{1.5f}}};
  medium.density = grid;
  medium.medium_to_world = translate({10, 0, 0});
  scene.shapes[0].interior = add_to(scene.media, medium);
  const auto at = [](double x) {
    return Json{{"op", "medium"}, {"index", 0}, {"p", {x, 0.5, 0.5}}, {"wavelengths", wavelengths_nm}};
  };
  const Json answer = ask(scene, {at(10.5), at(12), at(13.5)});
  EXPECT_NEAR(answer[0]["sigma_t"][0].get<double>(), 2, 1e-4);
  EXPECT_NEAR(answer[1]["sigma_t"][0].get<double>(), 4, 1e-4);
  EXPECT_NEAR(answer[2]["sigma_t"][0].get<double>(), 6, 1e-4);
  EXPECT_NEAR(answer[1]["sigma_s"][0].get<double>(), 3, 1e-4);
}

}  // namespace
}  // namespace vitrail
