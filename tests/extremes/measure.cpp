// SPDX-License-Identifier: Apache-2.0
#include "tests/extremes/measure.h"
#include "film/film_progress.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>

namespace vitrail::test {
namespace {

void judge(const std::string& what, double expected, double measured, double error, double limit,
           double noise) {
  const std::string noisy = noise > 0 ? fmt::format(" (noise {:.1e})", noise) : "";
  fmt::print("| {} | {:.9g} | {:.9g} | {:.1e}{} | {:.1e} |\n", what, expected, measured, error, noisy, limit);
  EXPECT_LE(error, limit + 4 * noise) << what << ": expected " << expected << ", measured " << measured;
}

// The film of a sky of 1 that has the samples of another.
const Film& white(int width, int height, int samples) {
  static std::map<std::array<int, 3>, Film> films;
  Film& film = films[{width, height, samples}];
  if (film.width() == 0) {
    Scene scene;
    add_shape(scene, add_quads(scene, {square_at(-1, 1)}), matte(0));
    add_sky(scene, 1);
    set_camera(scene, {0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 0.5, width, height);
    film = render(scene, samples).film;
  }
  return film;
}

}  // namespace

void expect_relative(const std::string& what, double expected, double measured, double limit, double noise) {
  const double size = std::abs(expected);
  judge(what, expected, measured, std::abs(measured - expected) / size, limit, noise / size);
}

void expect_absolute(const std::string& what, double expected, double measured, double limit, double noise) {
  judge(what, expected, measured, std::abs(measured - expected), limit, noise);
}

void expect_exactly(const std::string& what, double expected, double measured) {
  expect_absolute(what, expected, measured, 0);
}

void report(const std::string& what, double value, const std::string& unit) {
  fmt::print("| {} | | {:.9g} {} | | |\n", what, value, unit);
}

std::uint32_t pixels_of(const Film& film) { return static_cast<std::uint32_t>(film.width() * film.height()); }

FilmDifference picture_difference(const Film& a, const Film& b) {
  FilmDifference d;
  double sum_a = 0, sum_b = 0, squares = 0;
  const std::uint32_t pixels = pixels_of(a);
  for (std::uint32_t i = 0; i < pixels; ++i) {
    const XYZ x = a.mean(i), y = b.mean(i);
    sum_a += x.y, sum_b += y.y;
    squares += (x.y - y.y) * (x.y - y.y);
    d.pixels += x != y;
  }
  const auto count = static_cast<double>(pixels);
  d.mean = (sum_b - sum_a) / sum_a;
  d.root_mean_square = std::sqrt(squares / count) / (sum_a / count);
  return d;
}

Measured measured(const Film& film) {
  const Film& reference = white(film.width(), film.height(), static_cast<int>(film.samples(0)));
  const auto count = static_cast<double>(pixels_of(film));
  double sum = 0, all = 0, squares = 0;
  for (std::uint32_t i = 0; i < pixels_of(film); ++i) {
    sum += film.mean(i).y;
    all += reference.mean(i).y;
  }
  Measured result{sum / all, 0};
  for (std::uint32_t i = 0; i < pixels_of(film); ++i) {
    const double deviation = film.mean(i).y - result.mean * reference.mean(i).y;
    squares += deviation * deviation;
  }
  if (count > 1) result.standard_error = std::sqrt(squares / (count - 1) / count) * count / all;
  return result;
}

Measured measure(const Scene& scene, int samples_per_pixel, const std::string& name) {
  return measured(render_finite(scene, samples_per_pixel, name).film);
}

Rendered render_finite(const Scene& scene, int samples_per_pixel, const std::string& name,
                       std::uint32_t domains) {
  Rendered rendered = render(scene, samples_per_pixel, domains);
  EXPECT_EQ(rendered.stats.refused, Refused{}) << name;
  const char* directory = std::getenv("VITRAIL_EXTREMES_FILMS");
  if (directory && !name.empty())
    write_film(std::filesystem::path(directory) / (name + ".film"), rendered.film, FilmProgress{});
  return rendered;
}

void set_orthographic(Scene& scene, Point3d eye, Point3d target, Vector3d up, double half_width, int pixels) {
  OrthographicCamera camera;
  camera.camera_to_world = look_at(eye, target, up);
  camera.screen = {-half_width, half_width, -half_width, half_width};
  scene.camera = camera;
  scene.film.width = scene.film.height = pixels;
  scene.film.crop = {0, pixels, 0, pixels};
  scene.film.filter = BoxFilter{};
}

std::array<Point3f, 4> square_at(float z, float h) {
  return {{{-h, -h, z}, {h, -h, z}, {h, h, z}, {-h, h, z}}};
}

Material matte(float reflectance) { return {DiffuseMaterial{ConstantSpectrum{reflectance}}}; }

AreaLight lamp(double radiance, bool two_sided) {
  AreaLight light;
  light.radiance = Spectrum{ConstantSpectrum{static_cast<float>(radiance)}};
  light.two_sided = two_sided;
  return light;
}

namespace {

Spectrum flat(double value) { return ConstantSpectrum{static_cast<float>(value)}; }

}  // namespace

void add_sky(Scene& scene, double radiance) {
  scene.lights.emplace_back().model = InfiniteLight{flat(radiance)};
}

void add_sun(Scene& scene, Vector3d direction, double irradiance) {
  scene.lights.emplace_back().model = DistantLight{direction, flat(irradiance)};
}

void add_point(Scene& scene, Point3d position, double intensity) {
  scene.lights.emplace_back().model = PointLight{position, flat(intensity)};
}

bool run_whole() { return std::getenv("VITRAIL_EXTREMES_WHOLE") != nullptr; }

}  // namespace vitrail::test
