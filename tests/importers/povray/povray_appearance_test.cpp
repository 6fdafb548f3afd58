// SPDX-License-Identifier: Apache-2.0
// What POV-Ray means by words that sound alike: backgrounds, depths, gammas, maps, insides.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "importers/images/environment_images.h"
#include "scene/geometry/pi.h"
#include "tests/importers/povray/povray_oracle.h"
#include "tests/support/png.h"

namespace vitrail::povray_appearance_test {
namespace {

class PovrayAppearance : public PovrayOracle {
 protected:
  // The plane z = 0 of that reflectance, in light of irradiance π.
  Scene lit(const ImageTexture& reflectance) {
    Scene scene = empty_povray_scene();
    scene.textures.push_back({reflectance});
    add(scene, square(-5, 5, -5, 5, 0), DiffuseMaterial{Id<Texture>{0}});
    scene.lights.push_back({DistantLight{{0, 0, -1}, emission_from_rgb({pi, pi, pi})}});
    return scene;
  }

  // Red is s, green is t, in linear numbers.
  ImageTexture ramp() {
    constexpr std::uint32_t n = 128;
    std::vector<std::uint8_t> bytes;
    const auto put = [&](double value) {
      const auto number = static_cast<unsigned>(value * 65535);
      bytes.push_back(static_cast<std::uint8_t>(number >> 8));
      bytes.push_back(static_cast<std::uint8_t>(number & 255));
    };
    for (std::uint32_t y = 0; y < n; ++y)
      for (std::uint32_t x = 0; x < n; ++x) put((x + .5) / n), put(1 - (y + .5) / n), put(.5);
    test::write_png(folder_ / "ramp.png", n, n, 3, bytes, 16);
    ImageTexture image{(folder_ / "ramp.png").string()};
    image.encoding = Encoding::linear;
    return image;
  }
};

// An upward plane gets E: a sky of one radiance has E/π.
TEST_F(PovrayAppearance, SkiesHaveTheirIlluminance) {
  std::string grey = "P2\n64 64\n255\n";
  for (int pixel = 0; pixel < 64 * 64; ++pixel) grey += "99 ";
  folder_.write("grey.pgm", grey);
  using enum EnvironmentLight::Projection;
  for (const auto projection : {latitude_longitude, equal_area}) {
    Scene scene = empty_povray_scene();
    scene.settings.max_depth = 0;
    EnvironmentLight sky;
    sky.filename = (folder_ / "grey.pgm").string();
    sky.projection = projection;
    sky.illuminance = static_cast<float>(.3 * pi);
    scene.lights.push_back({sky});
    expect_plane(
        scene,
        [](double, double) -> std::array<double, 3> {
          return {.3, .3, .3};
        },
        .02);
  }
}

// The radiance of the plane of ρ = .5 that a point light of `intensity` lights from `from`.
template <class Intensity>
std::array<double, 3> lit_by(Point3d from, double x, double y, Intensity&& intensity) {
  const Vector3d d = Point3d{x, y, 0} - from;
  const double d2 = dot(d, d);
  std::array<double, 3> seen = intensity(normalize(d));
  for (double& value : seen) value *= .5 / pi * -d.z / std::sqrt(d2) / d2;
  return seen;
}

TEST_F(PovrayAppearance, ProjectorsThrowTheirImage) {
  const Point3d from{.7, -.4, 3};
  for (const bool irradiance : {false, true}) {
    Scene scene = plane({.5, .5, .5});
    ProjectionLight light;
    const Transform frame = translate({from.x, from.y, from.z}) * rotate(160 * pi / 180, {0, 1, 0}) *
                            rotate(20 * pi / 180, {1, 0, 0});
    light.light_to_world = frame;
    scene.textures.push_back({ramp()});
    light.image = Id<Texture>{0};
    light.fov_deg = 120;
    light.irradiance = irradiance;
    light.scale = emission_from_rgb({2, 2, 2});
    scene.lights.push_back({light});
    const double half = std::tan(pi / 3);
    expect_plane(
        scene,
        [&](double x, double y) {
          return lit_by(from, x, y, [&](Vector3d d) -> std::array<double, 3> {
            const Vector3d l = normalize(transform_vector(inverse(frame), d));
            const double s = .5 + .5 * l.x / (l.z * half), t = .5 + .5 * l.y / (l.z * half);
            const double i = 2 * (irradiance ? pi / (l.z * l.z * l.z) : 1);
            if (!(l.z > 0 && s > 0 && s < 1 && t > 0 && t < 1)) return {0, 0, 0};
            return {i * s, i * (irradiance ? 1 - t : t), i * .5};
          });
        },
        .02);
  }
}

TEST_F(PovrayAppearance, GoniometricLightsShineAsTheirImage) {
  using enum EnvironmentLight::Projection;
  const Point3d from{.7, -.4, 3};
  for (const bool map : {false, true}) {
    Scene scene = plane({.5, .5, .5});
    GoniometricLight light;
    const Transform frame = translate({from.x, from.y, from.z}) * rotate(205 * pi / 180, {0, 1, 0}) *
                            rotate(-120 * pi / 180, {1, 0, 0});
    light.light_to_world = frame;
    light.filename = ramp().filename;
    light.encoding = Encoding::linear;
    light.latitude_longitude = map;
    light.intensity = emission_from_rgb({5, 10, 3});
    scene.lights.push_back({light});
    expect_plane(
        scene,
        [&](double x, double y) {
          return lit_by(from, x, y, [&](Vector3d d) -> std::array<double, 3> {
            const Vector3d l = normalize(transform_vector(inverse(frame), d));
            const Point2d p = point_of(map ? latitude_longitude : equal_area, {l.x, l.z, l.y});
            const double i = (p.x + 1 - p.y + .5) / 3;
            return {5 * i, 10 * i, 3 * i};
          });
        },
        .02);
  }
}

// A lamp of a square metre before the plane: its light is there, itself is not.
TEST_F(PovrayAppearance, HiddenLampsLightTheScene) {
  const auto irradiance = [](double x, double y) {
    constexpr int n = 64;
    double sum = 0;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const double dx = -.5 + (i + .5) / n - x, dy = -.5 + (j + .5) / n - y, d2 = dx * dx + dy * dy + 4;
        sum += 4 / d2 / d2 / (n * n);
      }
    return sum;
  };
  Scene scene = plane({.5, .5, .5});
  TriangleMesh lamp = square(-.5f, .5f, -.5f, .5f, 2);
  std::swap(lamp.positions[1], lamp.positions[3]);
  add_emitter(scene, lamp, {2, 2, 2});
  scene.area_lights.back().two_sided = true;
  scene.settings.hides_emitters = true;
  expect_plane(
      scene,
      [&](double x, double y) -> std::array<double, 3> {
        const double seen = 2 * .5 * irradiance(x, y) / pi;
        return {seen, seen, seen};
      },
      .01);

