// SPDX-License-Identifier: Apache-2.0
// Lights as Mitsuba 3 sees what the writer says of them, and pictures of them against radiance in closed
// form.
#include <cmath>

#include "images/image_files.h"
#include "importers/images/environment_images.h"
#include "scene/geometry/pi.h"
#include "scene/spectra/color.h"
#include "scene/spectra/flat_emission.h"
#include "tests/importers/mitsuba/mitsuba_oracle.h"

namespace vitrail::mitsuba_lights_test {
namespace {

using testing::Contains;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;

class MitsubaLight : public MitsubaOracle {
 protected:
  static Scene lit(LightModel model) {
    Scene scene = square_scene({});
    scene.lights.push_back({std::move(model), {}});
    return scene;
  }
  Json seen_from(const Scene& scene, std::array<double, 3> point) {
    return ask(scene, {{{"op", "light"}, {"index", 0}, {"p", point}, {"wavelengths", wavelengths_nm}}}).at(0);
  }
  Json environment(const Scene& scene, const std::vector<Vector3d>& directions) {
    Json queries = Json::array();
    for (const Vector3d d : directions)
      queries.push_back({{"op", "environment"}, {"d", {d.x, d.y, d.z}}, {"wavelengths", wavelengths_nm}});
    return ask(scene, queries);
  }
};

TEST_F(MitsubaLight, EveryKindOfSpectrum) {
  const std::vector<std::pair<Spectrum, bool>> spectra{
      {ConstantSpectrum{2}, true},
      {emission_from_rgb({3, 1, 0.5}), true},
      {emission_from_rgb({1, 1, 1}), true},
      {tabulate({{400, 1}, {500, 7}, {700, 3}}, false), true},
      {TabulatedSpectrum{std::vector<float>(table_size, 0.25f)}, true},
      {TabulatedSpectrum{std::vector<float>(table_size, 0.0f)}, true},
      {NamedSpectrum{"stdillum-D65"}, true},
      {NamedSpectrum{"stdillum-A"}, true},
      {BlackbodySpectrum{5000, 12}, true},
      {reflectance_from_rgb({0.9, 0.2, 0.1}), true},
      {unbounded_from_rgb({5, 2, 1}), true},
  };
  for (const auto& [spectrum, exact] : spectra)
    expect_near(environment(lit(InfiniteLight{spectrum}), {{0, 0, 1}}).at(0), values(spectrum), 1e-2,
                "spectrum " + std::to_string(spectrum.index()));
}

// At 5000 K, by Planck's law, W·m⁻²·sr⁻¹·nm⁻¹.
TEST_F(MitsubaLight, ARealBlackbodyIsWrittenAsOne) {
  std::vector<float> planck;
  for (int i = 0; i < table_size; ++i) {
    const double m = (lambda_min_nm + i) * 1e-9;
    planck.push_back(static_cast<float>(2e-9 * 6.62607015e-34 * std::pow(2.99792458e8, 2) / std::pow(m, 5) /
                                        std::expm1(1.438776877e-2 / (m * 5000))));
  }
  const BlackbodySpectrum spectrum{5000, static_cast<float>(luminance(TabulatedSpectrum{planck}))};
  expect_near(environment(lit(InfiniteLight{spectrum}), {{0, 0, 1}}).at(0), values(spectrum), 1e-3);
  EXPECT_THAT(text(), HasSubstr("blackbody"));
}

TEST_F(MitsubaLight, Point) {
  const Spectrum color = emission_from_rgb({3, 2, 1});
  const Json found = seen_from(lit(PointLight{{1, 2, 3}, color}), {1, 2, 1});
  expect_near(found["d"], {0, 0, 1}, 1e-6);
  expect_near(found["weight"], values(color, 0.25), 2e-3);
  EXPECT_THAT(diagnostics_, IsEmpty());
}

TEST_F(MitsubaLight, Distant) {
  const Spectrum color = emission_from_rgb({3, 2, 1});
  const Json found = seen_from(lit(DistantLight{normalize(Vector3d{1, -2, -2}), color}), {0.1, 0.2, 0.3});
  expect_near(found["d"], {-1.0 / 3, 2.0 / 3, 2.0 / 3}, 1e-5);
  expect_near(found["weight"], values(color), 2e-3);
}

TEST_F(MitsubaLight, Spot) {
  SpotLight spot;
  spot.light_to_world = look_at({0, 0, 2}, {0, 0, 0}, {0, 1, 0});
  spot.intensity = ConstantSpectrum{4};
  spot.beam_deg = 20, spot.cutoff_deg = 40, spot.falloff = SpotLight::Falloff::linear;
  const auto weight = [&](double angle_deg) {
    return seen_from(lit(spot), {2 * std::tan(angle_deg * pi / 180), 0, 0})["weight"][0].get<double>() /
           std::pow(std::cos(angle_deg * pi / 180), 2);
  };
  EXPECT_NEAR(weight(10), 1, 1e-4);
  EXPECT_NEAR(weight(30), 0.5, 1e-4);
  EXPECT_NEAR(weight(41), 0, 1e-6);
  EXPECT_THAT(diagnostics_, IsEmpty());
  spot.falloff = SpotLight::Falloff::smoothstep;
  EXPECT_NEAR(weight(10), 1, 1e-4);
  EXPECT_THAT(diagnostics_, Contains(Field(&Diagnostic::message, HasSubstr("linearly"))));
}

// An image with a colour of its own for each direction.
Image sky(EnvironmentProjection projection, int height) {
  Image image = black_image(projection == EnvironmentProjection::equal_area ? height : 2 * height, height, 3);
  for (std::size_t pixel = 0; pixel < image.pixels(); ++pixel) {
    const auto width = static_cast<std::size_t>(image.width);
    const Vector3d d = direction_of(projection, {(static_cast<double>(pixel % width) + 0.5) / image.width,
                                                 (static_cast<double>(pixel / width) + 0.5) / height});
    image.values[3 * pixel] = static_cast<float>(1 + d.x / 2);
    image.values[3 * pixel + 1] = static_cast<float>(1 + d.y / 2);
    image.values[3 * pixel + 2] = static_cast<float>(1 + d.z / 2);
  }
  return image;
}

TEST_F(MitsubaLight, EnvironmentMapsInEveryFrame) {
  const std::vector<Vector3d> directions{{1, 0, 0},
                                         {0, 1, 0},
                                         {0, 0, 1},
                                         {-1, 0, 0},
                                         {0, -1, 0},
                                         {0, 0, -1},
                                         normalize(Vector3d{1, 2, 3}),
                                         normalize(Vector3d{-3, 1, -2})};
  for (const auto projection :
       {EnvironmentProjection::equal_area, EnvironmentProjection::latitude_longitude}) {
    write_exr_image(folder_ / "sky.exr", sky(projection, 128));
    for (const Transform& to_world :
         {Transform{}, rotate(0.7, {1, 2, 3}), rotate(1.3, {0, 1, 0}) * scale({1, -1, 1})}) {
      EnvironmentLight light;
      light.filename = (folder_ / "sky.exr").string();
      light.light_to_world = to_world;
      light.projection = projection;
      light.scale = ConstantSpectrum{2};
      const Json found = environment(lit(light), directions);
      for (std::size_t i = 0; i < directions.size(); ++i) {
        const Vector3d local = transform_vector(inverse(to_world), directions[i]);
        expect_near(found[i], values(emission_from_rgb({2 + local.x, 2 + local.y, 2 + local.z})), 0.03,
                    "direction " + std::to_string(i));
      }
    }
  }
}

TEST_F(MitsubaLight, IlluminanceAndColourOfEnvironments) {
  Image grey = black_image(32, 16, 3);
  std::fill(grey.values.begin(), grey.values.end(), 0.5f);
  write_exr_image(folder_ / "sky.exr", grey);
  EnvironmentLight light;
  light.filename = (folder_ / "sky.exr").string();
  light.projection = EnvironmentProjection::latitude_longitude;
  light.illuminance = 3.0f;
  expect_near(environment(lit(light), {{0, 0, 1}}).at(0), values(emission_from_rgb({3 / pi, 3 / pi, 3 / pi})),
              5e-3);
  light.illuminance.reset();
  light.scale = unbounded_from_rgb({2, 1, 0.5});
  expect_near(environment(lit(light), {{0, 0, 1}}).at(0), values(emission_from_rgb({1, 0.5, 0.25})), 5e-3);
}

// Mitsuba's own sky is black below the horizon. E/π is the mean over directions of equal cos θ dω.
TEST_F(MitsubaLight, GroundsBelowTheSkyReflectIt) {
  SkyLight light;
  light.light_to_world = rotate(0.7, {1, 2, 3});
  light.to_sun = normalize(Vector3d{2, 0, 1});
  light.sun_scale = 0;
  light.ground = 0.3f;
  constexpr int rings = 16, sectors = 32;
  std::vector<Vector3d> directions;
  const auto add = [&](const Vector3d& d) {
    directions.push_back(transform_vector(light.light_to_world, d));
  };
  for (int ring = 0; ring < rings; ++ring)
    for (int sector = 0; sector < sectors; ++sector) {
      const double sin2 = (ring + 0.5) / rings, phi = 2 * pi * (sector + 0.5) / sectors;
      add({std::sqrt(sin2) * std::cos(phi), std::sqrt(sin2) * std::sin(phi), std::sqrt(1 - sin2)});
    }
  add({0, 0, -1});
  add(normalize(Vector3d{3, -1, -2}));
  const Json found = environment(lit(light), directions);
  std::vector<double> reflected(wavelengths_nm.size());
  for (std::size_t i = 0; i + 2 < directions.size(); ++i)
    for (std::size_t c = 0; c < reflected.size(); ++c)
      reflected[c] += 0.3 * found[i][c].get<double>() / (rings * sectors);
  EXPECT_GT(reflected[1], 0);
  expect_near(found[directions.size() - 2], reflected, 0.02, "below");
  expect_near(found[directions.size() - 1], reflected, 0.02, "aslant");
  EXPECT_THAT(diagnostics_, Contains(Field(&Diagnostic::message, HasSubstr("without a ground"))));
}

TEST_F(MitsubaLight, TexturedEmissionIsUnderD65) {
  Image image = black_image(2, 2, 3);
  image.values = {0.8f, 0.1f, 0.1f, 0.1f, 0.8f, 0.1f, 0.1f, 0.1f, 0.8f, 0.5f, 0.5f, 0.5f};
  write_exr_image(folder_ / "four.exr", image);
  Scene scene = square_scene({});
  ImageTexture texture;
  texture.filename = (folder_ / "four.exr").string();
  texture.filter = TextureFilter::nearest;
  scene.shapes[0].area_light =
      add_to(scene.area_lights, AreaLight{add_to(scene.textures, Texture{texture, false, "", {}}), 3});
  const Json found = ask(
      scene, Json::array({ray("hit", {-0.9, 0.9, 3}, {0, 0, -1}), ray("hit", {0.9, -0.9, 3}, {0, 0, -1})}));
  // Of a colour above 1, 2.4 .3 .3, a grid has the spectrum of half of it ÷ its greatest number.
  const Spectrum red = reflectance_from_rgb({0.8, 0.1, 0.1}),
                 dim = reflectance_from_rgb({0.5, 0.0625, 0.0625}),
                 white = emission_from_rgb({4.8, 4.8, 4.8});
  std::vector<double> red_light = values(dim);
  for (std::size_t i = 0; i < red_light.size(); ++i) red_light[i] *= values(white)[i];
  expect_near(found[0]["emission"], red_light, 1e-2);
  expect_near(found[1]["emission"], values(emission_from_rgb({3, 3, 3}), 0.5), 5e-3);
  // Times the inverse of D65 it is what Mitsuba shows of an image by itself: flat where it is grey.
  const Id<Texture> bright = std::get<Id<Texture>>(scene.area_lights[0].radiance);
  scene.area_lights[0] = {
      add_to(scene.textures, Texture{ProductTexture{bright, inverse_d65()}, false, "", {}})};
  const Json flat = ask(
      scene, Json::array({ray("hit", {-0.9, 0.9, 3}, {0, 0, -1}), ray("hit", {0.9, -0.9, 3}, {0, 0, -1})}));
  expect_near(flat[0]["emission"], values(red), 1e-2);
  expect_near(flat[1]["emission"], values(ConstantSpectrum{0.5f}), 5e-3);
}

// The image's upper right quarter is red, its lower left one blue.
TEST_F(MitsubaLight, ProjectorsStandUpright) {
  Image image = black_image(2, 2, 3);
  image.values = {0.1f, 0.1f, 0.1f, 0.8f, 0.1f, 0.1f, 0.1f, 0.1f, 0.8f, 0.1f, 0.1f, 0.1f};
  write_exr_image(folder_ / "four.exr", image);
  ImageTexture texture;
  texture.filename = (folder_ / "four.exr").string();
  texture.filter = TextureFilter::nearest;
  texture.mapping = UvMapping{1, 0, 0, 0, -1, 1};  // v runs down
  ProjectionLight light;
  light.light_to_world = look_at({0, 0, 2}, {0, 0, 0}, {0, 1, 0});
  light.image = Id<Texture>{0};
  light.irradiance = true;
  Scene scene = lit(light);
  scene.textures.push_back({texture, false, "", {}});
  const Transform& m = light.light_to_world;
  const auto weight = [&](Vector3d local) {
    const Point3d p = transform_point(m, {local.x, local.y, local.z});
    return seen_from(scene, {p.x, p.y, p.z})["weight"];
  };
  const Json red = weight({0.5, 0.5, 1}), blue = weight({-0.5, -0.5, 1});
  EXPECT_GT(red[3].get<double>(), 3 * red[0].get<double>());
  EXPECT_GT(blue[0].get<double>(), 3 * blue[3].get<double>());
  const Json dark = weight({-0.5, 0.5, 1});  // π·image/cosθ, under D65
  expect_near(dark, values(emission_from_rgb({0.1, 0.1, 0.1}), pi * std::sqrt(1.5)), 5e-3);
}

// The light of all projectors is the map's in that direction, also beside the cube's edges; 5 lm/4π on the
// mean.
TEST_F(MitsubaLight, AGoniometricLightIsACubeOfProjectors) {
  const auto value = [](Vector3d map) { return 1 + 0.6 * map.x + 0.3 * map.y * map.z; };  // mean 1
  Image map = black_image(256, 128, 1);
  constexpr auto projection = EnvironmentProjection::latitude_longitude;
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x)
      map.values[static_cast<std::size_t>(y * map.width + x)] =
          static_cast<float>(value(direction_of(projection, pixel_point(projection, 256, 128, x, y))));
  write_exr_image(folder_ / "map.exr", map);
  GoniometricLight light;
  light.light_to_world = translate({0.5, 1, 2}) * rotate(1, {1, 2, 3});
  light.filename = (folder_ / "map.exr").string();
  light.latitude_longitude = true;
  light.power = 5;
  light.intensity = emission_from_rgb({0.8, 0.8, 0.8});
  const double mean = 5 / (4 * pi);
  for (const Vector3d d : {Vector3d{0, 0, 1}, Vector3d{0.3, -1, 0.2}, Vector3d{1, 0.98, 0.2},
                           Vector3d{-1, 0.1, 0.97}, Vector3d{-0.2, 0.3, -1}, Vector3d{0.1, 1, -0.9}}) {
    const Point3d p = transform_point(light.light_to_world, {d.x, d.y, d.z});
    Json queries = Json::array();
    for (int i = 0; i < 6; ++i)
      queries.push_back(
          {{"op", "light"}, {"index", i}, {"p", {p.x, p.y, p.z}}, {"wavelengths", wavelengths_nm}});
    std::vector<double> sum(4);
    for (const Json& one : ask(lit(light), queries))
      for (std::size_t c = 0; c < 4; ++c) sum[c] += one["weight"][c].get<double>();
    const Vector3d way = normalize(d);
    expect_near(sum, values(light.intensity, mean * value({way.x, way.z, way.y}) / dot(d, d)), 1e-2);
  }
}

// Mitsuba takes one light from all around.
TEST_F(MitsubaLight, SeveralFromAllAroundBecomeOne) {
  Scene scene = lit(InfiniteLight{emission_from_rgb({0.6, 0.3, 0.2})});
  scene.lights.push_back({InfiniteLight{tabulate({{400, 1}, {700, 2}}, true)}, {}});
  std::vector<double> both = values(emission_from_rgb({0.6, 0.3, 0.2}));
  for (std::size_t i = 0; i < both.size(); ++i) both[i] += values(tabulate({{400, 1}, {700, 2}}, true))[i];
  expect_near(environment(scene, {{0, 0, 1}}).at(0), both, 1e-2);
  EXPECT_THAT(diagnostics_, IsEmpty());

  write_exr_image(folder_ / "square.exr", sky(EnvironmentProjection::equal_area, 64));
  EnvironmentLight image;
  image.filename = (folder_ / "square.exr").string();
  image.light_to_world = rotate(0.7, {1, 2, 3});
  const std::vector<Vector3d> directions{{0, 0, 1}, {0.6, 0, -0.8}, {0, -1, 0}, {-0.8, 0.6, 0}};
  const Json alone = environment(lit(image), directions);
  scene = lit(image);
  scene.lights.push_back({InfiniteLight{emission_from_rgb({0.5, 0.5, 0.5})}, {}});
  const Json joined = environment(scene, directions);
  EXPECT_THAT(diagnostics_, Contains(Field(&Diagnostic::message, HasSubstr("one light from all around"))));
  for (std::size_t i = 0; i < directions.size(); ++i) {
    std::vector<double> expected = values(emission_from_rgb({0.5, 0.5, 0.5}));
    for (std::size_t c = 0; c < expected.size(); ++c) expected[c] += alone[i][c].get<double>();
    expect_near(joined[i], expected, 0.15);  // a spectrum for the sum of two colours is not the sum of theirs
  }
}

// ---- Pictures

class MitsubaPicture : public MitsubaLight {
 protected:
  // The mean colour of a large white square (reflectance ½) that fills the picture, from straight above.
  void expect_radiance(Scene scene, const std::vector<double>& expected, int samples = 256) {
    scene.shapes[0].object_to_world = scale({0.05, 0.05, 1});
    scene.film.filter = BoxFilter{};
    auto& camera = std::get<PerspectiveCamera>(scene.camera);
    camera.screen = {-0.002, 0.002, -0.001, 0.001};
    scene.settings.max_depth = 1;
    const Json found = ask(scene, {{{"op", "render"}, {"spp", samples}}}).at(0).at("mean");
    expect_near(found, expected, 0.01);
  }
};

TEST_F(MitsubaPicture, PointLight) {
  const double e = 0.5 / pi / 4;
  expect_radiance(lit(PointLight{{0, 0, 2}, emission_from_rgb({3, 2, 1})}), {3 * e, 2 * e, e});
}

TEST_F(MitsubaPicture, DistantLight) {
  const double e = 0.5 / pi * std::cos(0.5);
  expect_radiance(lit(DistantLight{{std::sin(0.5), 0, -std::cos(0.5)}, emission_from_rgb({3, 2, 1})}),
                  {3 * e, 2 * e, e});
}

TEST_F(MitsubaPicture, ConstantLight) {
  expect_radiance(lit(InfiniteLight{emission_from_rgb({3, 2, 1})}), {1.5, 1, 0.5}, 2048);
}

// A flat spectrum of radiance 1 has the colour of illuminant E.
TEST_F(MitsubaPicture, FlatSpectrum) {
  const RGB e = xyz_to_srgb(to_xyz(ConstantSpectrum{1}));
  expect_radiance(lit(InfiniteLight{ConstantSpectrum{1}}), {e.r / 2, e.g / 2, e.b / 2}, 4096);
}

// The configuration factor of a differential element to a parallel disk-like square of half width a at height
// h, by the closed form for a rectangle's corner: 4·(1/2π)[…].
TEST_F(MitsubaPicture, AreaLightAbove) {
  Scene scene = square_scene({});
  Shape lamp = scene.shapes[0];
  lamp.area_light = add_to(scene.area_lights, AreaLight{Spectrum{emission_from_rgb({3, 2, 1})}});
  lamp.object_to_world = translate({0, 0, 6}) * rotate(pi, {1, 0, 0});  // above the camera, shining down
  scene.shapes.push_back(lamp);
  const double x = 1.0 / 6, s = x / std::sqrt(1 + x * x);
  const double factor = 4 / (2 * pi) * 2 * s * std::atan(s);
  expect_radiance(scene, {1.5 * factor, factor, 0.5 * factor}, 2048);
}

// The sky of `sky`: E = ∫(1 + d·c/2)cosθ dω = π + π/3·(c·n).
TEST_F(MitsubaPicture, EnvironmentMap) {
  write_exr_image(folder_ / "sky.exr", sky(EnvironmentProjection::equal_area, 64));
  EnvironmentLight light;
  light.filename = (folder_ / "sky.exr").string();
  expect_radiance(lit(light), {0.5, 0.5, 0.5 * (1 + 1.0 / 3)}, 4096);
}

}  // namespace
}  // namespace vitrail::mitsuba_lights_test
