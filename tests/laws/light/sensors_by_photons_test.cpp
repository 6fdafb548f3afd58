// SPDX-License-Identifier: Apache-2.0
// What photons bring to sensors: closed forms of glass that no connection passes, what paths find there with
// many samples, and that the stated error is the error.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "film/sensor_readings.h"
#include "scene/daylight/photometry.h"
#include "scene/geometry/portable_math.h"
#include "scene/models/sensor_file.h"
#include "tests/laws/light/media_scenes.h"
#include "tests/support/long_tests.h"
#include "tests/support/polarised.h"
#include "tests/support/render.h"
#include "tracer/bsdf/fresnel.h"
#include "tracer/bsdf/local.h"
#include "tracer/photons/progressive.h"

namespace vitrail::test::sensors_by_photons_test {
namespace {

const Material black{DiffuseMaterial{ConstantSpectrum{0}}};

Material glass(float eta) {
  DielectricMaterial glass;
  glass.eta = ConstantSpectrum{eta};
  return Material{glass};
}

// Above a black floor, so that they measure what comes from above alone.
Scene with_sensors(std::vector<Sensor> sensors, int max_depth) {
  Scene scene;
  add_shape(scene, add_quads(scene, {{{{-8, -8, -0.5f}, {8, -8, -0.5f}, {8, 8, -0.5f}, {-8, 8, -0.5f}}}}),
            black);
  scene.film = sensor_film(sensors.size());
  scene.camera = SensorCamera{Transform{}, std::move(sensors)};
  scene.settings.max_depth = max_depth;
  return scene;
}

std::vector<SensorReading> by_paths(const Scene& scene, int samples) {
  return sensor_readings(render(scene, samples).film);
}
std::vector<SensorReading> by_photons(const Scene& scene, const PhotonKey& key, int iterations,
                                      std::uint64_t seed = 0) {
  RenderOptions options;
  options.picture.samples_per_pixel = iterations;
  options.picture.seed = seed;
  options.picture.integrator = Integrator::photon;
  options.picture.photons = {key.photons, key.first_radius, key.alpha};
  return sensor_readings(render(scene, std::move(options)).film);
}

void expect(const char* what, const Measured& measured, double expected, double precision) {
  fmt::print("{}: {:.6g} ± {:.2g} of {:.6g}\n", what, measured.mean, measured.standard_error, expected);
  EXPECT_NEAR(measured.mean, expected, 4.5 * measured.standard_error) << what;
  EXPECT_LT(measured.standard_error, precision * expected) << what;
}

// Of `mean_over_disc(r)`, over the radii of the iterations.
template <class F>
double over_radii(const PhotonKey& key, int iterations, const F& mean_over_disc) {
  double sum = 0;
  for (int i = 0; i < iterations; ++i) sum += mean_over_disc(radius_of(key, static_cast<std::uint32_t>(i)));
  return sum / iterations;
}

// A point light behind a sheet that bends nothing, and that no connection passes: 2I/r²·(1 − d/√(d² + r²)) is
// the mean over a disc that faces it. A sensor that looks away has nothing; one beside another of its place,
// turned by 60°, has what falls through its own disc; one that is named twice has its light twice.
TEST(SensorsByPhotons, IrradianceBehindASheet) {
  const double d = 1, intensity = 3;
  const Vector3d tilted{std::sin(pi / 3), 0, std::cos(pi / 3)};
  Scene scene = with_sensors(
      {{{0, 0, 0}, {0, 0, 1}}, {{0, 0, 0}, {0, 0, 1}}, {{0, 0, 0}, {0, 0, -1}}, {{0, 0, 0}, tilted}}, 4);
  add_shape(scene, add_quads(scene, box_faces({-8, -8, 0.6f}, {8, 8, 0.61f})), glass(1));
  scene.lights.push_back({PointLight{{0, 0, d}, ConstantSpectrum{static_cast<float>(intensity)}}, {}});
  for (const SensorReading& none : by_paths(scene, 4)) EXPECT_EQ(none.illuminance_lx.mean, 0);
  const PhotonKey key{of_all(64000u, 32000u), 0.25, 0.8};
  constexpr int iterations = 32;
  const std::vector<SensorReading> read = by_photons(scene, key, iterations);
  const double facing = over_radii(key, iterations, [&](double r) {
    return photometric(2 * intensity / (r * r) * (1 - d / std::sqrt(d * d + r * r)));
  });
  expect("facing", read[0].illuminance_lx, facing, 0.01);
  EXPECT_NEAR(read[1].illuminance_lx.mean / read[0].illuminance_lx.mean, 1, 1e-9);
  EXPECT_EQ(read[2].illuminance_lx.mean, 0);
  const double turned = over_radii(key, iterations, [&](double r) {
    // ∫ I·h/|way|³ over the disc, whose plane has the light at the height h.
    constexpr int rings = 40, parts = 80;
    const double h = d * tilted.z, beside = d * tilted.x;
    double sum = 0;
    for (int i = 0; i < rings; ++i)
      for (int j = 0; j < parts; ++j) {
        const double rho = r * std::sqrt((i + 0.5) / rings), phi = 2 * pi * (j + 0.5) / parts;
        const double x = rho * std::cos(phi) - beside, y = rho * std::sin(phi);
        sum += intensity * h / std::pow(x * x + y * y + h * h, 1.5) / (rings * parts);
      }
    return photometric(sum);
  });
  expect("turned", read[3].illuminance_lx, turned, 0.01);
}

// The sun through a ball of glass of radius 1, straight below it: of what falls on the ring at h, T(h)² comes
// to x(h), refracted twice; the disc has what comes to |x| < r. Nothing is reflected within, for the depth.
TEST(SensorsByPhotons, CausticOfABall) {
  constexpr double eta = 1.5, below = 1.3;
  Scene scene = with_sensors({{{0, 0, 0}, {0, 0, 1}}}, 3);
  add_quadric(scene, {QuadricKind::sphere}, ball({0, 0, below}, 1), glass(static_cast<float>(eta)));
  scene.lights.push_back({DistantLight{{0, 0, -1}, ConstantSpectrum{1}}, {}});
  const PhotonKey key{of_all(64000u, 32000u), 0.06, 0.8};
  constexpr int iterations = 48;
  const auto mean_over_disc = [&](double r) {
    constexpr int rings = 20000;
    double flux = 0;
    for (int i = 0; i < rings; ++i) {
      const double h = (i + 0.5) / rings, in = std::asin(h), within = std::asin(h / eta);
      const double turned = 2 * (in - within), around = 2 * within - in;
      // It leaves at the angle `around` from the lowest point, and goes down at `turned` towards the axis.
      const double x = std::sin(around), z = below - std::cos(around);
      const double passes =
          over_polarisations([&](Fresnel f) { return std::pow(1 - f(std::cos(in), eta), 2); });
      if (std::abs(x - z * std::tan(turned)) < r) flux += passes * 2 * pi * h / rings;
    }
    return photometric(flux / (pi * r * r));
  };
  expect("ball", by_photons(scene, key, iterations)[0].illuminance_lx,
         over_radii(key, iterations, mean_over_disc), 0.01);
}

// A lamp through a ball of glass, at places where the light varies little: as paths have it that find the
// lamp by chance, and the errors that are told are those of the readings of several seeds.
TEST(SensorsByPhotons, AsPathsWithManySamples) {
  Scene scene = with_sensors({{{0, 0, 0}, {0, 0, 1}}, {{0.3, 0, 0}, {0, 0, 1}}, {{1.4, 0, 0}, {0, 0, 1}}}, 5);
  add_quadric(scene, {QuadricKind::sphere}, ball({0, 0, 1.2}, 0.5), glass(1.5f));
  add_shape(scene,
            add_quads(scene, {{{{-0.3f, -0.3f, 2}, {-0.3f, 0.3f, 2}, {0.3f, 0.3f, 2}, {0.3f, -0.3f, 2}}}}),
            black, AreaLight{ConstantSpectrum{10}});
  const std::vector<SensorReading> paths = by_paths(scene, 6400);  // 10⁵ samples
  constexpr int seeds = 8;
  std::vector<double> sums(paths.size()), squares(paths.size()), told(paths.size());
  for (int seed = 0; seed < seeds; ++seed) {
    const std::vector<SensorReading> read =
        by_photons(scene, {of_all(64000u, 32000u), 0.08, 0.8}, 16, static_cast<std::uint64_t>(seed));
    for (std::size_t i = 0; i < read.size(); ++i) {
      const Measured& m = read[i].illuminance_lx;
      sums[i] += m.mean, squares[i] += m.mean * m.mean;
      told[i] += m.standard_error * m.standard_error / seeds;
    }
  }
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const double mean = sums[i] / seeds, variance = (squares[i] - seeds * mean * mean) / (seeds - 1);
    const Measured& path = paths[i].illuminance_lx;
    fmt::print("{}: photons {:.5g}, paths {:.5g} ± {:.2g}, told {:.3g}, found {:.3g}\n", i, mean, path.mean,
               path.standard_error, std::sqrt(told[i]), std::sqrt(variance));
    EXPECT_NEAR(mean / path.mean, 1, 0.02) << i;
    // Of 8 seeds the variance is between .086 and 3.5 times the true one (χ² of 7 degrees, but 1 in 1000).
    EXPECT_LT(variance, 3.5 * told[i]) << i;
    EXPECT_GT(variance, 0.086 * told[i]) << i;
  }
}

}  // namespace
}  // namespace vitrail::test::sensors_by_photons_test
