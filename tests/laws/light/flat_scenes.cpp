// SPDX-License-Identifier: Apache-2.0
#include "tests/laws/light/flat_scenes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/geometry/portable_math.h"
#include "tests/support/long_tests.h"

namespace vitrail::test {

Mean mean_of(const Film& film) {
  const auto pixels = static_cast<std::uint32_t>(film.width() * film.height());
  Mean m;
  XYZ squares;
  for (std::uint32_t i = 0; i < pixels; ++i) {
    const XYZ v = film.mean(i);
    m.value.x += v.x / pixels, m.value.y += v.y / pixels, m.value.z += v.z / pixels;
    squares.x += v.x * v.x / pixels, squares.y += v.y * v.y / pixels, squares.z += v.z * v.z / pixels;
  }
  const auto error = [&](double square, double mean) {
    return std::sqrt(std::max(0.0, square - mean * mean) / (pixels - 1));
  };
  m.error = {error(squares.x, m.value.x), error(squares.y, m.value.y), error(squares.z, m.value.z)};
  return m;
}

void expect_luminance(const Mean& found, double expected, double precision, const std::string& what,
                      double slack) {
  EXPECT_NEAR(found.value.y, expected, 4.5 * found.error.y + slack * expected) << what;
  EXPECT_LE(found.error.y, precision * expected) << what;
}

Vector3d direction(double theta_deg, double phi_deg) {
  const double t = theta_deg * pi / 180, p = phi_deg * pi / 180;
  return {std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t)};
}

void look_along(Scene& scene, Vector3d out, Point3d target, double half_width) {
  OrthographicCamera camera;
  const Vector3d up = std::abs(out.y) < 0.9 ? Vector3d{0, 1, 0} : Vector3d{1, 0, 0};
  camera.camera_to_world = look_at(target + out * 20.0, target, up);
  camera.screen = {-half_width, half_width, -half_width, half_width};
  scene.camera = camera;
  scene.film.width = scene.film.height = 16;
  scene.film.crop = {0, 16, 0, 16};
  scene.film.filter = BoxFilter{};
}

Id<TriangleMesh> square(Scene& scene, float z, float half_width, float x) {
  const float w = half_width;
  return add_quads(scene, {{{{x - w, -w, z}, {x + w, -w, z}, {x + w, w, z}, {x - w, w, z}}}});
}

namespace {

Mean plane_under(const LightModel& light, const Material& material, Vector3d out, int samples) {
  Scene scene;
  add_shape(scene, square(scene, 0), material);
  scene.lights.resize(1);
  scene.lights[0].model = light;
  look_along(scene, out);
  scene.settings.max_depth = 1;
  return mean_of(render(scene, of_all(samples, samples / 2)).film);
}

}  // namespace

Mean lit_plane(const Material& material, Vector3d out, Vector3d in, int samples) {
  return plane_under(DistantLight{-in, ConstantSpectrum{1}}, material, out, samples);
}

Mean plane_under_sky(const Material& material, Vector3d out, int samples) {
  return plane_under(InfiniteLight{ConstantSpectrum{1}}, material, out, samples);
}

double over_sphere(const std::function<double(Vector3d)>& value, int rings) {
  double sum = 0;
  for (int i = 0; i < 2 * rings; ++i)
    for (int j = 0; j < 2 * rings; ++j) {
      const double z = (i + 0.5) / rings - 1, r = std::sqrt(1 - z * z), phi = (j + 0.5) / rings;
      sum += value({r * sin_pi(phi + 0.5), r * sin_pi(phi), z});
    }
  return sum * pi / rings / rings;
}

}  // namespace vitrail::test
