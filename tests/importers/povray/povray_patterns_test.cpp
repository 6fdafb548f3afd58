// SPDX-License-Identifier: Apache-2.0
// POV-Ray shows of its own records, written, what they are here: lamps that fade, patterns.
#include <gmock/gmock.h>

#include "scene/geometry/pi.h"
#include "scene/models/fading.h"
#include "scene/models/pattern.h"
#include "tests/importers/povray/povray_oracle.h"

namespace vitrail::povray_patterns_test {
namespace {

using Kind = PatternTexture::Kind;
using Wave = PatternTexture::Wave;

using PovrayPatterns = PovrayOracle;

TEST_F(PovrayPatterns, FadingLamps) {
  for (const Fading fading : {Fading{}, Fading{1.5f, 2}, Fading{2, 1}, Fading{1, 3.5f}}) {
    Scene scene = plane();
    scene.lights.push_back({PointLight{{.5, -.25, 1.5}, emission_from_rgb({1, .75, .5}), fading}});
    expect_plane(scene, [&](double x, double y) -> std::array<double, 3> {
      const double dx = x - .5, dy = y + .25, d = std::sqrt(dx * dx + dy * dy + 2.25);
      const double factor = 1.5 / d / pi * weakened(fading, d);
      return {.8 * factor, .75 * .5 * factor, .5 * .25 * factor};
    });
  }
}

TEST_F(PovrayPatterns, TightSpot) {
  Scene scene = plane();
  SpotLight spot;
  spot.light_to_world = translate({0, 0, 2}) * scale({1, 1, -1});
  spot.intensity = emission_from_rgb({3, 3, 3});
  spot.beam_deg = 15;
  spot.cutoff_deg = 60;
  spot.fading = Fading{};
  spot.tightness = 4;
  scene.lights.push_back({spot});
  expect_plane(scene, [](double x, double y) -> std::array<double, 3> {
    const double c = 2 / std::sqrt(x * x + y * y + 4);
    const double outer = std::cos(pi / 3), inner = std::cos(pi / 12);
    const double s = std::clamp((c - outer) / (inner - outer), 0.0, 1.0);
    const double factor = 3 * c / pi * s * s * (3 - 2 * s) * std::pow(c, 4);
    return {.8 * factor, .5 * factor, .25 * factor};
  });
}

// A plane that glows by the pattern and is lit by nothing.
Scene glowing(const PatternTexture& pattern) {
  Scene scene = empty_povray_scene();
  scene.textures.push_back({pattern});
  AreaLight light;
  light.radiance = Id<Texture>{0};
  light.sampled = false;
  light.two_sided = true;
  scene.area_lights.push_back(light);
  add(scene, square(-5, 5, -5, 5, 0), DiffuseMaterial{ConstantSpectrum{0}});
  scene.shapes.back().area_light = Id<AreaLight>{0};
  return scene;
}

TEST_F(PovrayPatterns, AreWrittenAsTheyAre) {
  for (const Kind kind : {Kind::gradient, Kind::boxed,   Kind::cylindrical, Kind::planar,  Kind::spherical,
                          Kind::leopard,  Kind::marble,  Kind::onion,       Kind::radial,  Kind::spiral1,
                          Kind::wood,     Kind::mandel,  Kind::checker,     Kind::hexagon, Kind::brick,
                          Kind::agate,    Kind::bozo,    Kind::bumps,       Kind::cells,   Kind::crackle,
                          Kind::dents,    Kind::granite, Kind::ripples,     Kind::waves,   Kind::wrinkles}) {
    PatternTexture pattern;
    pattern.kind = kind;
    pattern.wave = kind == Kind::wood || kind == Kind::marble ? Wave::triangle : Wave::ramp;
    pattern.direction = {1, .5, .25};
    pattern.frequency = kind == Kind::gradient ? 1.5f : 1;
    pattern.arms = 2;
    if (kind == Kind::granite || kind == Kind::bozo) pattern.noise = NoiseGenerator::original;
    if (kind == Kind::bozo || kind == Kind::marble) pattern.turbulence.amount = {.5, .2, .3};
    pattern.brick = {{1, .6, .7}, .1f};
    pattern.texture_to_world = translate({.31, .17, -.23}) * scale({1.3, 1.1, .9});
    pattern.map = {{0, emission_from_rgb({.1, .2, .3})}, {1, emission_from_rgb({.9, .6, .4})}};
    if (kind == Kind::hexagon) pattern.map.push_back({1, emission_from_rgb({.5, .5, .5})});
    const Transform to_texture = inverse(pattern.texture_to_world);
    const std::array<std::array<double, 3>, 3> colors{{{.1, .2, .3}, {.9, .6, .4}, {.5, .5, .5}}};
    SCOPED_TRACE(static_cast<int>(kind));
    const PovPicture picture = render_povray(glowing(pattern), folder_);
    ASSERT_FALSE(picture.values.empty());
    // But for the pixels whose middle is at an edge.
    int unlike = 0;
    for (int x = 0; x < 32; ++x)
      for (int y = 0; y < 32; ++y) {
        const PatternMix mix = pattern_mix(pattern, transform_point(to_texture, {plane_x(x), plane_y(y), 0}));
        const std::array<double, 3> seen = picture.at(x, y);
        bool same = true;
        for (std::size_t c = 0; c < 3; ++c) {
          const double wanted = (1 - mix.amount) * colors[mix.first][c] + mix.amount * colors[mix.second][c];
          same = same && std::abs(seen[c] - wanted) < 2e-3;
        }
        unlike += !same;
      }
    EXPECT_LE(unlike, kind == Kind::mandel ? 20 : 3);
  }
}

}  // namespace
}  // namespace vitrail::povray_patterns_test
