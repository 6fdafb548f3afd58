// SPDX-License-Identifier: Apache-2.0
// What a white spot gets of every kind of light where a medium that absorbs lies on the way: around the
// light, before it, across it, around the spot, around everything and without end; against quadrature.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "images/image_files.h"
#include "scene/geometry/portable_math.h"
#include "tests/laws/light/flat_scenes.h"
#include "tests/laws/light/media_scenes.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::lights_in_media_test {
namespace {

const Material black{DiffuseMaterial{ConstantSpectrum{0}}};
const Spectrum one = ConstantSpectrum{1};
constexpr double height = 3;
const Point3d spot{0, 0, 0}, lamp{0, 0, height};
const Vector3d seen_from = direction(45);

// A light, and what of its irradiance on the spot comes from where.
struct Lit {
  std::string name;
  std::function<void(Scene&)> add;
  struct Part {
    Point3d from;
    double irradiance;
  };
  std::vector<Part> parts;
  bool is_far = false;
};

Lit of_light(std::string name, LightModel model, std::vector<Lit::Part> parts, bool is_far = false) {
  return {std::move(name),
          [=](Scene& scene) {
            scene.lights.push_back(Light{model, {}});
          },
          std::move(parts), is_far};
}

std::vector<Lit> point_lights(const std::string& image) {
  const std::vector<Lit::Part> parts{{lamp, 1 / (height * height)}};
  std::vector<Lit> all{of_light("point", PointLight{lamp, one}, parts)};
  all.push_back(of_light("point without fall-off", PointLight{lamp, one, Fading{}}, {{lamp, 1}}));
  SpotLight beam;
  beam.light_to_world = look_at(lamp, spot, {0, 1, 0});
  beam.intensity = one;
  all.push_back(of_light("spot", beam, parts));
  GoniometricLight around;
  around.light_to_world = translate(lamp - Point3d{});
  around.intensity = one;
  around.filename = image;
  all.push_back(of_light("goniometric", around, parts));
  all.push_back(
      {"projector",
       [](Scene& scene) {
         scene.textures.push_back({BilinearTexture{one, one, one, one, UvMapping{}}, false, "", {}});
         ProjectionLight light;
         light.image = Id<Texture>{static_cast<std::uint32_t>(scene.textures.size() - 1)};
         light.light_to_world = look_at(lamp, spot, {0, 1, 0});
         scene.lights.push_back(Light{light, {}});
       },
       parts});
  return all;
}

// Of radiance 1, `half` wide or of this radius.
constexpr double half = 0.4;
constexpr int fine = 100;

Lit square_lamp() {
  Lit lit{"mesh", {}, {}};
  lit.add = [](Scene& scene) {
    const auto w = static_cast<float>(half), z = static_cast<float>(height);
    add_shape(scene, add_quads(scene, {{{{-w, w, z}, {w, w, z}, {w, -w, z}, {-w, -w, z}}}}), black,
              AreaLight{one});
  };
  for (int i = 0; i < fine; ++i)
    for (int j = 0; j < fine; ++j) {
      const Point3d p{half * ((2 * i + 1.0) / fine - 1), half * ((2 * j + 1.0) / fine - 1), height};
      const double r2 = dot(p - spot, p - spot);
      lit.parts.push_back({p, 4 * half * half / fine / fine * height * height / (r2 * r2)});
    }
  return lit;
}

Lit disk_lamp() {
  Lit lit{"disk", {}, {}};
  lit.add = [](Scene& scene) {
    Quadric disk;
    disk.kind = QuadricKind::disk, disk.low = 0;
    add_quadric(scene, disk, translate(lamp - Point3d{}) * rotate(pi, {1, 0, 0}) * scale({half, half, half}),
                black, AreaLight{one});
  };
  for (int i = 0; i < fine; ++i)
    for (int j = 0; j < fine; ++j) {
      const double r = half * std::sqrt((i + 0.5) / fine), phi = 2 * pi * (j + 0.5) / fine;
      const Point3d p{r * std::cos(phi), r * std::sin(phi), height};
      const double r2 = dot(p - spot, p - spot);
      lit.parts.push_back({p, pi * half * half / fine / fine * height * height / (r2 * r2)});
    }
  return lit;
}

Lit ball_lamp() {
  Lit lit{"ball", [](Scene& scene) { add_quadric(scene, {}, ball(lamp, half), black, AreaLight{one}); }, {}};
  const double sine2 = half * half / (height * height);
  for (int i = 0; i < fine; ++i)
    for (int j = 0; j < fine; ++j) {
      const double s2 = sine2 * (i + 0.5) / fine, s = std::sqrt(s2), c = std::sqrt(1 - s2);
      const double phi = 2 * pi * (j + 0.5) / fine,
                   r = height * c - std::sqrt(half * half - height * height * s2);
      lit.parts.push_back({{r * s * std::cos(phi), r * s * std::sin(phi), r * c}, pi * sine2 / fine / fine});
    }
  return lit;
}

std::vector<Lit> far_lights() {
  constexpr double far = 1e4;
  const Vector3d to_sun = direction(20, 180);
  std::vector<Lit> all{
      of_light("distant", DistantLight{-to_sun, one}, {{spot + to_sun * far, to_sun.z}}, true)};
  std::vector<Lit::Part> sky;
  for (int i = 0; i < fine; ++i)
    for (int j = 0; j < 4 * fine; ++j) {
      const double s = std::sqrt((i + 0.5) / fine), phi = 2 * pi * (j + 0.5) / (4 * fine);
      const Vector3d d{s * std::cos(phi), s * std::sin(phi), std::sqrt(1 - s * s)};
      sky.push_back({spot + d * far, pi / fine / (4 * fine)});
    }
  all.push_back(of_light("infinite", InfiniteLight{one}, std::move(sky), true));
  return all;
}

std::vector<Lit> all_lights(const std::string& image) {
  std::vector<Lit> all = point_lights(image);
  for (Lit& lit : far_lights()) all.push_back(std::move(lit));
  all.push_back(square_lamp());
  all.push_back(disk_lamp());
  all.push_back(ball_lamp());
  return all;
}

class LightsInMedia : public testing::Test {
 protected:
  LightsInMedia() : image(folder / "one.exr") {
    Image white = black_image(4, 4, 3);
    std::ranges::fill(white.values, 1.0f);
    write_exr_image(image, white);
  }