  scene.lights.push_back({InfiniteLight{emission_from_rgb({.2, .4, .1})}});
  scene.settings.max_depth = 0;
  expect_plane(scene, [](double, double) -> std::array<double, 3> { return {0, 0, 0}; });
}

TEST_F(PovrayAppearance, MediaAbsorbAndScatter) {
  const auto in_a_medium = [](AbsorptionScattering coefficients) {
    Scene scene = empty_povray_scene();
    Medium medium;
    medium.coefficients = std::move(coefficients);
    scene.media.push_back(medium);
    scene.camera_medium = Id<Medium>{0};
    return scene;
  };
  const auto way = [](double x, double y) { return std::sqrt(16 + x * x + y * y); };
  Scene absorbs = in_a_medium({unbounded_from_rgb({.1, .2, .4}), Spectrum{ConstantSpectrum{0}}});
  add_emitter(absorbs, square(-5, 5, -5, 5, 0), {1, 1, 1});
  absorbs.settings.max_depth = 0;
  expect_plane(absorbs, [&](double x, double y) -> std::array<double, 3> {
    const double d = way(x, y);
    return {std::exp(-.1 * d), std::exp(-.2 * d), std::exp(-.4 * d)};
  });
  // σ_s·d/(4π) of an irradiance of 100π, on what comes straight back.
  for (const float g : {0.0f, 0.5f}) {
    Scene scatters = in_a_medium({Spectrum{ConstantSpectrum{0}}, Spectrum{ConstantSpectrum{.0002f}}});
    scatters.media[0].g = g;
    add(scatters, square(-5, 5, -5, 5, 0), diffuse({0, 0, 0}));
    scatters.lights.push_back({DistantLight{{0, 0, -1}, emission_from_rgb({100 * pi, 100 * pi, 100 * pi})}});
    const PovPicture picture = render_povray(scatters, folder_);
    ASSERT_FALSE(picture.values.empty());
    const double share = (1 - g * g) / std::pow(1 + g, 3);
    EXPECT_NEAR(picture.at(16, 16)[1], .0002 * 4 * 100 / 4 * share, .02 * .02 * share) << g;
  }
}

// From z = .5 to 1.5.
void add_box(TriangleMesh& box) {
  for (const float z : {.5f, 1.5f})
    for (const float y : {-5.0f, 5.0f})
      for (const float x : {-5.0f, 5.0f}) box.positions.push_back({x, y, z});
  box.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                   {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
}

// Of a container that nothing else shows.
TEST_F(PovrayAppearance, WhatFillsAClosedSurface) {
  Scene scene = empty_povray_scene();
  Medium medium;
  medium.coefficients = AbsorptionScattering{Spectrum{ConstantSpectrum{.5f}}, Spectrum{ConstantSpectrum{0}}};
  scene.media.push_back(medium);
  add_emitter(scene, square(-5, 5, -5, 5, 0), {1, 1, 1});
  Shape& slab = add(scene, {}, InterfaceMaterial{});
  add_box(scene.meshes[slab.mesh.value]);
  for (const bool turned : {false, true}) {
    slab.flip_orientation = turned;
    (turned ? slab.exterior : slab.interior) = Id<Medium>{0};
    if (turned) slab.interior.reset();
    expect_plane(scene, [](double x, double y) -> std::array<double, 3> {
      const double left = std::exp(-.5 * std::sqrt(1 + (x * x + y * y) / 16));
      return {left, left, left};
    });
  }
}

// A slab of two cells, thin below and dense above, as a density beside coefficients and as the coefficients.
TEST_F(PovrayAppearance, GridsOfMedia) {
  Grid grid;
  grid.nx = grid.ny = 1, grid.nz = 2;
  grid.values = {.25f, .75f};
  grid.bounds = {{-5, -5, .5}, {5, 5, 1.5}};
  Grid colors = grid;
  colors.channels = 3;
  colors.values = {.1f, .2f, .4f, .3f, .6f, 1.2f};
  Medium beside, of_grids, of_colors;
  beside.density = grid;
  beside.coefficients =
      AbsorptionScattering{unbounded_from_rgb({.4, .8, 1.6}), Spectrum{ConstantSpectrum{0}}};
  of_grids.coefficients = AbsorptionScattering{grid, Spectrum{ConstantSpectrum{0}}};
  of_colors.coefficients = ExtinctionAlbedo{colors, Spectrum{ConstantSpectrum{0}}};
  const std::array<double, 3> of_mean{.2, .4, .8}, grey{.5, .5, .5};
  for (const auto& [medium, mean] :
       {std::pair{beside, of_mean}, std::pair{of_grids, grey}, std::pair{of_colors, of_mean}}) {
    Scene scene = empty_povray_scene();
    scene.media.push_back(medium);
    add_emitter(scene, square(-5, 5, -5, 5, 0), {1, 1, 1});
    Shape& slab = add(scene, {}, InterfaceMaterial{});
    slab.interior = Id<Medium>{0};
    add_box(scene.meshes[slab.mesh.value]);
    expect_plane(
        scene,
        [&mean = mean](double x, double y) -> std::array<double, 3> {
          const double way = std::sqrt(1 + (x * x + y * y) / 16);
          return {std::exp(-mean[0] * way), std::exp(-mean[1] * way), std::exp(-mean[2] * way)};
        },
        .02);
  }
}

// Of a line of the laser's red: what it takes from green and blue is kept.
TEST_F(PovrayAppearance, LightOutsideOfSrgb) {
  const Spectrum line = tabulate({{649, 0}, {650, 300}, {651, 0}}, false);
  const RGB color = xyz_to_srgb(to_xyz(resolved(line)));
  ASSERT_LT(color.g, -.1);
  Scene scene = plane({.5, .5, .5});
  scene.lights.push_back({DistantLight{{0, 0, -1}, line}});
  scene.lights.push_back({DistantLight{{0, 0, -1}, emission_from_rgb({1, 1, 1})}});
  expect_plane(scene, [&](double, double) -> std::array<double, 3> {
    return {(1 + color.r) * .5 / pi, (1 + color.g) * .5 / pi, (1 + color.b) * .5 / pi};
  });
}

// POV-Ray shows one background or sky sphere, the last.
TEST_F(PovrayAppearance, LightsFromAllAroundAreSummed) {
  Scene scene = empty_povray_scene();
  scene.settings.max_depth = 0;
  scene.lights.push_back({InfiniteLight{emission_from_rgb({.2, .4, .1})}});
  scene.lights.push_back({InfiniteLight{emission_from_rgb({.3, .1, .5})}});
  expect_plane(scene, [](double, double) -> std::array<double, 3> { return {.5, .5, .6}; });

  folder_.write("dim.ppm", "P3\n2 1\n255\n 0 64 0  0 64 0\n");
  EnvironmentLight image;
  image.filename = (folder_ / "dim.ppm").string();
  image.projection = EnvironmentLight::Projection::latitude_longitude;
  const double level = std::pow((64 / 255.0 + .055) / 1.055, 2.4);
  scene.lights.push_back({image});
  expect_plane(scene, [&](double, double) -> std::array<double, 3> { return {.5, .5 + level, .6}; });
}

TEST_F(PovrayAppearance, DepthZeroShowsEmissionAlone) {
  Scene scene = plane();
  scene.settings.max_depth = 0;
  scene.lights.push_back({PointLight{{.5, -.25, 1.5}, emission_from_rgb({4, 3, 2})}});
  add_emitter(scene, square(2.5f, 3.5f, -.5f, .5f, 1), {1, 1, 1}).flip_orientation = true;
  expect_plane(scene, [](double, double) -> std::array<double, 3> { return {0, 0, 0}; });
}

TEST_F(PovrayAppearance, IntegersAreSrgbWhateverTheirBits) {
  const std::vector<std::uint8_t> bytes{0xff, 0xff, 0x80, 0x80, 0x40, 0x40};
  test::write_png(folder_ / "deep.png", 1, 1, 3, bytes, 16);
  const auto decoded = [](int byte) { return std::pow((byte / 255.0 + .055) / 1.055, 2.4); };
  expect_plane(lit(ImageTexture{(folder_ / "deep.png").string()}),
               [&](double, double) -> std::array<double, 3> {
                 return {1, decoded(0x80), decoded(0x40)};
               });
}

const Transform placed = translate({.3, -4, -1.5}) * rotate(.4, {1, 2, 3}) * rotate(-pi / 2, {0, 0, 1});

TEST_F(PovrayAppearance, SphericalMapping) {
  ImageTexture image = ramp();
  image.mapping = SphericalMapping{placed};
  expect_plane(
      lit(image),
      [](double x, double y) -> std::array<double, 3> {
        const Point3d q = transform_point(inverse(placed), {x, y, 0});
        const double turn = std::atan2(q.y, q.x) / (2 * pi);
        return {std::acos(q.z / length(q - Point3d{})) / pi, turn < 0 ? turn + 1 : turn, .5};
      },
      0.02);
}

TEST_F(PovrayAppearance, CylindricalMapping) {
  // An axis below the plane: s is 0.68 … 0.90 there, t 0.27 … 0.70.
  const Transform high =
      translate({.3, -.2, -3}) * rotate(1.2, {1, .3, .2}) * translate({0, 0, -4}) * scale({1, 1, 10});
  ImageTexture image = ramp();
  image.mapping = CylindricalMapping{high};
  expect_plane(
      lit(image),
      [&](double x, double y) -> std::array<double, 3> {
        const Point3d q = transform_point(inverse(high), {x, y, 0});
        return {.5 + std::atan2(q.y, q.x) / (2 * pi), q.z, .5};
      },
      0.02);
}

// A ball, or a box, of glass before stripes that shine.
Scene before_stripes(bool box, bool inside_out, float eta) {
  Scene scene = empty_povray_scene();
  scene.settings.max_depth = 8;
  for (int i = -2; i < 3; ++i) {
    const auto x = static_cast<float>(i);
    add_emitter(scene, square(x, x + .5f, -9, 9, -3), {.2 + .1 * i + .1, .5, .7 - .1 * i});
  }
  TriangleMesh mesh;
  if (box) {
    mesh.positions = {{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {1, 1, -1},
                      {-1, -1, 1},  {1, -1, 1},  {-1, 1, 1},  {1, 1, 1}};
    mesh.triangles = {{0, 3, 1}, {0, 2, 3}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 7, 3}, {2, 6, 7}, {0, 6, 2}, {0, 4, 6}, {1, 7, 5}, {1, 3, 7}};
  } else {
    mesh.quadric = Quadric{.kind = QuadricKind::sphere};
  }
  add(scene, mesh, DielectricMaterial{ConstantSpectrum{eta}}).flip_orientation = inside_out;
  scene.shapes.back().object_to_world = rotate(.4, {1, 2, 0});
  return scene;
}

// The front of a surface is outside of the glass: behind it, n and 1 change places.
TEST_F(PovrayAppearance, GlassInsideOutHasTheInverseIndex) {
  for (const bool box : {false, true}) {
    const auto turned = render_povray(before_stripes(box, true, 1.5f), folder_).values;
    const auto inverse = render_povray(before_stripes(box, false, 1 / 1.5f), folder_).values;
    const auto plain = render_povray(before_stripes(box, false, 1.5f), folder_).values;
    ASSERT_EQ(turned.size(), inverse.size());
    ASSERT_EQ(turned.size(), plain.size());
    double from_inverse = 0, from_plain = 0;
    for (std::size_t i = 0; i < turned.size(); ++i) {
      from_inverse += std::abs(turned[i] - inverse[i]);
      from_plain += std::abs(turned[i] - plain[i]);
    }
    EXPECT_LT(from_inverse, 0.01 * from_plain) << box;
  }
}

}  // namespace
}  // namespace vitrail::povray_appearance_test
