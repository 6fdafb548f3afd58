// SPDX-License-Identifier: Apache-2.0
#include "tracer/view/camera_rays.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vitrail::camera_rays_test {
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

// Rays of every raster position and point of the lens begin in one plane and end in another, and go the way
// that they go without planes.
template <class Camera>
void expect_clipped(Camera camera) {
  Camera without = camera;
  camera.clip = {1.5f, 6};
  const auto depth_of = [](Point3d p) { return p.z; };
  for_each_cell([&](Point2d u) {
    const Point2d raster{u.x * film.width, u.y * film.height}, lens{u.y, u.x};
    const CameraRay ray = camera_ray(camera, raster, lens), whole = camera_ray(without, raster, lens);
    const Vector3d d = cast<double>(decode_direction(ray.direction));
    EXPECT_EQ(ray.direction, whole.direction);
    EXPECT_NEAR(depth_of(cast<double>(ray.origin)), 1.5, 1e-6);
    EXPECT_NEAR(depth_of(cast<double>(ray.origin) + ray.end * d), 6, 1e-5);
    EXPECT_NEAR(length(cast<double>(ray.origin) - cast<double>(whole.origin)), ray.before, 1e-6);
    EXPECT_TRUE(std::isinf(whole.end) && whole.before == 0);
  });
}

TEST(ClipPlanes, RaysBeginAndEndInThem) {
  for (const Lens& lens : {Lens{}, Lens{0.3, 4}}) {
    expect_clipped(PerspectiveCamera{{}, {-2, 2, -1, 1}, lens});
    expect_clipped(OrthographicCamera{{}, {-2, 2, -1, 1}, lens});
  }
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

// Directions that povray 3.7 shows at x = 16/33 and y = 24/33 of half the raster, of a camera at 0 that looks
// along z with right x and up y, unless it says so.
TEST(WideCamera, LooksAsPovraysCameras) {
  using enum WideCamera::Projection;
  const auto seen_at = [](const WideCamera& camera, double x, double y) {
    const CameraRay ray = camera_ray(camera, {50 * (1 + x / 33), 25 * (1 - y / 33)}, {0.5, 0.5});
    EXPECT_EQ(ray.weight, 1);
    return cast<double>(decode_direction(ray.direction));
  };
  const auto expect = [&](const WideCamera& camera, double x, double y, Vector3d wanted) {
    EXPECT_LT(length(normalize(seen_at(camera, x, y)) - wanted), 2e-4)
        << static_cast<int>(camera.projection) << ": " << x << ' ' << y;
  };
  expect({{}, latitude_longitude, 90, 45}, 16, 16, {0.6406, 0.3716, 0.6719});  // angle 180 90
  expect({{}, latitude_longitude, 180, 90}, 8, 24, {0.2867, 0.9096, 0.3006});  // without an angle
  expect({{}, fisheye, 90, 90, 90}, 16, 16, {0.6227, 0.6227, 0.4739});         // angle 180
  expect({{}, fisheye, 80, 60, 60}, 8, 24, {0.3006, 0.6765, 0.6723});          // angle 120, right 4/3·x
  expect({{}, ultra_wide, 60, 60}, 16, 16, {0.4731, 0.4731, 0.7431});          // angle 120
  expect({{}, ultra_wide, 60, 30}, 8, 24, {0.2501, 0.3700, 0.8947});           // … and right 2·x
  expect({{}, panoramic, 1, 1}, 16, 16, {0.4994, 0.6901, 0.5238});
  expect({{}, panoramic, 2, 1}, 8, 24, {0.2983, 0.8788, 0.3726});                   // right 2·x
  expect({{}, upright_cylinder, 60, 0.5}, 8, 24, {0.2360, 0.3417, 0.9096});         // cylinder 1, angle 120
  expect({{}, lying_cylinder, 0.5, 60}, 16, 16, {0.2356, 0.4725, 0.8493});          // cylinder 2
  expect({{}, upright_cylinder, 60, 0.5, 180, true}, 16, 16, {0.4862, 0, 0.8738});  // cylinder 3
  expect({{}, lying_cylinder, 0.5, 60, 180, true}, 8, 24, {0, 0.6901, 0.7237});     // cylinder 4
}

TEST(WideCamera, AFisheyeHasAnEdge) {
  const WideCamera camera{{}, WideCamera::Projection::fisheye, 80, 60, 60};
  EXPECT_EQ(camera_ray(camera, {50 * 1.74, 25}, {}).weight, 1);
  EXPECT_EQ(camera_ray(camera, {50 * 1.76, 25}, {}).weight, 0);
}

// The camera of a cylinder whose rays are parallel moves along its axis, as far as `up` is long.
TEST(WideCamera, MovesAlongACylinder) {
  const WideCamera upright{{}, WideCamera::Projection::upright_cylinder, 60, 0.5, 180, true};
  const CameraRay ray = camera_ray(upright, {20, 5}, {});
  EXPECT_FLOAT_EQ(ray.origin.y, 0.4f);
  EXPECT_FLOAT_EQ(ray.origin.x, 0);
  const WideCamera lying{{}, WideCamera::Projection::lying_cylinder, 0.5, 60, 180, true};
  EXPECT_FLOAT_EQ(camera_ray(lying, {20, 5}, {}).origin.x, -0.3f);
}

}  // namespace
}  // namespace vitrail::camera_rays_test
