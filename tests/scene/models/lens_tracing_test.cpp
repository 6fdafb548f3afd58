// SPDX-License-Identifier: Apache-2.0
#include "scene/models/lens_tracing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "scene/models/paraxial_lens.h"
#include "scene/system/diagnostics.h"
#include "tests/support/double_gauss.h"

namespace vitrail::test::lens_tracing_test {
namespace {

constexpr double focus = 1.5, film_radius = 0.0216;  // of 24 × 36 mm

// The double Gauss with its film where what is 1.5 m from it is sharp.
std::vector<LensSurface> focussed_double_gauss() {
  std::vector<LensSurface> lens = double_gauss();
  const ThinLens thin = thin_lens(lens);
  lens.back().thickness = *image_distance(thin, focus) + thin.rear_principal;
  return lens;
}

Point2d at_plane(const LensRay& ray, double z) {
  const double t = (z - ray.origin.z) / ray.direction.z;
  return {ray.origin.x + t * ray.direction.x, ray.origin.y + t * ray.direction.y};
}

// A ball of glass of index 2 and radius 20 mm has f = nR/(2(n − 1)) = 20 mm and both principal planes in its
// middle; a stop lies on it.
TEST(ThinLens, OfABall) {
  const std::vector<LensSurface> ball{{0, 0, 1, .005}, {.02, .04, 2, .015}, {-.02, 0, 1, .015}};
  const ThinLens lens = thin_lens(ball);
  EXPECT_NEAR(lens.focal_length, .02, 1e-15);
  EXPECT_NEAR(lens.principal_gap, 0, 1e-15);
  EXPECT_NEAR(lens.rear_principal, -.02, 1e-15);
  EXPECT_NEAR(lens.pupil_radius, .005, 1e-15);
  EXPECT_NEAR(*image_distance(lens, .1), .05 - std::sqrt(.0025 - .002), 1e-15);
  EXPECT_FALSE(image_distance(lens, .0799));
  EXPECT_THROW(thin_lens(std::vector<LensSurface>{{.02, .04, 2, .015}, {-.02, 0, 1, .015}}), Error);
  EXPECT_THROW(thin_lens(std::vector<LensSurface>{{0, 0, 1, .01}, {-.02, .04, 2, .015}, {.02, 0, 1, .015}}),
               Error);
}

// Rays near the axis are what the formulas of such rays say: they come from infinity to the rear focus, and
// from the film to the distance in focus.
TEST(LensTracing, RaysNearTheAxisAreParaxial) {
  const std::vector<LensSurface> lens = focussed_double_gauss();
  const ThinLens thin = thin_lens(lens);
  EXPECT_NEAR(thin.focal_length, .05, .001) << "a lens of 50 mm";
  std::vector<LensSurface> far = lens;
  far.back().thickness = thin.focal_length + thin.rear_principal;
  const auto parallel = through_lens(far, {0, 0, 0}, {1e-5, 0});
  ASSERT_TRUE(parallel);
  EXPECT_NEAR(parallel->direction.x, 0, 1e-9);
  const auto to_focus = through_lens(lens, {0, 0, 0}, {1e-5, 0});
  ASSERT_TRUE(to_focus);
  EXPECT_NEAR(to_focus->origin.z - to_focus->origin.x * to_focus->direction.z / to_focus->direction.x, focus,
              1e-4 * focus);
}

// All that comes from a point of the film and through the lens meets where it is in focus: within 0.3 mm
// at 1.5 m, and is spread 10 times as wide a quarter nearer.
TEST(LensTracing, IsSharpAtItsFocus) {
  std::vector<LensSurface> lens = focussed_double_gauss();
  for (LensSurface& s : lens)
    if (s.radius == 0) s.aperture_radius /= 4;
  const auto spread = [&](double x, double z) {
    double sum = 0, squares = 0, n = 0;
    for (double u = -.0095; u < .01; u += .0005)
      for (double v = -.0095; v < .01; v += .0005)
        if (const auto ray = through_lens(lens, {x, 0, 0}, {u, v})) {
          const Point2d p = at_plane(*ray, z);
          sum += p.x, squares += p.x * p.x, ++n;
        }
    EXPECT_GT(n, 20);
    return std::sqrt(squares / n - sum / n * (sum / n));
  };
  for (const double x : {0.0, 0.005}) {
    EXPECT_LT(spread(x, focus), 3e-4) << x;
    EXPECT_GT(spread(x, 0.75 * focus), 10 * spread(x, focus)) << x;
  }
}

// Whatever comes through goes to the rectangle of its ring, and what the rectangles' samples bring on the
// average is ∫cos⁴θ dA/z² over all that comes through: found over the whole of the rear surface.
TEST(LensTracing, RectanglesHoldAllThatComesThrough) {
  const std::vector<LensSurface> lens = focussed_double_gauss();
  const double rear = lens.back().aperture_radius, z = rear_vertex(lens), all = 1.5 * rear;
  const std::vector<ExitPupil> pupils = exit_pupils(lens, film_radius);
  ASSERT_EQ(pupils.size(), 64u);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  double middle = 0, corner = 0;
  for (std::size_t ring = 0; ring < pupils.size(); ring += 9) {
    const ScreenWindow& r = pupils[ring].rectangle;
    const double area = (r.x1 - r.x0) * (r.y1 - r.y0);
    double brute = 0, found = 0;
    constexpr int samples = 100'000;
    const auto weight = [&](double x, Point2d p) {
      const double squared = z * z / ((p.x - x) * (p.x - x) + p.y * p.y + z * z);
      return squared * squared / (z * z) / samples;
    };
    for (int i = 0; i < samples; ++i) {
      const double x = (static_cast<double>(ring) + uniform(random)) / 64 * film_radius;
      const Point2d anywhere{all * (2 * uniform(random) - 1), all * (2 * uniform(random) - 1)};
      if (through_lens(lens, {x, 0, 0}, anywhere)) {
        brute += 4 * all * all * weight(x, anywhere);
        EXPECT_TRUE(r.x0 < anywhere.x && anywhere.x < r.x1 && r.y0 < anywhere.y && anywhere.y < r.y1) << ring;
      }
      const Point2d within{r.x0 + uniform(random) * (r.x1 - r.x0), r.y0 + uniform(random) * (r.y1 - r.y0)};
      if (through_lens(lens, {x, 0, 0}, within)) found += area * weight(x, within);
    }
    EXPECT_NEAR(found, brute, 0.03 * brute) << ring;
    (ring == 0 ? middle : corner) = brute;
  }
  EXPECT_LT(corner, 0.5 * middle) << "the corners are darker";
  // The middle gets what a thin lens gives.
  const ThinLens thin = thin_lens(lens);
  EXPECT_NEAR(middle, std::numbers::pi * std::pow(thin.pupil_radius / (z - thin.rear_principal), 2),
              0.12 * middle);
}

TEST(LensTracing, AThinViewIsInFocusAtTheSamePlace) {
  RealisticCamera camera{{}, 2 * film_radius, focussed_double_gauss(), {}};
  FilmSettings film;
  film.width = 36, film.height = 24;
  const PerspectiveCamera view = view_of(camera, film);
  const double place = transform_point(view.camera_to_world, {0, 0, 0}).z;
  EXPECT_NEAR(place + view.lens.focal_distance, focus, 1e-9);
  const auto ray = through_lens(camera.surfaces, {-.003, .002, 0}, {1e-6, 0});
  ASSERT_TRUE(ray);
  const Point2d seen = at_plane(*ray, focus);
  const Point2d half = half_film(camera, film);
  EXPECT_NEAR(seen.x, .003 / half.x * view.screen.x1 * (focus - place), 0.01 * seen.x);
  EXPECT_NEAR(seen.y, -.002 / half.y * view.screen.y1 * (focus - place), -0.01 * seen.y);
}

}  // namespace
}  // namespace vitrail::test::lens_tracing_test
