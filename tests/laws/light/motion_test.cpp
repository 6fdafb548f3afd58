// SPDX-License-Identifier: Apache-2.0
// Means over the time that the shutter is open, against closed forms and against pictures of many moments.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "scene/geometry/portable_math.h"
#include "tests/support/render.h"

namespace vitrail::test::motion_test {
namespace {

const Material black{DiffuseMaterial{ConstantSpectrum{0}}};
const AreaLight lamp{ConstantSpectrum{1}};
constexpr int size = 16;

// One unit a pixel along −z; column i has its centre at ±(i + ½ − size/2).
void see_parallel(Scene& scene, double height) {
  OrthographicCamera camera;
  camera.camera_to_world = look_at({0, 0, height}, {0, 0, 0}, {0, 1, 0});
  camera.screen = {-size / 2.0, size / 2.0, -size / 2.0, size / 2.0};
  scene.camera = camera;
  scene.film.width = scene.film.height = size;
  scene.film.crop = {0, size, 0, size};
  scene.film.filter = BoxFilter{};
  scene.settings.max_depth = 0;
}

Point2d place_of(const Scene& scene, double column, double row) {
  const Point3d p = transform_point(std::get<OrthographicCamera>(scene.camera).camera_to_world,
                                    {column - size / 2.0, size / 2.0 - row, 0});
  return {p.x, p.y};
}

// What is in the one prototype moves.
void move(Scene& scene, std::vector<Keyframe> keys) {
  scene.prototypes.resize(1);
  scene.prototypes[0].shapes = std::move(scene.shapes);
  scene.shapes.clear();
  scene.motions = {Motion(std::move(keys))};
  scene.instances = {{{0}, scene.motions[0].at(scene.shutter.open_s), {}, Id<Motion>{0}}};
}

// ∫ of the clamped line min(max(x, 0), 1).
double ramp(double x) { return x < 0 ? 0 : x < 1 ? x * x / 2 : x - 0.5; }

// Of a unit pixel at x, the mean share right of an edge that goes evenly from a to b.
double mean_beyond(double x, double a, double b) {
  const auto share = [&](double edge) { return ramp(x + 0.5 - edge); };
  return (share(a) - share(b)) / (b - a);
}

struct Column {
  double mean = 0, error = 0;
};
Column column_of(const Film& film, int x, int y0 = 0, int y1 = size) {
  Column c;
  for (int y = y0; y < y1; ++y) {
    const auto pixel = static_cast<std::uint32_t>(y * size + x);
    c.mean += film.mean(pixel).y / (y1 - y0);
    c.error += film.variance_of_mean(pixel) / (y1 - y0) / (y1 - y0);
  }
  c.error = std::sqrt(c.error);
  return c;
}

// A trapezoid: a shining patch of 3 units goes 5 units to the side while the shutter is open, and 2 before.
TEST(Motion, MovingPatch) {
  Scene scene;
  add_shape(scene, add_quads(scene, {{{{-4, -50, 0}, {-1, -50, 0}, {-1, 50, 0}, {-4, 50, 0}}}}), black, lamp);
  see_parallel(scene, 5);
  scene.shutter = {2, 4.5};
  move(scene, {{1, {}}, {5, translate({8, 0, 0})}});
  double worst = 0;
  for (const std::uint32_t domains : {1u, 5u}) {
    const Film film = render(scene, 1024, domains).film;
    for (int x = 0; x < size; ++x) {
      const double at = place_of(scene, x + 0.5, 0).x;
      const double expected = mean_beyond(at, -4 + 2, -4 + 7) - mean_beyond(at, -1 + 2, -1 + 7);
      const Column seen = column_of(film, x);
      EXPECT_NEAR(seen.mean, expected, 4 * seen.error + 1e-4) << x;
      worst = std::max(worst, std::abs(seen.mean - expected));
    }
  }
  fmt::print("off by {:.5f} at most\n", worst);
}

// The same where the camera goes the other way.
TEST(Motion, MovingCamera) {
  Scene scene;
  add_shape(scene, add_quads(scene, {{{{-4, -50, 0}, {-1, -50, 0}, {-1, 50, 0}, {-4, 50, 0}}}}), black, lamp);
  see_parallel(scene, 5);
  const Transform camera = std::get<OrthographicCamera>(scene.camera).camera_to_world;
  scene.shutter = {0, 0.5};
  scene.camera_motion = Motion({{0, camera}, {1, translate({6, 0, 0}) * camera}});
  const Film film = render(scene, 1024).film;
  for (int x = 0; x < size; ++x) {
    const double at = place_of(scene, x + 0.5, 0).x;
    const double expected = mean_beyond(at, -4 - 3, -4) - mean_beyond(at, -1 - 3, -1);
    const Column seen = column_of(film, x);
    EXPECT_NEAR(seen.mean, expected, 4 * seen.error + 1e-4) << x;
  }
}

// A bar that turns by 100°, and its shadow: against where it is at 4000 times, over 8 × 8 points of each
// pixel.
double share_under_turning_bar(Point2d corner, Point2d other, double angle_rad) {
  constexpr int times = 4000, fine = 8;
  int inside = 0;
  for (int k = 0; k < times; ++k) {
    const double a = angle_rad * (k + 0.5) / times, c = std::cos(a), s = std::sin(a);
    for (int i = 0; i < fine * fine; ++i) {
      const double u = (i % fine + 0.5) / fine, v = (static_cast<double>(i / fine) + 0.5) / fine;
      const double x = corner.x + u * (other.x - corner.x), y = corner.y + v * (other.y - corner.y);
      inside += std::abs(c * x + s * y) < 6 && std::abs(c * y - s * x) < 1.5;
    }
  }
  return static_cast<double>(inside) / (times * fine * fine);
}

constexpr double turn = 100 * pi / 180;
const std::vector<std::array<Point3f, 4>> bar{{{{-6, -1.5f, 0}, {6, -1.5f, 0}, {6, 1.5f, 0}, {-6, 1.5f, 0}}}};

// A film tells the variance of a pixel by the difference of two groups of samples: of all pixels together.
void expect_turning_bar(const Scene& scene, double of_bar, double beside) {
  const Film film = render(scene, 1024, 3).film;
  double squares = 0, variance = 0, sum = 0;
  int pixels = 0;
  for (int x = 0; x < size; ++x)
    for (int y = 0; y < size; y += 3, ++pixels) {
      const auto pixel = static_cast<std::uint32_t>(y * size + x);
      const double share =
          share_under_turning_bar(place_of(scene, x, y), place_of(scene, x + 1, y + 1), turn);
      const double d = film.mean(pixel).y - share * of_bar - (1 - share) * beside;
      squares += d * d, sum += d, variance += film.variance_of_mean(pixel);
    }
  fmt::print("{} pixels: squared error {:.3f} times the variance, mean off by {:.5f}\n", pixels,
             squares / variance, sum / pixels);
  EXPECT_LT(squares / variance, 1.6);
  EXPECT_NEAR(sum / pixels, 0, 4 * std::sqrt(variance) / pixels);
}

TEST(Motion, TurningBar) {
  Scene scene;
  add_shape(scene, add_quads(scene, bar), black, lamp);
  see_parallel(scene, 5);
  move(scene, {{0, {}}, {1, rotate(turn, {0, 0, 1})}});
  expect_turning_bar(scene, 1, 0);
}

// Rays to lights see what moves when their path does: the camera is between the bar and the ground.
TEST(Motion, ShadowOfATurningBar) {
  Scene scene;
  add_shape(scene, add_quads(scene, bar), black);
  for (Shape& shape : scene.shapes) shape.object_to_world = translate({0, 0, 20});
  see_parallel(scene, 5);
  move(scene, {{0, {}}, {1, rotate(turn, {0, 0, 1})}});
  add_shape(scene, add_quads(scene, {{{{-50, -50, 0}, {50, -50, 0}, {50, 50, 0}, {-50, 50, 0}}}}),
            Material{DiffuseMaterial{ConstantSpectrum{0.5f}}});
  scene.lights.push_back({DistantLight{{0, 0, -1}, ConstantSpectrum{1}}});
  scene.settings.max_depth = 1;
  expect_turning_bar(scene, 0, 0.5 / pi);
}

// A globe and a cube that turn, move and grow, lit from all around, against the mean of still pictures.
TEST(Motion, MeanOfManyMoments) {
  Scene scene;
  scene.meshes.resize(1);
  scene.meshes[0].quadric = Quadric{.kind = QuadricKind::sphere};
  scene.materials = {Material{DiffuseMaterial{ConstantSpectrum{0.7f}}}};
  scene.shapes = {{{0}, {0}, {}, 1.0f, translate({0, 0, 2})}};
  add_shape(scene, add_quads(scene, box_faces({-3, -1, 0}, {-1, 1, 1})), scene.materials[0]);
  see_parallel(scene, 9);
  const Transform end = translate({3, 1, 0}) * rotate(1.5, {1, 1, 3}) * scale({1.5, 1, 0.8});
  move(scene, {{0, {}}, {1, end}});
  scene.lights.push_back({InfiniteLight{ConstantSpectrum{1}}});
  scene.lights.push_back({DistantLight{{-1, 0, -1}, ConstantSpectrum{2}}});
  add_shape(scene, add_quads(scene, {{{{-50, -50, -2}, {50, -50, -2}, {50, 50, -2}, {-50, 50, -2}}}}),
            Material{DiffuseMaterial{ConstantSpectrum{0.5f}}});
  scene.settings.max_depth = 3;
  const Film moving = render(scene, 2048, 4).film;
  constexpr int moments = 64;
  std::vector<double> mean(size * size), variance(size * size);
  for (int k = 0; k < moments; ++k) {
    Scene still = scene;
    still.instances[0].motion.reset();
    still.instances[0].prototype_to_world = scene.motions[0].at((k + 0.5) / moments);
    const Film film = render(still, 32, 1, static_cast<std::uint64_t>(k)).film;
    for (std::uint32_t i = 0; i < size * size; ++i)
      mean[i] += film.mean(i).y / moments, variance[i] += film.variance_of_mean(i) / moments / moments;
  }
  double squares = 0, expected = 0, sum = 0;
  for (std::uint32_t i = 0; i < size * size; ++i) {
    const double d = moving.mean(i).y - mean[i];
    squares += d * d, sum += d;
    expected += moving.variance_of_mean(i) + variance[i];
  }
  fmt::print("squared error {:.3f} times the variances, mean off by {:.5f}\n", squares / expected,
             sum / (size * size));
  EXPECT_LT(squares / expected, 1.4);
  EXPECT_NEAR(sum / (size * size), 0, 4 * std::sqrt(expected) / (size * size));
}

}  // namespace
}  // namespace vitrail::test::motion_test