  void expect_weakened(const Lit& lit, const MediumPlace& place, bool grid, bool direct_only = false) {
    Scene scene;
    add_shape(scene, square(scene, 0, 0.02f), Material{DiffuseMaterial{one}});
    lit.add(scene);
    // Far off: what is as wide as the scene is not what is as far as the light.
    add_shape(scene, square(scene, -1, 0.01f, 30), black);
    fill(scene, place, grid);
    look_along(scene, seen_from, spot, 1e-4);
    scene.settings.max_depth = 1;
    scene.settings.direct_only = direct_only;
    double irradiance = 0;
    for (const Lit::Part& part : lit.parts) irradiance += part.irradiance * through(place, spot, part.from);
    const double expected = irradiance / pi * through(place, spot, spot + seen_from * 20.0);
    const bool is_point = lit.parts.size() == 1;
    const Mean found = mean_of(render(scene, is_point ? (grid ? 64 : 4) : 64).film);
    const auto what = fmt::format("{}, medium {}{}{}", lit.name, place.name, grid ? ", grid" : "",
                                  direct_only ? ", direct" : "");
    fmt::print("{}: {:.6g} ± {:.2g} of {:.6g}\n", what, found.value.y, found.error.y, expected);
    expect_luminance(found, expected, grid ? 0.02 : 0.01, what, 1e-3);
  }

  TemporaryDirectory folder;
  std::string image;
};

TEST_F(LightsInMedia, WhereverTheMediumIs) {
  for (const Lit& lit : all_lights(image))
    for (const bool round : {false, true})
      for (const MediumPlace& place : places(lamp, round)) expect_weakened(lit, place, false);
}

TEST_F(LightsInMedia, Grids) {
  for (const Lit& lit : all_lights(image))
    for (const MediumPlace& place : places(lamp, true))
      if (place.reach < 2) expect_weakened(lit, place, true);
}

TEST_F(LightsInMedia, WithoutEnd) {
  for (const Lit& lit : all_lights(image))
    if (!lit.is_far)
      for (const bool grid : {false, true}) expect_weakened(lit, endless(grid ? 0.01 : 0.1), grid);
}

TEST_F(LightsInMedia, DirectLightAlone) {
  for (const Lit& lit : all_lights(image))
    for (const MediumPlace& place : places(lamp, true)) expect_weakened(lit, place, false, true);
}

// A lamp within glass that absorbs, seen straight through its face: (1 − F)·e^(−σd)/η² of its radiance.
TEST_F(LightsInMedia, BehindAFaceOfGlass) {
  const MediumPlace cube{"in glass", lamp, 1, false, 0.5};
  for (const Lit& lit : {square_lamp(), disk_lamp()})
    for (const bool grid : {false, true})
      for (const bool direct_only : {false, true}) {
        Scene scene;
        lit.add(scene);
        fill(scene, cube, grid, Material{DielectricMaterial{}});
        look_along(scene, {0, 0, -1}, lamp, 1e-4);
        scene.settings.max_depth = 4;
        scene.settings.direct_only = direct_only;
        const Mean found = mean_of(render(scene, grid ? 4096 : 1024).film);
        expect_luminance(found, 0.96 * std::exp(-0.5) / 2.25, grid ? 0.02 : 0.005,
                         fmt::format("{}{}{}", lit.name, grid ? ", grid" : "", direct_only ? ", direct" : ""),
                         1e-3);
      }
}

// The same scenes as instances of a prototype: what is between is where the instance is.
TEST_F(LightsInMedia, WithinInstances) {
  for (const MediumPlace& place : places(lamp, true)) {
    if (place.reach > 2) continue;  // around the camera, which no instance holds
    Scene scene;
    add_shape(scene, square(scene, 0, 0.02f), Material{DiffuseMaterial{one}});
    scene.lights.push_back(Light{PointLight{lamp, one}, {}});
    const std::size_t before = scene.shapes.size();
    fill(scene, place, false);
    Prototype prototype;
    prototype.shapes.assign(scene.shapes.begin() + static_cast<std::ptrdiff_t>(before), scene.shapes.end());
    scene.shapes.resize(before);
    const Transform away = translate({5, -7, 2});
    for (Shape& shape : prototype.shapes) shape.object_to_world = inverse(away) * shape.object_to_world;
    scene.prototypes.push_back(prototype);
    scene.instances.push_back({Id<Prototype>{0}, away, {}});
    look_along(scene, seen_from, spot, 1e-4);
    scene.settings.max_depth = 1;
    const double expected =
        through(place, spot, lamp) / (height * height) / pi * through(place, spot, spot + seen_from * 20.0);
    expect_luminance(mean_of(render(scene, 4).film), expected, 0.01, "instance, medium " + place.name, 1e-3);
  }
}

}  // namespace
}  // namespace vitrail::test::lights_in_media_test
