// SPDX-License-Identifier: Apache-2.0
// How far what is seen goes over the picture while the shutter is open, where that is known in closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "scene/system/diagnostics.h"
#include "tests/laws/light/flat_scenes.h"

namespace vitrail::test::motion_layer_test {
namespace {

constexpr int width = 12, height = 8;
constexpr double fov_rad = 0.9;

Film motion_of(Scene& scene) {
  scene.film.layers.bits = 0;
  scene.film.layers.add(Layer::motion);
  return render(scene, 16).film;
}

Transform camera_of(const Scene& scene) {
  return std::visit([](const auto& c) { return c.camera_to_world; }, scene.camera);
}

Point2d motion_in(const Film& film, int x, int y) {
  const auto p = static_cast<std::uint32_t>(width * y + x);
  return {film.mean_of_layer(p, Layer::motion, 0), film.mean_of_layer(p, Layer::motion, 1)};
}

void expect_everywhere(const Film& film, Point2d expected, double slack, const char* what) {
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      EXPECT_NEAR(motion_in(film, x, y).x, expected.x, slack) << what << " " << x << " " << y;
      EXPECT_NEAR(motion_in(film, x, y).y, expected.y, slack) << what << " " << x << " " << y;
    }
}

// A plane 5 before a camera that looks straight at it.
Scene wall_before_camera() {
  Scene scene;
  add_shape(scene, square(scene, 0), Material{DiffuseMaterial{ConstantSpectrum{0.5f}}});
  set_camera(scene, {0, 0, 5}, {0, 0, 0}, {0, 1, 0}, fov_rad, width, height);
  return scene;
}

double pixels_per_unit() { return height / (2 * std::tan(fov_rad / 2)) / 5; }

TEST(MotionLayer, OfACameraThatGoesSideways) {
  Scene scene = wall_before_camera();
  const Transform camera = camera_of(scene);
  // To the camera's own right and up: what is seen goes to the left and down.
  scene.camera_motion = Motion({{0, camera}, {1, camera * translate({0.3, 0.1, 0})}});
  expect_everywhere(motion_of(scene), {-0.3 * pixels_per_unit(), -0.1 * pixels_per_unit()}, 1e-4,
                    "the whole shutter");
  scene.shutter = {0.25, 0.75};
  expect_everywhere(motion_of(scene), {-0.15 * pixels_per_unit(), -0.05 * pixels_per_unit()}, 1e-4,
                    "half of it");
}

// u goes to u/(1 − v·t) of what it was: away from the middle.
TEST(MotionLayer, OfACameraThatComesNearer) {
  Scene scene = wall_before_camera();
  const Transform camera = camera_of(scene);
  scene.camera_motion = Motion({{0, camera}, {1, camera * translate({0, 0, 1})}});
  const Film film = motion_of(scene);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      // Of a point whose place at time t is (u, v), 5/(5 − t) of where it was at 0, it goes 5/4 − 1 of that.
      // The mean of (5 − t)/5 over the shutter is 0.9.
      EXPECT_NEAR(motion_in(film, x, y).x, (x + 0.5 - width / 2.0) * 0.9 * 0.25, 0.12) << x << " " << y;
      EXPECT_NEAR(motion_in(film, x, y).y, -(y + 0.5 - height / 2.0) * 0.9 * 0.25, 0.12) << x << " " << y;
    }
}

TEST(MotionLayer, OfAnObjectThatMoves) {
  Scene scene = wall_before_camera();
  scene.shapes.clear();
  scene.prototypes.push_back({"card", {Shape{{0}, {0}}}});
  scene.motions.push_back(Motion({{0, Transform{}}, {1, translate({0.2, -0.4, 0})}}));
  scene.instances.push_back({Id<Prototype>{0}, Transform{}, {}, Id<Motion>{0}});
  const Transform camera = camera_of(scene);
  const Vector3d right = transform_vector(camera, {1, 0, 0});
  const double sign = right.x > 0 ? 1 : -1;
  expect_everywhere(motion_of(scene), {sign * 0.2 * pixels_per_unit(), -0.4 * pixels_per_unit()}, 1e-4,
                    "an instance");
  // Along with it, the camera sees it stand still.
  scene.camera_motion = Motion({{0, camera}, {1, translate({0.2, -0.4, 0}) * camera}});
  expect_everywhere(motion_of(scene), {0, 0}, 1e-4, "both");
}

TEST(MotionLayer, IsNoneWhereNothingMoves) {
  Scene scene = wall_before_camera();
  expect_everywhere(motion_of(scene), {0, 0}, 0, "nothing");
  scene.camera = SphericalCamera{camera_of(scene)};
  EXPECT_THROW(motion_of(scene), UsageError);
}

}  // namespace
}  // namespace vitrail::test::motion_layer_test
