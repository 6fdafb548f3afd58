// SPDX-License-Identifier: Apache-2.0
// A thin beam through a 60° prism of BK7: each wavelength has to land where Snell's law sends it.
#include <gtest/gtest.h>

#include "scene/color.h"
#include "scene/named_spectra.h"
#include "tests/support/render.h"
#include "tracer/portable_math.h"

namespace vitrail::test {
namespace {

constexpr double apex = pi / 3;
constexpr double incidence = 0.86;  // rad, near minimum deviation
constexpr double screen_distance = 500;

// Exit angle against the normal of the second face, and what the two faces let through.
struct Passage {
  double exit_angle = 0, transmittance = 0;
};

double transmitted(double cosine_in, double cosine_out, double n_in, double n_out) {
  const double s = (n_in * cosine_in - n_out * cosine_out) / (n_in * cosine_in + n_out * cosine_out);
  const double p = (n_in * cosine_out - n_out * cosine_in) / (n_in * cosine_out + n_out * cosine_in);
  return 1 - (s * s + p * p) / 2;
}

Passage through_prism(double lambda_nm) {
  const double n = evaluate(bk7(), lambda_nm);
  const double first = std::asin(std::sin(incidence) / n), second = apex - first;
  const double exit = std::asin(n * std::sin(second));
  return {exit, transmitted(std::cos(incidence), std::cos(first), 1, n) *
                    transmitted(std::cos(second), std::cos(exit), n, 1)};
}

// Deviation from the incident direction.
double deviation(double lambda_nm) { return incidence + through_prism(lambda_nm).exit_angle - apex; }

// The prism stands on the plane y = 0 with its apex up; the beam comes from −x and is bent down, towards its
// base. A strip on a far screen shines from the deviation at `lambda0` to that at `lambda1`.
Scene prism_scene(double lambda0, double lambda1) {
  Scene scene;
  const double half = std::tan(apex / 2);
  const auto prism_point = [&](double x, double y, double z) {
    return Point3f{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
  };
  const Point3f a0 = prism_point(-half, -1, -1), b0 = prism_point(half, -1, -1), c0 = prism_point(0, 0, -1);
  const Point3f a1 = prism_point(-half, -1, 1), b1 = prism_point(half, -1, 1), c1 = prism_point(0, 0, 1);
  add_shape(scene, add_quads(scene, {{{a0, a1, c1, c0}}, {{b0, c0, c1, b1}}, {{a0, b0, b1, a1}}}),
            Material{DielectricMaterial{bk7()}});

  // The left face's outward normal makes the angle apex/2 with −x, up; incidence is measured from it, from
  // below.
  const double tilt = incidence - apex / 2;  // of the beam above the horizontal
  const Vector3d beam{std::cos(tilt), std::sin(tilt), 0};
  const Point3d target{-half / 2, -0.5, 0};
  OrthographicCamera camera;
  camera.camera_to_world = look_at(target - beam * 3.0, target, {0, 0, 1});
  camera.screen = {-2e-4, 2e-4, -2e-4, 2e-4};
  scene.camera = camera;
  scene.film.width = scene.film.height = 4;
  scene.film.crop = {0, 4, 0, 4};
  scene.film.filter = BoxFilter{};
  scene.settings.max_depth = 2;  // two refractions and nothing else

  const auto on_screen = [&](double lambda, double z) {
    // Where the ray of this wavelength leaves the prism, then on in its deviated direction.
    const double n = evaluate(bk7(), lambda), first = std::asin(std::sin(incidence) / n);
    const double inside = apex / 2 - first;  // below the horizontal: normal turned towards the base
    const Vector3d d{std::cos(inside), -std::sin(inside), 0};
    // Right face: x = −half·y. target + s·d on it.
    const double s = -(target.x + half * target.y) / (d.x + half * d.y);
    const Point3d leaves = target + d * s;
    const double angle = tilt - deviation(lambda);
    const Point3d far = leaves + Vector3d{std::cos(angle), std::sin(angle), 0} * screen_distance;
    return prism_point(far.x, far.y, z);
  };
  add_shape(scene,
            add_quads(scene, {{{on_screen(lambda0, -10), on_screen(lambda0, 10), on_screen(lambda1, 10),
                                on_screen(lambda1, -10)}}}),
            Material{DiffuseMaterial{ConstantSpectrum{0}}}, AreaLight{ConstantSpectrum{1}, true});
  return scene;
}

TEST(Prism, EachWavelengthLandsWhereSnellSendsIt) {
  for (const double lambda0 : {420.0, 470.0, 520.0, 570.0, 620.0, 660.0}) {
    const double lambda1 = lambda0 + 30;
    XYZ expected;
    for (double lambda = lambda0 + 0.05; lambda < lambda1; lambda += 0.1) {
      const auto at = static_cast<std::size_t>(lambda - lambda_min_nm);
      const double f = lambda - lambda_min_nm - static_cast<double>(at);
      const double weight = 0.1 / cie_y_integral_nm * through_prism(lambda).transmittance;
      const auto cmf = [&](std::size_t c) { return (1 - f) * cie_1931()[at][c] + f * cie_1931()[at + 1][c]; };
      expected.x += weight * cmf(0);
      expected.y += weight * cmf(1);
      expected.z += weight * cmf(2);
    }
    const Rendered rendered = render(prism_scene(lambda0, lambda1), 4096);
    XYZ mean;
    for (std::uint32_t i = 0; i < 16; ++i) {
      const XYZ pixel = rendered.film.mean(i);
      mean.x += pixel.x / 16;
      mean.y += pixel.y / 16;
      mean.z += pixel.z / 16;
    }
    const double largest = std::max({expected.x, expected.y, expected.z});
    EXPECT_NEAR(mean.x, expected.x, 0.01 * largest) << lambda0;
    EXPECT_NEAR(mean.y, expected.y, 0.01 * largest) << lambda0;
    EXPECT_NEAR(mean.z, expected.z, 0.01 * largest) << lambda0;
  }
}

}  // namespace
}  // namespace vitrail::test
