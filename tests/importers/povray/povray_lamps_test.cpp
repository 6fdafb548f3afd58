// SPDX-License-Identifier: Apache-2.0
// Lamps as POV-Ray itself shows them of the files that are written.
#include <numbers>

#include "tests/importers/povray/povray_oracle.h"

namespace vitrail::povray_lamps_test {
namespace {

// The share of a plane's hemisphere that a square of ±half covers, whose middle is at (−x,−y) from the point
// and `height` above it.
double share_of_square(double x, double y, double half, double height) {
  constexpr int n = 200;
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double dx = half * (2 * (i + .5) / n - 1) - x, dy = half * (2 * (j + .5) / n - 1) - y;
      const double d2 = dx * dx + dy * dy + height * height;
      sum += height * height / (d2 * d2);
    }
  return sum * 4 * half * half / (n * n) / std::numbers::pi;
}

// A black square under the sky: what it hides of the sky is dark, but for its own light.
TEST_F(PovrayOracle, LampsThatAreSquaresHideTheSky) {
  Scene scene = plane();
  scene.lights.push_back({InfiniteLight{emission_from_rgb({.5, .5, .5})}});
  TriangleMesh lamp = square(-4, 4, -4, 4, 5);
  std::swap(lamp.positions[1], lamp.positions[3]);
  add_emitter(scene, lamp, {.2, .2, .2});
  expect_plane(
      scene,
      [](double x, double y) -> std::array<double, 3> {
        const double hidden = share_of_square(x, y, 4, 5), light = .5 * (1 - hidden) + .2 * hidden;
        return {.8 * light, .5 * light, .25 * light};
      },
      0.03);
}

// A floor beside a mirror has the light of the lamp and of its image.
TEST_F(PovrayOracle, MirrorsThrowTheLightOfLamps) {
  Scene scene = plane();
  scene.settings.max_depth = 3;
  TriangleMesh lamp = square(-1, 1, -1, 1, 5);
  std::swap(lamp.positions[1], lamp.positions[3]);
  add_emitter(scene, lamp, {8, 8, 8});
  add(scene, quad_mesh({-3, -9, 0}, {-3, 9, 0}, {-3, 9, 9}, {-3, -9, 9}),
      ConductorMaterial{PerfectReflector{}});
  expect_plane(
      scene,
      [](double x, double y) -> std::array<double, 3> {
        const double light = 8 * (share_of_square(x, y, 1, 5) + share_of_square(x + 6, y, 1, 5));
        return {.8 * light, .5 * light, .25 * light};
      },
      0.06);
}

// A ball of radius 1.2 and index 1.5 gathers the light of a small lamp in the middle of the plane: there is
// 31 times as much as without it by paraxial rays, less what the lamp's size blurs.
TEST_F(PovrayOracle, GlassGathersTheLightOfLamps) {
  Scene scene = plane();
  scene.settings.max_depth = 6;
  const auto middle = [&] { return render_povray(scene, folder_).at(16, 16)[0]; };
  Shape& lamp = add_emitter(scene, square(-.1f, .1f, -.1f, .1f, 0), {200, 200, 200});
  lamp.object_to_world = look_at({-6, 0, 6}, {0, 0, 0}, {0, 1, 0});
  const double without = middle();
  ASSERT_GT(without, 0.001);
  TriangleMesh ball;
  ball.quadric = Quadric{.kind = QuadricKind::sphere};
  add(scene, ball, DielectricMaterial{ConstantSpectrum{1.5f}}).object_to_world =
      translate({-3, 0, 3}) * scale({1.2, 1.2, 1.2});
  EXPECT_GT(middle(), 8 * without);
  EXPECT_LT(middle(), 31 * without);
}

// Light of a point goes straight through a ball of glass, photons or not.
TEST_F(PovrayOracle, PointsShineStraightThroughGlass) {
  Scene scene = plane();
  scene.settings.max_depth = 4;
  scene.lights.push_back({PointLight{{-6, 0, 6}, emission_from_rgb({20, 20, 20})}});
  add_emitter(scene, square(-9.1f, -9, -.1f, .1f, 9), {.001, .001, .001});
  const double without = render_povray(scene, folder_).at(16, 16)[0];
  TriangleMesh ball;
  ball.quadric = Quadric{.kind = QuadricKind::sphere};
  add(scene, ball, DielectricMaterial{ConstantSpectrum{1.5f}}).object_to_world =
      translate({-3, 0, 3}) * scale({1.2, 1.2, 1.2});
  EXPECT_NEAR(render_povray(scene, folder_).at(16, 16)[0], without, 0.1 * without);
}

// Nothing shows of a ball that scatters all light, under a sky of one radiance.
TEST_F(PovrayOracle, MediaScatterTheSky) {
  Scene scene = empty_povray_scene();
  scene.settings.max_depth = 8;
  Medium fog;
  fog.coefficients = AbsorptionScattering{ConstantSpectrum{0}, ConstantSpectrum{1}};
  scene.media.push_back(fog);
  TriangleMesh ball;
  ball.quadric = Quadric{.kind = QuadricKind::sphere};
  add(scene, ball, InterfaceMaterial{}).interior = Id<Medium>{0};
  scene.lights.push_back({InfiniteLight{emission_from_rgb({.6, .5, .4})}});
  const PovPicture picture = render_povray(scene, folder_);
  ASSERT_FALSE(picture.values.empty());
  for (const int x : {1, 10, 16, 20}) {
    const std::array<double, 3> seen = picture.at(x, 16);
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(seen[c], .6 - .1 * static_cast<double>(c), .02) << x << ' ' << c;
  }
}

}  // namespace
}  // namespace vitrail::povray_lamps_test
