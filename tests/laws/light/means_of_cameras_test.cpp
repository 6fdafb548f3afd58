// SPDX-License-Identifier: Apache-2.0
// What the pixels of each camera, lens and filter are of a shining scene, against closed forms.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "scene/geometry/portable_math.h"
#include "scene/models/lens_tracing.h"
#include "scene/models/paraxial_lens.h"
#include "tests/support/double_gauss.h"
#include "tests/support/render.h"

namespace vitrail::test::means_of_cameras_test {
namespace {

const Material black{DiffuseMaterial{ConstantSpectrum{0}}};
constexpr int size = 16;

// The half plane x < edge of the plane z = 0 shines, as +z sees it.
Scene half_plane(double edge, double extent) {
  Scene scene;
  const auto x = static_cast<float>(edge), e = static_cast<float>(extent);
  add_shape(scene, add_quads(scene, {{{{-e, -e, 0}, {x, -e, 0}, {x, e, 0}, {-e, e, 0}}}}), black,
            AreaLight{ConstantSpectrum{1}});
  scene.film.width = scene.film.height = size;
  scene.film.crop = {0, size, 0, size};
  scene.film.filter = BoxFilter{};
  scene.settings.max_depth = 0;
  return scene;
}

// Parallel rays along −z, one unit a pixel: the pixel of column i has its centre at x = i + ½ − size/2.
OrthographicCamera parallel(double height) {
  OrthographicCamera camera;
  camera.camera_to_world = look_at({0, 0, height}, {0, 0, 0}, {0, 1, 0});
  camera.screen = {-size / 2.0, size / 2.0, -size / 2.0, size / 2.0};
  return camera;
}

// Whether a camera that looks along −z with +y up has +x to the left.
double column_x(const Scene& scene, int column) {
  const auto& camera = std::get<OrthographicCamera>(scene.camera);
  const Vector3d right = transform_vector(camera.camera_to_world, {1, 0, 0});
  return (column + 0.5 - size / 2.0) * right.x;
}

struct Columns {
  std::array<double, size> mean{}, standard_error{};
};

Columns columns(const Scene& scene, int samples) {
  const Film film = render(scene, samples).film;
  Columns result;
  for (int x = 0; x < size; ++x) {
    double variance = 0;
    for (int y = 0; y < size; ++y) {
      const auto pixel = static_cast<std::uint32_t>(y * size + x);
      result.mean[static_cast<std::size_t>(x)] += film.mean(pixel).y / size;
      variance += film.variance_of_mean(pixel) / size / size;
    }
    result.standard_error[static_cast<std::size_t>(x)] = std::sqrt(variance);
  }
  return result;
}

// ---- Filters

double mitchell(const MitchellFilter& f, double x) {
  const double t = std::abs(2 * x / f.radius_x), b = f.b, c = f.c;
  if (t < 1) return ((12 - 9 * b - 6 * c) * t * t * t + (-18 + 12 * b + 6 * c) * t * t + 6 - 2 * b) / 6;
  if (t < 2)
    return ((-b - 6 * c) * t * t * t + (6 * b + 30 * c) * t * t + (-12 * b - 48 * c) * t + 8 * b + 24 * c) /
           6;
  return 0;
}

struct Filtering {
  const char* name;
  Filter filter;
  double radius;
  std::function<double(double)> f;
};

std::vector<Filtering> filters() {
  const auto sinc = [](double x) { return x == 0 ? 1 : std::sin(pi * x) / (pi * x); };
  const MitchellFilter usual, ringing{3, 3, 0, 1};
  return {{"box", BoxFilter{}, 0.5, [](double) { return 1.0; }},
          {"wide box", BoxFilter{1.7, 1.7}, 1.7, [](double) { return 1.0; }},
          {"triangle", TriangleFilter{}, 2, [](double x) { return 2 - std::abs(x); }},
          {"gaussian", GaussianFilter{}, 1.5,
           [](double x) { return std::exp(-2 * x * x) - std::exp(-2 * 1.5 * 1.5); }},
          {"mitchell", usual, 2, [=](double x) { return mitchell(usual, x); }},
          {"ringing mitchell", ringing, 3, [=](double x) { return mitchell(ringing, x); }},
          {"sinc", SincFilter{}, 3, [=](double x) { return sinc(x) * sinc(x / 3); }},
          {"short sinc", SincFilter{2, 2, 3}, 2, [=](double x) { return sinc(x) * sinc(x / 3); }}};
}

// ∫ f over [−radius, x] over ∫ f over all.
double share_below(const Filtering& filter, double x) {
  constexpr int steps = 20000;
  double below = 0, all = 0;
  for (int i = 0; i < steps; ++i) {
    const double at = filter.radius * (2 * (i + 0.5) / steps - 1), value = filter.f(at);
    all += value;
    if (at < x) below += value;
  }
  return below / all;
}

// The filters are tables of 256 steps a side and, of the sinc, 256 over its stated radius.
TEST(MeansOfFilters, OverAnEdge) {
  for (const Filtering& filter : filters())
    for (const double edge : {0.0, 0.3, 0.5}) {
      Scene scene = half_plane(edge, 30);
      scene.camera = parallel(5);
      scene.film.filter = filter.filter;
      const Columns seen = columns(scene, 1024);
      double worst = 0;
      for (int x = 0; x < size; ++x) {
        const auto at = static_cast<std::size_t>(x);
        const double expected = share_below(filter, edge - column_x(scene, x));
        EXPECT_NEAR(seen.mean[at], expected, 4 * seen.standard_error[at] + 3e-3) << filter.name << ' ' << x;
        worst = std::max(worst, std::abs(seen.mean[at] - expected));
      }
      fmt::print("{}, edge {}: off by {:.5f} at most\n", filter.name, edge, worst);
    }
}

// ---- Cameras

// A picture of what is far away and wide is where it has to be: the edge through the middle of a pixel.
TEST(MeansOfCameras, ParallelRaysFromFarAway) {
  for (const double height : {5.0, 1e6}) {
    Scene scene = half_plane(0.5, 1e4);
    // Its counterpart keeps the plane in the middle of the scene.
    scene.camera = parallel(height);
    const Columns seen = columns(scene, 256);
    for (int x = 0; x < size; ++x) {
      const double expected = std::clamp(0.5 - column_x(scene, x) + 0.5, 0.0, 1.0);
      // Directions are exact along an axis, origins rounded to float across it.
      EXPECT_NEAR(seen.mean[static_cast<std::size_t>(x)], expected, 2e-3) << height << ' ' << x;
    }
  }
}

TEST(MeansOfCameras, PinholesNearAndFar) {
  for (const double height : {0.1, 5.0, 1e5}) {
    const double unit = height / 16;  // a pixel's width on the plane
    Scene scene = half_plane(0.25 * unit, height * 4);
    set_camera(scene, {0, 0, height}, {0, 0, 0}, {0, 1, 0}, 2 * std::atan(0.5), size, size);
    const auto& camera = std::get<PerspectiveCamera>(scene.camera);
    const double right = transform_vector(camera.camera_to_world, {1, 0, 0}).x;
    const Columns seen = columns(scene, 256);
    for (int x = 0; x < size; ++x) {
      const double centre = (x + 0.5 - size / 2.0) * right;
      const double expected = std::clamp(0.25 - centre + 0.5, 0.0, 1.0);
      EXPECT_NEAR(seen.mean[static_cast<std::size_t>(x)], expected, 4e-3) << height << ' ' << x;
    }
  }
}

// The share of a disk of radius 1 with x < edge.
double disk_below(double edge) {
  const double x = std::clamp(edge, -1.0, 1.0);
  return 0.5 + (x * std::sqrt(1 - x * x) + std::asin(x)) / pi;
}

// Out of focus each point is seen by a disk: of radius r·|1 − z/f| at the distance z.
TEST(MeansOfCameras, ThinLenses) {
  for (const bool perspective : {false, true})
    for (const double focus : {2.5, 10.0, 5.0}) {
      constexpr double height = 5, radius = 2;
      Scene scene = half_plane(0.3, 100);
      // Narrow pixels: of 0.4 on the plane.
      const double half = size / 2.0 * 0.4;
      double right;
      if (perspective) {
        set_camera(scene, {0, 0, height}, {0, 0, 0}, {0, 1, 0}, 2 * std::atan(half / height), size, size);
        auto& camera = std::get<PerspectiveCamera>(scene.camera);
        camera.lens = {radius, focus};
        right = transform_vector(camera.camera_to_world, {1, 0, 0}).x;
      } else {
        OrthographicCamera camera = parallel(height);
        camera.screen = {-half, half, -half, half};
        camera.lens = {radius, focus};
        scene.camera = camera;
        right = transform_vector(camera.camera_to_world, {1, 0, 0}).x;
      }
      const Columns seen = columns(scene, 1024);
      const double blur = radius * std::abs(1 - height / focus);
      // Of parallel rays the one through a pixel meets the plane in focus there, from its place on the lens
      // about the axis: the magnification of the plane at z is z/f.
      const double magnification = perspective ? 1 : height / focus;
      for (int x = 0; x < size; ++x) {
        double expected = 0;
        for (int i = 0; i < 1000; ++i) {
          const double at = (x + (i + 0.5) / 1000 - size / 2.0) * 0.4 * right * magnification;
          expected += (blur > 0 ? disk_below((0.3 - at) / blur) : at < 0.3 ? 1.0 : 0.0) / 1000;
        }
        const auto column = static_cast<std::size_t>(x);
        EXPECT_NEAR(seen.mean[column], expected, 4 * seen.standard_error[column] + 2e-3)
            << (perspective ? "perspective" : "orthographic") << ", focus " << focus << ", column " << x;
      }
    }
}

// What a pixel of the film gets through its lens of a radiance of 1: ∫cos⁴θ dA/z² over all that comes
// through, over what the middle gets.
TEST(MeansOfCameras, ALensOfManySurfaces) {
  constexpr double diagonal = 0.0432, height = 5;
  RealisticCamera camera{look_at({0, 0, height}, {0, 0, 0}, {0, 1, 0}), diagonal, double_gauss(), {}};
  const ThinLens thin = thin_lens(camera.surfaces);
  const double z = camera.surfaces.back().thickness = *image_distance(thin, height) + thin.rear_principal;
  camera.pupils = exit_pupils(camera.surfaces, diagonal / 2);
  for (ExitPupil& p : camera.pupils)
    p.weight = (p.rectangle.x1 - p.rectangle.x0) * (p.rectangle.y1 - p.rectangle.y0) / (z * z);
  const double middle =
      camera.pupils[0].weight * mean_weight(camera.surfaces, {0, 0}, camera.pupils[0].rectangle);
  for (ExitPupil& p : camera.pupils) p.weight /= middle;

  Scene scene = half_plane(1000, 1000);
  scene.camera = camera;
  const Film film = render(scene, 1024).film;
  const Point2d half = half_film(camera, scene.film);
  const double rear = camera.surfaces.back().aperture_radius * 1.5;
  constexpr int grid = 96;
  for (const Point2d& at : {Point2d{8, 8}, Point2d{2, 8}, Point2d{13, 3}, Point2d{0, 0}, Point2d{15, 0}}) {
    double expected = 0;
    for (int k = 0; k < 4; ++k) {
      const Point3d on_film{half.x * (1 - (at.x + 0.25 + 0.5 * (k & 1)) / 8),
                            half.y * ((at.y + 0.25 + 0.5 * (k >> 1)) / 8 - 1), 0};
      for (int j = 0; j < grid; ++j)
        for (int i = 0; i < grid; ++i) {
          const Point2d p{rear * ((2 * i + 1.0) / grid - 1), rear * ((2 * j + 1.0) / grid - 1)};
          const double dx = p.x - on_film.x, dy = p.y - on_film.y,
                       squared = z * z / (dx * dx + dy * dy + z * z);
          if (through_lens(camera.surfaces, on_film, p))
            expected += squared * squared * 4 * rear * rear / (z * z) / middle / (4 * grid * grid);
        }
    }
    const auto pixel = static_cast<std::uint32_t>(at.y * size + at.x);
    EXPECT_NEAR(film.mean(pixel).y, expected, 0.02) << at.x << ' ' << at.y;
  }
  EXPECT_NEAR(film.mean(8 * size + 8).y, 1, 0.02) << "the middle";
  EXPECT_LT(film.mean(0).y, 0.5) << "a corner";
}

// ---- The whole sphere

// The faces of a box around the camera shine with 1 … 6.
TEST(MeansOfCameras, WholeSpheres) {
  const Point3f lower{-1, -2, -0.5f}, upper{2, 1, 3};
  const std::array<Vector3d, 6> outwards{
      {{0, 0, -1}, {0, 0, 1}, {0, -1, 0}, {0, 1, 0}, {-1, 0, 0}, {1, 0, 0}}};
  using Projection = SphericalCamera::Projection;
  for (const Projection projection : {Projection::equal_area, Projection::latitude_longitude}) {
    Scene scene;
    auto faces = box_faces(lower, upper);
    for (std::size_t i = 0; i < 6; ++i) {
      std::swap(faces[i][1], faces[i][3]);  // fronts inwards
      add_shape(scene, add_quads(scene, {faces[i]}), black,
                AreaLight{ConstantSpectrum{static_cast<float>(i + 1)}});
    }
    SphericalCamera camera;
    camera.projection = projection;
    const Transform turned = rotate(0.7, {1, 2, -1});
    camera.camera_to_world = turned;
    scene.camera = camera;
    scene.film.width = scene.film.height = size;
    scene.film.crop = {0, size, 0, size};
    scene.film.filter = BoxFilter{};
    scene.settings.max_depth = 0;
    const Film film = render(scene, 1024).film;
    const auto radiance_towards = [&](Vector3d d) {
      double nearest = 1e30, radiance = 0;
      for (std::size_t i = 0; i < 6; ++i) {
        const Vector3d n = outwards[i];
        const Point3f corner = n.x + n.y + n.z > 0 ? upper : lower;
        const double along = dot(d, n), height = dot(cast<double>(corner - Point3f{}), n);
        if (along > 0 && height / along < nearest)
          nearest = height / along, radiance = static_cast<double>(i + 1);
      }
      return radiance;
    };
    // Of each row by its own measure: the mean over longitude, and over the map all directions alike.
    constexpr int fine = 400;
    double all = 0;
    for (int y = 0; y < size; ++y) {
      double row = 0, expected = 0;
      for (int x = 0; x < size; ++x) row += film.mean(static_cast<std::uint32_t>(y * size + x)).y / size;
      all += row / size;
      if (projection == Projection::equal_area) continue;
      for (int i = 0; i < 20; ++i)
        for (int k = 0; k < fine; ++k) {
          const double theta = pi * (y + (i + 0.5) / 20) / size, phi = 2 * pi * (k + 0.5) / fine;
          const Vector3d d{std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
          expected += radiance_towards(transform_vector(turned, d)) / 20 / fine;
        }
      EXPECT_NEAR(row, expected, 0.01) << y;
    }
    if (projection == Projection::latitude_longitude) continue;
    double expected = 0;  // over the sphere: by a spiral
    constexpr int points = 400000;
    for (int i = 0; i < points; ++i) {
      const double z = 1 - 2 * (i + 0.5) / points, r = std::sqrt(1 - z * z), phi = 2.399963229728653 * i;
      expected += radiance_towards({r * std::cos(phi), r * std::sin(phi), z}) / points;
    }
    EXPECT_NEAR(all, expected, 0.005);
  }
}

}  // namespace
}  // namespace vitrail::test::means_of_cameras_test
