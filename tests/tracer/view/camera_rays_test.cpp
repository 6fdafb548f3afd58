// SPDX-License-Identifier: Apache-2.0
#include "tracer/view/camera_rays.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vitrail {
namespace {

constexpr int grid = 64;
const FilmSettings film{100, 50, {0, 100, 0, 50}, BoxFilter{}, 1};

template <class F>
void for_each_cell(F&& visit) {
  for (int j = 0; j < grid; ++j)
    for (int i = 0; i < grid; ++i) visit(Point2d{(i + 0.5) / grid, (j + 0.5) / grid});
}

TEST(ConcentricDisk, CoversTheDiskEvenly) {
  double inner = 0, right = 0, x = 0, y = 0, squares = 0;
  for_each_cell([&](Point2d u) {
    const Point2d p = concentric_disk(u);
    const double r2 = p.x * p.x + p.y * p.y;
    EXPECT_LE(r2, 1 + 1e-12);
    inner += r2<0.25, right += p.x> std::abs(p.y), x += p.x, y += p.y, squares += r2;
  });
  constexpr double n = grid * grid;
  EXPECT_NEAR(inner / n, 0.25, 1e-3);
  EXPECT_NEAR(right / n, 0.25, 0.01);
  EXPECT_NEAR(x / n, 0, 1e-12);
  EXPECT_NEAR(y / n, 0, 1e-12);
  EXPECT_NEAR(squares / n, 0.5, 1e-3);
  EXPECT_EQ(concentric_disk({0.5, 0.5}), (Point2d{0, 0}));
}

CameraRay camera_ray(const Camera& camera, Point2d raster, Point2d lens) {
  return CameraSampler(camera, {}, film).ray(raster, lens, 0);
}
bool has_lens(const Camera& camera) { return CameraSampler(camera, {}, film).has_lens(); }

// Where a ray of the camera, which looks along +z, meets the plane z.
Point2d at_plane(const CameraRay& ray, double z) {
  const Vector3d d = cast<double>(decode_direction(ray.direction));
  const double t = (z - static_cast<double>(ray.origin.z)) / d.z;
  return {static_cast<double>(ray.origin.x) + t * d.x, static_cast<double>(ray.origin.y) + t * d.y};
}

// All rays of a raster position start on the lens and meet where the pinhole's ray is in the plane in focus.
template <class Camera>
void expect_focus(Camera camera) {
  const Point2d raster{70.25, 10.5};
  const Point2d sharp = at_plane(camera_ray(camera, raster, {}), 4);
  camera.lens = {0.3, 4};
  ASSERT_TRUE(has_lens(camera));
  double squares = 0;
  for_each_cell([&](Point2d u) {
    const CameraRay ray = camera_ray(camera, raster, u);
    const Point2d start{static_cast<double>(ray.origin.x), static_cast<double>(ray.origin.y)};
    EXPECT_EQ(ray.origin.z, 0);
    squares += start.x * start.x + start.y * start.y;
    const Point2d there = at_plane(ray, 4);
    EXPECT_NEAR(there.x, sharp.x, 1e-5);
    EXPECT_NEAR(there.y, sharp.y, 1e-5);
  });
  EXPECT_NEAR(squares / (grid * grid), 0.5 * 0.3 * 0.3, 1e-4);
}

TEST(ThinLens, RaysMeetInThePlaneInFocus) {
  expect_focus(PerspectiveCamera{{}, {-2, 2, -1, 1}, {}});
  expect_focus(OrthographicCamera{{}, {-2, 2, -1, 1}, {}});
}

TEST(ThinLens, APinholeHasNone) {
  EXPECT_FALSE(has_lens(PerspectiveCamera{}));
  EXPECT_FALSE(has_lens(SphericalCamera{}));
  const PerspectiveCamera camera{{}, {-2, 2, -1, 1}, {}};
  const CameraRay a = camera_ray(camera, {20, 10}, {0.1, 0.9}), b = camera_ray(camera, {20, 10}, {});
  EXPECT_EQ(a.origin, b.origin);
  EXPECT_EQ(a.direction, b.direction);
  const Point2d p = at_plane(a, 1);  // a fifth from the left, a fifth from the top
  EXPECT_NEAR(p.x, -1.2, 1e-6);
  EXPECT_NEAR(p.y, 0.6, 1e-6);
}

Vector3d seen(SphericalCamera::Projection projection, Point2d p) {
  const SphericalCamera camera{{}, projection};
  return cast<double>(
      decode_direction(camera_ray(camera, {p.x * film.width, p.y * film.height}, {}).direction));
}

void expect_direction(Vector3d a, Vector3d b) {
  EXPECT_LT(length(a - b), 3e-7) << b.x << ' ' << b.y << ' ' << b.z;
}

TEST(SphericalCamera, EqualAreaCoversTheSphereEvenly) {
  const auto projection = SphericalCamera::Projection::equal_area;
  Vector3d sum;
  double xx = 0, yy = 0, zz = 0;
  for_each_cell([&](Point2d p) {
    const Vector3d d = seen(projection, p);
    sum = sum + d;
    xx += d.x * d.x, yy += d.y * d.y, zz += d.z * d.z;
  });
  constexpr double n = grid * grid;
  EXPECT_LT(length(sum) / n, 1e-6);
  for (const double square : {xx, yy, zz}) EXPECT_NEAR(square / n, 1.0 / 3, 1e-3);
  expect_direction(seen(projection, {0.5, 0.5}), {0, 1, 0});
  expect_direction(seen(projection, {1, 0.5}), {1, 0, 0});
  expect_direction(seen(projection, {0.5, 1}), {0, 0, 1});
  for (const double x : {0.0, 1.0}) expect_direction(seen(projection, {x, 1}), {0, -1, 0});
}

// A pixel filter may look over the edge of the square.
TEST(SphericalCamera, EqualAreaGoesOnBeyondItsEdges) {
  const auto projection = SphericalCamera::Projection::equal_area;
  for (const double y : {0.1, 0.37, 0.5, 0.9})
    for (const double e : {1e-3, 0.02}) {
      const double across = length(seen(projection, {1 - e, y}) - seen(projection, {1 + e, y}));
      EXPECT_LT(across, 12 * e);
      EXPECT_LT(length(seen(projection, {y, -e}) - seen(projection, {y, e})), 12 * e);
    }
}

TEST(SphericalCamera, LatitudeAndLongitude) {
  const auto projection = SphericalCamera::Projection::latitude_longitude;
  expect_direction(seen(projection, {0.3, 0}), {0, 1, 0});
  expect_direction(seen(projection, {0.3, 1}), {0, -1, 0});
  expect_direction(seen(projection, {0, 0.5}), {1, 0, 0});
  expect_direction(seen(projection, {0.25, 0.5}), {0, 0, 1});
  const double r = std::sqrt(0.5);
  expect_direction(seen(projection, {0.5, 0.25}), {-r, r, 0});
}

}  // namespace
}  // namespace vitrail
