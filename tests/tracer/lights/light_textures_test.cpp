// SPDX-License-Identifier: Apache-2.0
// Lights with images that are files of a bundle.
#include <gtest/gtest.h>

#include "bundle/texture_file.h"
#include "scene/geometry/portable_math.h"
#include "scene/spectra/rgb_to_spectrum.h"
#include "tests/tracer/lights/textured_lights.h"
#include "tracer/quadrics/quadric_surface.h"
#include "tracer/sampling/luminance_of.h"

namespace vitrail::light_textures_test {

namespace {

using test::file_of_image;
using test::Random;
using test::TexturedLights;
using test::write_image;

// Rows (1, 2) and (3, 4) from the top; v counts from the top as Mitsuba's importer says it.
std::vector<Texture> mitsuba_texture() {
  ImageTexture image;
  image.filename = file_of_image;
  image.mapping = UvMapping{1, 0, 0, 0, -1, 1};
  image.wrap = Wrap::clamp;
  image.filter = TextureFilter::nearest;
  return {Texture{image, false, "", {}}};
}

double irradiance_at(const LightSampler& s, Point3d p) {
  const auto light = sample_light(s, p, {0.3f, 0.3f, 0.3f, 0.3f}, test::some_wavelengths());
  return light ? static_cast<double>(light->radiance[1]) : 0;
}

}  // namespace

// As Mitsuba 3.9.1 shows an image of four colours: "projector" with fov 90 and "spot" with cutoff_angle 45,
// beam_width 20 and a texture, at points in front of them.
TEST(LightTextures, SpotAndProjectorShowTheirImagesAsMitsubaDoes) {
  const TexturedLights bundle(mitsuba_texture(), 2, 2, {1, 2, 3, 4});
  ProjectionLight projector;
  projector.light_to_world = scale({-1, 1, 1});  // Mitsuba's projector is a camera, +x on its left
  projector.image = Id<Texture>{0};
  projector.irradiance = true;
  SpotLight spot;
  spot.texture = Id<Texture>{0};
  spot.intensity = ConstantSpectrum{1};
  spot.cutoff_deg = 45;
  spot.beam_deg = 20;
  spot.falloff = SpotLight::Falloff::linear;
  const std::vector<Light> a{{projector, {}}}, b{{spot, {}}};
  const LightSampler p = make_light_sampler(bundle.scene(a), bundle.directory.path()),
                     s = make_light_sampler(bundle.scene(b), bundle.directory.path());
  EXPECT_NEAR(irradiance_at(p, {0.2, 0.2, 1}), 3.264839 * 1, 1e-5);
  EXPECT_NEAR(irradiance_at(p, {-0.2, 0.2, 1}), 3.264839 * 2, 1e-5);
  EXPECT_NEAR(irradiance_at(p, {0.2, -0.2, 1}), 3.264839 * 3, 1e-5);
  EXPECT_NEAR(irradiance_at(p, {-0.2, -0.2, 1}), 3.264839 * 4, 2e-5);
  EXPECT_NEAR(irradiance_at(p, {0.2, 0.2, 2}), 0.7932133, 1e-6);
  EXPECT_NEAR(irradiance_at(p, {0.9, 0.9, 1}), 5.085112, 1e-5);
  EXPECT_EQ(irradiance_at(p, {1.1, 0.1, 1}), 0);
  EXPECT_NEAR(irradiance_at(s, {0.2, 0.2, 1}), 0.92592597 * 4, 1e-6);
  EXPECT_NEAR(irradiance_at(s, {-0.2, 0.2, 1}), 0.92592597 * 3, 1e-6);
  EXPECT_NEAR(irradiance_at(s, {0.2, -0.2, 1}), 0.92592597 * 2, 1e-6);
  EXPECT_NEAR(irradiance_at(s, {-0.2, -0.2, 1}), 0.92592597 * 1, 1e-6);
}

TEST(LightTextures, ProjectionsHaveTheShapeOfTheirImage) {
  std::vector<Texture> records = mitsuba_texture();
  std::get<ImageTexture>(records[0].model).mapping = UvMapping{};  // pbrt's: up from the bottom
  const TexturedLights bundle(records, 4, 2, {1, 1, 2, 2, 3, 3, 4, 4});
  ProjectionLight light;
  light.image = Id<Texture>{0};
  light.fov_deg = 90;
  const std::vector<Light> lights{{light, {}}};
  const LightSampler s = make_light_sampler(bundle.scene(lights), bundle.directory.path());
  EXPECT_NEAR(irradiance_at(s, {-1.9, 0.9, 1}) * (1.9 * 1.9 + 0.9 * 0.9 + 1), 1, 1e-6);
  EXPECT_NEAR(irradiance_at(s, {1.9, 0.9, 1}) * (1.9 * 1.9 + 0.9 * 0.9 + 1), 2, 1e-6);
  EXPECT_NEAR(irradiance_at(s, {-1.9, -0.9, 1}) * (1.9 * 1.9 + 0.9 * 0.9 + 1), 3, 1e-6);
  EXPECT_EQ(irradiance_at(s, {0, 1.1, 1}), 0);
  EXPECT_EQ(irradiance_at(s, {2.1, 0, 1}), 0);
}

// A square with an image of 8 × 8, most of it black: the mean of samples is the sum over the texels.
TEST(LightTextures, TexturedAreaLightsAreUnbiased) {
  std::vector<float> rows(64, 0.0f);
  rows[10] = 50;
  rows[63] = 5;
  std::vector<Texture> records = mitsuba_texture();
  const TexturedLights bundle(records, 8, 8, rows);
  AreaLight light;
  light.radiance = Id<Texture>{0};
  light.scale = 2;
  const Point3f a{-1, -1, 0}, b{1, -1, 0}, c{1, 1, 0}, d{-1, 1, 0};
  const std::vector<EmissiveTriangle> triangles{{{a, b, c}, {{0, 0}, {1, 0}, {1, 1}}, 7, 0},
                                                {{a, c, d}, {{0, 0}, {1, 1}, {0, 1}}, 8, 0}};
  LightScene scene = bundle.scene({});
  scene.area_lights = {&light, 1};
  scene.triangles = triangles;
  const LightSampler s = make_light_sampler(scene, bundle.directory.path());
  const Point3d p{0.3, 0.2, 1.5};
  const SampledWavelengths w = test::some_wavelengths();
  double expected = 0;
  constexpr int n = 800;
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      TexturePoint at;
      at.uv = {(x + 0.5) / n, (y + 0.5) / n};
      const Vector3d to = Point3d{2 * at.uv.x - 1, 2 * at.uv.y - 1, 0} - p;
      const double d2 = dot(to, to);
      expected += static_cast<double>(emitted(s, 0, at, 1, w)[0]) * to.z * to.z / (d2 * d2) * 4 / (n * n);
    }
  ASSERT_GT(expected, 0);
  Random random(1);
  double sum = 0, squares = 0;
  constexpr int samples = 200000;
  for (int i = 0; i < samples; ++i)
    if (const auto l = sample_light(s, p, random.four(), w)) {
      const double x = static_cast<double>(l->radiance[0]) * -l->to_light.z / l->pdf;
      sum += x / samples;
      squares += x * x / samples;
    }
  EXPECT_NEAR(sum, expected, 4.5 * std::sqrt((squares - sum * sum) / samples) + 1e-3 * expected);
  EXPECT_GT(triangle_pdf(s, p, 7, {-0.375, -0.625, 0}, 1, 1), 0);
  EXPECT_GT(triangle_pdf(s, p, 8, {0.86, 0.9, 0}, 1, 1), 0);
}

