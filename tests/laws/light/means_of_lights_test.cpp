// SPDX-License-Identifier: Apache-2.0
// What a white floor gets of each kind of light, against closed forms and quadratures, where chance has least
// to work with: all samples at one point, seen by parallel rays, and lights far, grazing, coplanar or alike.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "images/image_files.h"
#include "scene/geometry/portable_math.h"
#include "tests/support/render.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::means_of_lights_test {
namespace {

const Material black{DiffuseMaterial{ConstantSpectrum{0}}};
const Spectrum one = ConstantSpectrum{1};

std::array<Point3f, 4> flat(float x0, float x1, float y0, float y1, float z, bool up) {
  std::array<Point3f, 4> q{{{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}}};
  if (!up) std::swap(q[1], q[3]);
  return q;
}

// A white spot around 0 that faces +z.
Scene spot() {
  Scene scene;
  add_shape(scene, add_quads(scene, {flat(-0.01f, 0.01f, -0.01f, 0.01f, 0, true)}),
            Material{DiffuseMaterial{one}});
  OrthographicCamera camera;
  camera.camera_to_world = look_at({0, 0, 0.005}, {0, 0, 0}, {0, 1, 0});
  camera.screen = {-1e-4, 1e-4, -1e-4, 1e-4};
  scene.camera = camera;
  scene.film.width = scene.film.height = 8;
  scene.film.crop = {0, 8, 0, 8};
  scene.film.filter = BoxFilter{};
  scene.settings.max_depth = 1;
  return scene;
}

void add_lamp(Scene& scene, const std::vector<std::array<Point3f, 4>>& quads, AreaLight light) {
  add_shape(scene, add_quads(scene, quads), black, light);
}

void expect_irradiance(const char* what, const Scene& scene, double expected, int samples = 256) {
  const Rendered rendered = render(scene, samples);
  const Brightness seen = brightness(rendered.film);
  fmt::print("{}: {:.6g} ± {:.2g} of {:.6g}\n", what, seen.mean * pi, seen.standard_error * pi, expected);
  EXPECT_NEAR(seen.mean * pi, expected, 4 * seen.standard_error * pi + 2e-4 * expected) << what;
  EXPECT_EQ(rendered.stats.refused, Refused{}) << what;
}

// ---- Points

constexpr double far = 1e6;

Scene under(LightModel light) {
  Scene scene = spot();
  scene.lights.push_back(Light{std::move(light), {}});
  return scene;
}

TEST(MeansOfLights, Points) {
  for (const double distance : {0.1, 3.0, far})
    for (const double cosine : {1.0, 0.5, 1e-3}) {
      const double sine = std::sqrt(1 - cosine * cosine);
      const auto intensity = static_cast<float>(distance * distance / cosine);
      expect_irradiance(
          "a point", under(PointLight{{sine * distance, 0, cosine * distance}, ConstantSpectrum{intensity}}),
          1);
    }
  // Many alike, and many in one place.
  Scene scene = spot();
  double expected = 0;
  for (int i = 0; i < 50; ++i) {
    const double x = i < 25 ? 1 : i - 30;
    scene.lights.push_back(Light{PointLight{{x, 0, 2}, one}, {}});
    expected += 2 / std::pow(x * x + 4, 1.5);
  }
  expect_irradiance("50 points", scene, expected);
}

// High and low ones, and either may be hidden: one is chosen by what it would bring, and that must not count.
TEST(MeansOfLights, HiddenPoints) {
  for (const bool hide_high : {true, false}) {
    Scene scene = spot();
    double expected = 0;
    for (int i = 0; i < 9; ++i) {
      const bool high = i % 3 == 0;
      const double cosine = high ? 1 : 0.25, sine = std::sqrt(1 - cosine * cosine), angle = i * 2 * pi / 9;
      const Vector3d to_light{sine * std::cos(angle), sine * std::sin(angle), cosine};
      scene.lights.push_back(Light{PointLight{Point3d{} + to_light, one}, {}});
      const auto x = static_cast<float>(to_light.x / 2), y = static_cast<float>(to_light.y / 2),
                 z = static_cast<float>(cosine / 2);
      if (high == hide_high)
        add_shape(scene, add_quads(scene, {flat(x - 0.1f, x + 0.1f, y - 0.1f, y + 0.1f, z, true)}), black);
      else
        expected += cosine;
    }
    expect_irradiance(hide_high ? "low points" : "high points", scene, expected, 4096);
  }
}

TEST(MeansOfLights, Spots) {
  for (const auto falloff :
       {SpotLight::Falloff::smoothstep, SpotLight::Falloff::quartic, SpotLight::Falloff::linear})
    for (const double distance : {2.0, far})
      for (const double angle_deg : {0.0, 15.0, 25.0, 29.0}) {
        SpotLight light;
        light.beam_deg = 20;
        light.cutoff_deg = 30;
        light.falloff = falloff;
        light.intensity = ConstantSpectrum{static_cast<float>(distance * distance)};
        const double angle = angle_deg * pi / 180, c0 = std::cos(pi / 6), c1 = std::cos(pi / 9);
        light.light_to_world =
            look_at({0, 0, distance}, Point3d{distance * std::tan(angle), 0, 0}, {0, 1, 0});
        const double t = std::clamp((std::cos(angle) - c0) / (c1 - c0), 0.0, 1.0);
        const double expected = falloff == SpotLight::Falloff::linear
                                    ? std::clamp((30 - angle_deg) / 10, 0.0, 1.0)
                                : falloff == SpotLight::Falloff::quartic ? t * t * t * t
                                                                         : t * t * (3 - 2 * t);
        expect_irradiance("a spot", under(light), expected);
      }
}

// ---- Distant

TEST(MeansOfLights, Distant) {
  for (const double degrees : {0.0, 60.0, 89.0, 89.99}) {
    const double angle = degrees * pi / 180;
    expect_irradiance("a distant light",
                      under(DistantLight{{std::sin(angle), 0, -std::cos(angle)},
                                         ConstantSpectrum{static_cast<float>(1 / std::cos(angle))}}),
                      1);
  }
  Scene scene = spot();
  for (int i = 0; i < 20; ++i) scene.lights.push_back(Light{DistantLight{{1e-6 * i, 0, -1}, one}, {}});
  expect_irradiance("20 that are nearly one", scene, 20);
  scene.lights.push_back(Light{InfiniteLight{ConstantSpectrum{2}}, {}});
  scene.lights.push_back(Light{InfiniteLight{ConstantSpectrum{1}}, {}});
  expect_irradiance("and two skies", scene, 20 + 3 * pi);
}

// ---- Surfaces

// Of a rectangle in the plane z = height over a point below its corner (Howell, Menguc & Daun, B-4),
// radiance 1.
double corner(double a, double b, double height) {
  const double x = a / height, y = b / height, u = std::sqrt(1 + x * x), v = std::sqrt(1 + y * y);
  return 0.5 * (x / u * std::atan(y / u) + y / v * std::atan(x / v));
}
// Signed, of [0, a] × [0, b].
double from_corner(double a, double b, double height) {
  return std::copysign(corner(std::abs(a), std::abs(b), height), a * b);
}
double rectangle(double x0, double x1, double y0, double y1, double height) {
  return from_corner(x1, y1, height) - from_corner(x0, y1, height) - from_corner(x1, y0, height) +
         from_corner(x0, y0, height);
}

// The spot, where floats are finest, though a lamp is this far above it.
void keep_in_the_middle(Scene& scene, float height) {
  add_shape(scene, add_quads(scene, {flat(-1, 1, -1, 1, -height, true)}), black);
}

TEST(MeansOfLights, Rectangles) {
  struct Case {
    float x0, x1, y0, y1, z;
  };
  for (const Case& c :
       {Case{-1, 1, -1, 1, 1.5f}, Case{0, 1, 0, 1, 1e-2f}, Case{3, 4, -1, 1, 0.03f},
        Case{-1e6f, 1e6f, -1e6f, 1e6f, 1}, Case{1, 1e5f, -1e5f, 1e5f, 1}, Case{-10, 10, -10, 10, 1e6f}}) {
    Scene scene = spot();
    const double factor = rectangle(c.x0, c.x1, c.y0, c.y1, c.z);
    AreaLight light{ConstantSpectrum{static_cast<float>(1 / factor)}};
    keep_in_the_middle(scene, c.z);
    add_lamp(scene, {flat(c.x0, c.x1, c.y0, c.y1, c.z, false)}, light);
    expect_irradiance("a rectangle", scene, 1);
    light.two_sided = true;
    scene = spot();
    keep_in_the_middle(scene, c.z);
    add_lamp(scene, {flat(c.x0, c.x1, c.y0, c.y1, c.z, true)}, light);
    expect_irradiance("a two-sided rectangle's back", scene, 1);
  }
}

// Two in one plane, side by side; and a hundred strips of one, half of them dark.
TEST(MeansOfLights, CoplanarRectangles) {
  Scene scene = spot();
  add_lamp(scene, {flat(-1, 0, -1, 1, 1, false)}, AreaLight{ConstantSpectrum{1}});
  add_lamp(scene, {flat(0, 1, -1, 1, 1, false)}, AreaLight{ConstantSpectrum{3}});
  expect_irradiance("two in a plane", scene, rectangle(-1, 0, -1, 1, 1) * 4);
  scene = spot();
  double expected = 0;
  for (int i = 0; i < 100; ++i) {
    const auto x0 = static_cast<float>(i - 50) / 16, x1 = static_cast<float>(i - 49) / 16;
    const float radiance = i % 2 ? 0.0f : 2.0f;
    add_lamp(scene, {flat(x0, x1, -1, 1, 1, false)}, AreaLight{ConstantSpectrum{radiance}});
    expected += static_cast<double>(radiance) * rectangle(x0, x1, -1, 1, 1);
  }
  expect_irradiance("strips", scene, expected);
}

// Behind each other, back to back, and one that faces away.
TEST(MeansOfLights, StackedRectangles) {
  Scene scene = spot();
  for (const float z : {1.0f, 1.0001f, 1.01f, 2.0f})
    add_lamp(scene, {flat(-1, 1, -1, 1, z, false)}, AreaLight{ConstantSpectrum{1}});
  // What of the last is seen beside the first.
  const double first = rectangle(-1, 1, -1, 1, 1);
  expect_irradiance("a stack", scene, first);
  add_lamp(scene, {flat(-1, 1, -1, 1, 0.5f, true)}, AreaLight{ConstantSpectrum{5}});
  expect_irradiance("a stack behind a back", scene, 0);
}

// ---- Quadrics

void add_lamp(Scene& scene, const Quadric& quadric, const Transform& to, const AreaLight& light,
              const Material& material = black) {
  scene.meshes.emplace_back().quadric = quadric;
  add_shape(scene, {static_cast<std::uint32_t>(scene.meshes.size() - 1)}, material, light);
  scene.shapes.back().object_to_world = to;
}

Transform ball(Point3d center, double radius) {
  return translate(center - Point3d{}) * scale({radius, radius, radius});
}

// Of a sphere of radiance 1 that is seen under the half angle asin(1/d), whose centre is seen at `cosine`
// from the normal; also where the horizon cuts it (Lagarde & de Rousiers 2014).
double sphere(double d, double cosine) {
  const double sin2 = 1 / (d * d);
  if (cosine * cosine >= sin2) return pi * sin2 * std::max(0.0, cosine);
  const double sine = std::sqrt(1 - cosine * cosine), x = std::sqrt(d * d - 1), y = -x * cosine / sine;
  const double root = sine * std::sqrt(1 - y * y);
  return (cosine * std::acos(y) - x * root) * sin2 + std::atan(root / x);
}

TEST(MeansOfLights, Spheres) {
  for (const double radius : {1e-3, 0.1, 3.0})
    for (const double d : {1.01, 2.0, 50.0, 1e6})
      for (const double cosine : {1.0, 0.5, 0.05, -0.3}) {
        const double expected = sphere(d, cosine), distance = d * radius,
                     sine = std::sqrt(1 - cosine * cosine);
        // Not around the camera; the spot stays where floats are fine.
        if (!(expected > 0) || distance - radius < 0.02 || (distance > 1e4 && cosine < 1)) continue;
        Scene scene = spot();
        keep_in_the_middle(scene, static_cast<float>(1.5 * distance));
        add_lamp(scene, {}, ball({sine * distance, 0, cosine * distance}, radius),
                 AreaLight{ConstantSpectrum{static_cast<float>(1 / expected)}});
        expect_irradiance(fmt::format("a sphere of {} at {} radii, {}", radius, d, cosine).c_str(), scene, 1);
      }
}

// What stands right before a lamp shadows it, and it does not shadow itself. From far away rays are rounded
// by a third of its radius, and ends by a tenth.
TEST(MeansOfLights, CoveredSpheres) {
  struct Case {
    double distance, radius, gap;
  };
  for (const Case& c : {Case{0.5, 0.125, 0.1}, Case{0.5, 0.125, 1e-4}, Case{20, 5, 1e-4}, Case{1e3, 1, 1e-4},
                        Case{1e3, 1e-3, 0.3}}) {
    Scene scene = spot();
    keep_in_the_middle(scene, static_cast<float>(1.5 * c.distance));
    const double all = sphere(c.distance / c.radius, 1);
    add_lamp(scene, {}, ball({0, 0, c.distance}, c.radius),
             AreaLight{ConstantSpectrum{static_cast<float>(1 / all)}});
    expect_irradiance("a bare sphere", scene, 1);
    // A shell around its half.
    Quadric half;
    half.low = 0;
    scene.meshes.emplace_back().quadric = half;
    add_shape(scene, {static_cast<std::uint32_t>(scene.meshes.size() - 1)}, black);
    scene.shapes.back().object_to_world =
        ball({0, 0, c.distance}, c.radius * (1 + c.gap)) * rotate(pi / 2, {0, 1, 0});
    expect_irradiance("a sphere whose half is covered", scene, 0.5);
  }
}

// A room that is a lamp: its walls get of each other what they give.
TEST(MeansOfLights, SpheresFromInside) {
  for (const bool two_sided : {false, true}) {
    Scene scene = spot();
    AreaLight light{ConstantSpectrum{1}};
    light.two_sided = two_sided;
    add_lamp(scene, {}, ball({0.5, 0.3, 0.2}, 2), light);
    scene.shapes.back().flip_orientation = !two_sided;
    expect_irradiance("in a sphere", scene, pi);
  }
  // Seen from inside on its own white wall: its own light and what one reflection adds.
  Scene scene = spot();
  scene.shapes.clear();
  add_lamp(scene, {}, ball({0, 0, 2}, 2), AreaLight{ConstantSpectrum{1}}, Material{DiffuseMaterial{one}});
  scene.shapes.back().flip_orientation = true;
  scene.settings.max_depth = 1;
  const Brightness seen = brightness(render(scene, 256).film);
  EXPECT_NEAR(seen.mean, 2, 4 * seen.standard_error + 4e-4);
}

TEST(MeansOfLights, OtherQuadrics) {
  // A disk above the spot, and beside it (Howell, Menguc & Daun, B-13).
  const auto disk = [](double h, double a) {
    const double s = h * h + a * a;
    return pi / 2 * (1 - (s - 1) / std::sqrt((s + 1) * (s + 1) - 4 * a * a));
  };
  Quadric q;
  q.kind = QuadricKind::disk, q.low = 0;
  for (const double h : {0.1, 2.0})
    for (const double a : {0.0, 1.7}) {
      Scene scene = spot();
      add_lamp(scene, q, translate({a, 0, h}) * rotate(pi, {1, 0, 0}), AreaLight{ConstantSpectrum{1}});
      expect_irradiance("a disk", scene, disk(h, a));
    }
  // Long tubes above it, one in front of the other.
  q = {};
  q.kind = QuadricKind::cylinder;
  Scene scene = spot();
  for (const double h : {3.0, 9.0})
    add_lamp(scene, q, translate({0, -3e3, h}) * rotate(-pi / 2, {1, 0, 0}) * scale({0.1 * h, 0.1 * h, 6e3}),
             AreaLight{ConstantSpectrum{h > 5 ? 8.0f : 1.0f}});
  expect_irradiance("a tube before another", scene, pi * 0.1);
  // An ellipsoid is lit as a sphere is where it is seen alike: under the same cone.
  scene = spot();
  const double d = 3, radius = 1, flat = 0.2;
  // A spheroid about z whose tangent cone from 0 has the half angle asin(1/d): ρ² = (z_c² − flat²)·tan².
  const double tan2 = 1 / (d * d - 1), wide = std::sqrt((d * d - flat * flat) * tan2);
  add_lamp(scene, {}, translate({0, 0, d * radius}) * scale({wide, wide, flat}),
           AreaLight{ConstantSpectrum{1}});
  expect_irradiance("an ellipsoid", scene, sphere(d, 1));
}

TEST(MeansOfLights, SpheresThatNothingMeets) {
  Scene scene = spot();
  add_lamp(scene, {}, ball({0, 0, 2}, 0.5), AreaLight{ConstantSpectrum{1}});
  MaskMaterial m;
  m.material = scene.shapes.back().material;
  m.opacity = 0.0f;
  scene.materials.push_back(Material{m});
  scene.shapes.back().material = {static_cast<std::uint32_t>(scene.materials.size() - 1)};
  expect_irradiance("an invisible sphere", scene, sphere(4, 1));
}

TEST(MeansOfLights, DirectionalRectangles) {
  for (const float z : {1.0f, 1e5f}) {
    Scene scene = spot();
    AreaLight light{ConstantSpectrum{2}};
    light.directional = true;
    add_lamp(scene, {flat(-1, 1, -1, 1, z, false)}, light);
    expect_irradiance("a directional rectangle", scene, 2);
  }
}

TEST(MeansOfLights, TexturedRectangles) {
  const Spectrum zero = ConstantSpectrum{0};
  Scene scene = spot();
  scene.textures.push_back(
      {BilinearTexture{zero, zero, ConstantSpectrum{2}, ConstantSpectrum{2}, UvMapping{}}, false, "", {}});
  CheckerboardTexture cells;
  cells.even = one;
  cells.odd = zero;
  cells.mapping = UvMapping{8, 0, 0, 0, 8, 0};
  scene.textures.push_back({cells, false, "", {}});
  const std::vector<Texture> textures = scene.textures;
  const double all = rectangle(-1, 1, -1, 1, 1);
  for (const std::uint32_t texture : {0u, 1u}) {
    scene = spot();
    scene.textures = textures;
    const auto mesh = add_quads(scene, {flat(-1, 1, -1, 1, 1, true)});
    scene.meshes[mesh.value].uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    AreaLight light;
    light.radiance = Id<Texture>{texture};
    light.two_sided = true;
    add_shape(scene, mesh, black, light);
    double expected = all;  // of the ramp: its middle, by symmetry
    if (texture == 1) {
      expected = 0;
      for (int x = 0; x < 8; ++x)
        for (int y = 0; y < 8; ++y)
          if ((x + y) % 2 == 0)
            expected += rectangle(x / 4.0 - 1, x / 4.0 - 0.75, y / 4.0 - 1, y / 4.0 - 0.75, 1);
    }
    expect_irradiance(texture == 0 ? "a ramp" : "cells", scene, expected);
  }
}

// ---- Images

// Of the octahedral square, as pbrt-v4 defines it (Clarberg 2008).
Vector3d equal_area(double s, double t) {
  const double u = 2 * s - 1, v = 2 * t - 1, d = 1 - (std::abs(u) + std::abs(v)), r = 1 - std::abs(d);
  const double phi = (r == 0 ? 1 : (std::abs(v) - std::abs(u)) / r + 1) * pi / 4;
  const double z = std::copysign(1 - r * r, d), scale = r * std::sqrt(2 - r * r);
  return {std::copysign(std::cos(phi), u) * scale, std::copysign(std::sin(phi), v) * scale, z};
}

struct Around {
  TemporaryDirectory folder;
  int width, height;
  Image image;
  std::filesystem::path file = folder / "around.exr";
  Around(int w, int h) : width(w), height(h), image(black_image(w, h, 3)) {
    for (std::size_t i = 0; i < image.pixels(); ++i)
      for (std::size_t c = 0; c < 3; ++c)
        image.values[3 * i + c] = static_cast<float>(0.1 + static_cast<double>(i * i * 7919 % 101) / 50);
    write_exr_image(file, image);
  }
  double texel(int x, int y) const {
    return static_cast<double>(
        image.values[3 * static_cast<std::size_t>(y * width + (x % width + width) % width)]);
  }
  // By latitude and longitude, the first and the last row on the poles.
  double bilinear(Vector3d d) const {
    double u = std::atan2(d.y, d.x) / (2 * pi);
    if (u < 0) u += 1;
    const double x = u * width - 0.5, y = std::acos(std::clamp(d.z, -1.0, 1.0)) / pi * (height - 1);
    const int x0 = static_cast<int>(std::floor(x)), y0 = std::min(static_cast<int>(y), height - 2);
    const double fx = x - x0, fy = y - y0;
    return (texel(x0, y0) * (1 - fx) + texel(x0 + 1, y0) * fx) * (1 - fy) +
           (texel(x0, y0 + 1) * (1 - fx) + texel(x0 + 1, y0 + 1) * fx) * fy;
  }
  // ∫ L max(0, d·up) dω.
  double irradiance(EnvironmentLight::Projection projection, Vector3d up) const {
    double sum = 0;
    if (projection == EnvironmentLight::Projection::equal_area) {
      constexpr int fine = 1024;
      for (int y = 0; y < fine; ++y)
        for (int x = 0; x < fine; ++x)
          sum += texel(x * width / fine, y * height / fine) *
                 std::max(0.0, dot(equal_area((x + 0.5) / fine, (y + 0.5) / fine), up)) * 4 * pi / fine /
                 fine;
      return sum;
    }
    constexpr int rows = 800, columns = 1600;
    for (int y = 0; y < rows; ++y)
      for (int x = 0; x < columns; ++x) {
        const double theta = pi * (y + 0.5) / rows, phi = 2 * pi * (x + 0.5) / columns;
        const Vector3d d{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
        sum += bilinear(d) * std::max(0.0, dot(d, up)) * std::sin(theta) * (pi / rows) * (2 * pi / columns);
      }
    return sum;
  }
};

TEST(MeansOfLights, EnvironmentImages) {
  using Projection = EnvironmentLight::Projection;
  for (const Projection projection : {Projection::equal_area, Projection::latitude_longitude}) {
    const Around around(16, projection == Projection::equal_area ? 16 : 9);
    for (const Transform& to_world :
         {Transform{}, rotate(1.1, {1, 2, 3}), rotate(0.4, {0, 1, 0}) * scale({1, -1, 1})}) {
      EnvironmentLight light;
      light.filename = around.file.string();
      light.projection = projection;
      light.light_to_world = to_world;
      light.scale = ConstantSpectrum{2};
      const Vector3d up = transform_vector(inverse(to_world), {0, 0, 1});
      const double expected = 2 * around.irradiance(projection, up);
      Scene scene = under(light);
      expect_irradiance("an environment", scene, expected);
      // Two of them, a sun and a lamp: every kind of choice.
      scene.lights.push_back(scene.lights[0]);
      scene.lights.push_back(Light{DistantLight{{0, 0, -1}, one}, {}});
      scene.lights.push_back(Light{PointLight{{0, 0, 2}, ConstantSpectrum{4}}, {}});
      scene.lights.push_back(Light{InfiniteLight{one}, {}});
      expect_irradiance("and others", scene, 2 * expected + 2 + pi);
    }
  }
}

// The intensity towards the spot is what the image has in that direction; a map's +z is the light's +y.
TEST(MeansOfLights, Goniometric) {
  for (const bool latitude_longitude : {false, true}) {
    const Around around(8, latitude_longitude ? 5 : 8);
    for (const double distance : {1.0, far}) {
      GoniometricLight light;
      light.filename = around.file.string();
      light.latitude_longitude = latitude_longitude;
      light.intensity = ConstantSpectrum{static_cast<float>(distance * distance)};
      const Transform turned = rotate(0.8, {3, 1, 2});
      light.light_to_world = translate({0, 0, distance}) * turned;
      const Vector3d d = transform_vector(inverse(turned), {0, 0, -1}), map{d.x, d.z, d.y};
      double expected = around.bilinear(map);
      if (!latitude_longitude) {
        double nearest = 2;
        for (int y = 0; y < 512; ++y)
          for (int x = 0; x < 512; ++x) {
            const double off = length(equal_area((x + 0.5) / 512, (y + 0.5) / 512) - map);
            if (off < nearest) nearest = off, expected = around.texel(x / 64, y / 64);
          }
      }
      expect_irradiance("goniometric", under(light), expected);
    }
  }
}

TEST(MeansOfLights, Projectors) {
  Scene scene = spot();
  const Spectrum zero = ConstantSpectrum{0};
  scene.textures.push_back(
      {BilinearTexture{zero, zero, ConstantSpectrum{2}, ConstantSpectrum{2}, UvMapping{}}, false, "", {}});
  for (const bool irradiance : {false, true})
    for (const double distance : {2.0, far}) {
      ProjectionLight light;
      light.image = Id<Texture>{0};
      light.fov_deg = 60;
      light.irradiance = irradiance;
      light.scale = ConstantSpectrum{static_cast<float>(distance * distance)};
      // The spot is seen at tan = .3 to its left or right: s = .5 ± .5·.3/tan 30°.
      light.light_to_world = look_at({0, 0, distance}, Point3d{0.3 * distance, 0, 0}, {0, 1, 0});
      const Vector3d d = transform_vector(inverse(light.light_to_world), {0, 0, -1});
      const double s = 0.5 + 0.5 * d.x / d.z / std::tan(pi / 6);
      const double intensity = 2 * s * (irradiance ? pi / (d.z * d.z * d.z) : 1);
      Scene lit = scene;
      lit.lights.push_back(Light{light, {}});
      expect_irradiance("a projector", lit, intensity);
    }
}

}  // namespace
}  // namespace vitrail::test::means_of_lights_test