// A sphere with such an image, by its own (u,v).
TEST(LightTextures, TexturedSpheresAreUnbiased) {
  std::vector<float> rows(64, 0.0f);
  for (std::size_t i = 0; i < rows.size(); i += 3) rows[i] = static_cast<float>(i * 7 % 11);
  const TexturedLights bundle(mitsuba_texture(), 8, 8, rows);
  AreaLight light;
  light.radiance = Id<Texture>{0};
  EmissiveQuadric e;
  e.to_bundle = affine(translate({1, 2, 3}) * rotate(0.7, {1, 2, 3}));
  const std::vector<EmissiveQuadric> quadrics{e};
  LightScene scene = bundle.scene({});
  scene.area_lights = {&light, 1};
  scene.quadrics = quadrics;
  const LightSampler s = make_light_sampler(scene, bundle.directory.path());
  const SampledWavelengths w = test::some_wavelengths();
  for (const Vector3d away : {Vector3d{2, 0.3, 0}, Vector3d{-1, 1, 1}, Vector3d{0, -1, -3}}) {
    const Point3d p = Point3d{1, 2, 3} + away;
    double expected = 0;  // ∫ L dω
    constexpr int n = 800;
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < n; ++k) {
        const double phi = 2 * pi * (i + 0.5) / n, z = 2 * (k + 0.5) / n - 1, rho = std::sqrt(1 - z * z);
        const QuadricPoint at =
            quadric_point(e.quadric, e.to_bundle, {rho * std::cos(phi), rho * std::sin(phi), z});
        const Vector3d way = at.p - p;
        const double d2 = dot(way, way), cosine = -dot(way, at.normal) / std::sqrt(d2);
        if (cosine <= 0) continue;
        TexturePoint there;
        there.uv = at.uv;
        expected += static_cast<double>(emitted(s, 0, there, cosine, w)[0]) * cosine / d2 * 4 * pi / (n * n);
      }
    Random random(1);
    double sum = 0, squares = 0;
    constexpr int samples = 100000;
    for (int i = 0; i < samples; ++i)
      if (const auto l = sample_light(s, p, random.four(), w)) {
        const double x = static_cast<double>(l->radiance[0]) / l->pdf;
        sum += x / samples;
        squares += x * x / samples;
      }
    EXPECT_NEAR(sum, expected, 4.5 * std::sqrt((squares - sum * sum) / samples) + 1e-3 * expected);
    EXPECT_GT(expected, 0.01);
  }
}

// The table of a map that is larger than it, from its levels.
TEST(LightTextures, LargeEnvironmentsAreSampledByTheirLevels) {
  constexpr std::uint32_t width = 2048, height = 1024;
  std::vector<float> rows;
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x) rows.push_back(x / 8 == 60 && y / 8 == 20 ? 3000 : 0.5f);
  const test::TemporaryDirectory directory;
  write_image(directory.path() / file_of_image, width, height, rows);
  EnvironmentLight light;
  light.filename = file_of_image;
  light.projection = EnvironmentLight::Projection::latitude_longitude;
  const std::vector<Light> lights{{light, {}}};
  LightScene scene;
  scene.lights = lights;
  const LightSampler s = make_light_sampler(scene, directory.path());
  EXPECT_EQ(s.environments[0].table.width(), 1024);
  Random random(2);
  double sum = 0, squares = 0;
  constexpr int samples = 20000;
  for (int i = 0; i < samples; ++i) {
    const auto l = sample_light(s, {0, 0, 0}, random.four(), test::some_wavelengths());
    ASSERT_TRUE(l);
    // Beside uniform directions, as of a BSDF.
    constexpr double uniform = 1 / (4 * pi);
    const Background other = background(s, random.direction(), test::some_wavelengths());
    const double x = static_cast<double>(l->radiance[0]) / (l->pdf + uniform) +
                     static_cast<double>(other.radiance[0]) / (other.pdf + uniform);
    sum += x / samples;
    squares += x * x / samples;
  }
  const double polar0 = pi * 160 / height, polar1 = pi * 168 / height;
  const double sun = 2 * pi * 8 / width * (portable_cos(polar0) - portable_cos(polar1));
  const double expected = 4 * pi * 0.5 + sun * (3000 - 0.5);
  EXPECT_NEAR(sum, expected, 4.5 * std::sqrt((squares - sum * sum) / samples) + 0.01 * expected);
  EXPECT_LT(squares - sum * sum, 0.05 * sum * sum);
}

TEST(LightTextures, AMissingImageIsAnErrorWithItsName) {
  const test::TemporaryDirectory directory;
  EnvironmentLight light;
  light.filename = "textures/000009.tex";
  const std::vector<Light> lights{{light, {}}};
  LightScene scene;
  scene.lights = lights;
  EXPECT_ANY_THROW(make_light_sampler(scene, directory.path()));
}

// In lux, whatever the colours.
TEST(LightTextures, ColouredEnvironmentsHaveTheirIlluminance) {
  const test::TemporaryDirectory directory;
  std::filesystem::create_directories(directory.path() / "textures");
  constexpr std::uint32_t size = 8;
  write_texture_file(directory.path() / file_of_image, {TexelFormat::illuminant, size, size, 1},
                     [&](std::uint32_t, std::uint32_t x, std::uint32_t y) {
                       const RGB c{0.1 + 0.1 * x, y == 4 ? 3.0 : 0.02, x == 3 ? 0.9 : 0.05};
                       const RgbIlluminantSpectrum e = emission_from_rgb(c);
                       return pack({nodes_of(e.shape), e.scale});
                     });
  EnvironmentLight light;
  light.filename = file_of_image;
  light.illuminance = 100.0f;
  const std::vector<Light> lights{{light, {}}};
  LightScene scene;
  scene.lights = lights;
  const LightSampler s = make_light_sampler(scene, directory.path());
  double up = 0;
  constexpr int n = 128;
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const Vector3d d = sphere_direction(SphereProjection::equal_area, {(x + 0.5) / n, (y + 0.5) / n});
      if (d.z > 0)
        up += luminance_of([&](const SampledWavelengths& w) { return background(s, d, w).radiance; }, 16) *
              d.z * 4 * pi / (n * n);
    }
  EXPECT_NEAR(up, 100, 0.3);
}

}  // namespace vitrail::light_textures_test
