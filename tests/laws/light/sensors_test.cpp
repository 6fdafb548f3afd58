// SPDX-License-Identifier: Apache-2.0
// What sensors measure, against closed forms and quadratures, and daylight against its model's own integrals.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "film/sensor_readings.h"
#include "images/image_files.h"
#include "scene/daylight/photometry.h"
#include "scene/daylight/sky_model.h"
#include "scene/geometry/portable_math.h"
#include "scene/models/sensor_file.h"
#include "tests/support/render.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::sensors_test {
namespace {

const Material black{DiffuseMaterial{ConstantSpectrum{0}}};

// A scene needs something in it: a black speck far below.
Scene with_sensors(std::vector<Sensor> sensors, Point3f at = {0, 0, 0}) {
  Scene scene;
  const float x = at.x, y = at.y, z = at.z - 50;
  add_shape(
      scene,
      add_quads(scene, {{{{x, y, z}, {x + 0.01f, y, z}, {x + 0.01f, y + 0.01f, z}, {x, y + 0.01f, z}}}}),
      black);
  scene.film = sensor_film(sensors.size());
  scene.camera = SensorCamera{Transform{}, std::move(sensors)};
  scene.settings.max_depth = 1;
  return scene;
}

std::vector<SensorReading> measure(const Scene& scene, int samples) {
  return sensor_readings(render(scene, samples).film);
}

void expect(const char* what, const Measured& measured, double expected, double tolerance = 1e-5) {
  fmt::print("{}: {:.6g} ± {:.2g} of {:.6g}\n", what, measured.mean, measured.standard_error, expected);
  EXPECT_NEAR(measured.mean, expected, 5 * measured.standard_error + tolerance * expected) << what;
  EXPECT_LT(measured.standard_error, 0.02 * expected) << what;
}

Vector3d tilted(double degrees) { return {std::sin(degrees * pi / 180), 0, std::cos(degrees * pi / 180)}; }

// Of D65 from everywhere: π L whichever way a sensor faces, and melanopic EDI is the illuminance.
TEST(Sensors, UniformSkyOfDaylight) {
  Scene scene = with_sensors({{{0, 0, 0}, {0, 0, 1}}, {{3, 1, 2}, tilted(77)}});
  TabulatedSpectrum d65;
  d65.values.assign(cie_d65().begin(), cie_d65().end());
  scene.lights.push_back({InfiniteLight{d65}, {}});
  double watts = 0;  // the mean of neighbouring nanometres
  for (std::size_t i = 0; i + 1 < d65.values.size(); ++i)
    watts += pi * static_cast<double>(d65.values[i] + d65.values[i + 1]) / 2;
  for (const SensorReading& reading : measure(scene, 4096)) {
    expect("illuminance", reading.illuminance_lx, photometric(pi));
    expect("melanopic EDI", reading.melanopic_edi_lx, photometric(pi), 1e-3);  // for its bins of 10 nm
    expect("irradiance", reading.irradiance_w_m2, watts);
    EXPECT_EQ(reading.samples, 4096u * sensor_rows);
  }
}

// A lamp a × b whose corner is straight above the sensor at distance 1 (Siegel & Howell, configuration C-11
// of Howell's catalogue: differential element to a parallel rectangle), also far from the origin.
TEST(Sensors, RectangularLamp) {
  constexpr double a = 2, b = 1.5;
  const double A = a / std::sqrt(1 + a * a), B = b / std::sqrt(1 + b * b);
  const double factor =
      (A * std::atan(b / std::sqrt(1 + a * a)) + B * std::atan(a / std::sqrt(1 + b * b))) / (2 * pi);
  for (const float far : {0.0f, 1048576.0f}) {
    const Point3f o{far, -far, 2 * far};
    Scene scene = with_sensors({{cast<double>(o), {0, 0, 1}}}, o);
    const float x = o.x, y = o.y, z = o.z + 1;
    add_shape(scene, add_quads(scene, {{{{x, y, z}, {x, y + 1.5f, z}, {x + 2, y + 1.5f, z}, {x + 2, y, z}}}}),
              black, AreaLight{ConstantSpectrum{10}});
    expect("rectangle", measure(scene, 1024)[0].illuminance_lx, photometric(10 * pi * factor));
  }
}

// Direct light passes a pane once, straight, whichever way a lamp is found; a path is bent by it, and finds
// nearly the same.
TEST(Sensors, ALampBehindGlassCountsOnce) {
  Scene scene = with_sensors({{{0, 0, 0}, {0, 0, 1}}});
  scene.settings.max_depth = 8;
  add_shape(scene, add_quads(scene, box_faces({-20, -20, 0.5f}, {20, 20, 0.51f})),
            Material{DielectricMaterial{}});
  add_shape(scene, add_quads(scene, {{{{-1, -1, 1}, {-1, 1, 1}, {1, 1, 1}, {1, -1, 1}}}}), black,
            AreaLight{ConstantSpectrum{10}});
  const double path = measure(scene, 4096)[0].illuminance_lx.mean;
  scene.settings.direct_only = true;
  expect("behind glass", measure(scene, 1024)[0].illuminance_lx, path, 0.01);
}

// A round lamp of radius r, its centre at distance 1 along the normal of a sensor, or seen at grazing angle:
// E = π L r²/(1 + r²) and, wholly before the sensor at the angle θ, times cos θ.
TEST(Sensors, DiscFacingAndGrazing) {
  constexpr int corners = 512;
  constexpr double r = 0.1;
  for (const double theta : {0.0, 60.0, 83.0}) {
    Scene scene = with_sensors({{{0, 0, 0}, tilted(theta)}});
    std::vector<std::array<Point3f, 4>> fan;
    const auto rim = [&](int i) {
      const double phi = 2 * pi * i / corners;
      return Point3f{static_cast<float>(r * std::cos(phi)), static_cast<float>(r * std::sin(phi)), 1};
    };
    for (int i = 0; i < corners; i += 2) fan.push_back({Point3f{0, 0, 1}, rim(i + 2), rim(i + 1), rim(i)});
    add_shape(scene, add_quads(scene, fan), black, AreaLight{ConstantSpectrum{10}});
    const double inscribed = std::sin(2 * pi / corners) * corners / (2 * pi);  // area of the polygon
    expect("disc", measure(scene, 1024)[0].illuminance_lx,
           photometric(10 * pi * r * r * inscribed / (1 + r * r)) * std::cos(theta * pi / 180));
  }
}

// Sun and sky as the model's own integrals: flat, across the sun and with the sun grazing, high and low.
TEST(Sensors, SunAndSkyAreAsPrinted) {
  for (const double elevation : {8.0, 50.0}) {
    const Vector3d sun = tilted(90 - elevation);
    SkyLight sky;
    sky.to_sun = sun;
    sky.sky_scale = 0;
    const Vector3d grazing = tilted(90 - elevation - 85);
    Scene scene = with_sensors({{{0, 0, 0}, {0, 0, 1}}, {{0, 0, 0}, sun}, {{0, 0, 0}, grazing}});
    scene.lights.push_back({sky, {}});
    const SkyModel model(sky);
    const auto lux = [](const auto& bands) { return photometric(luminance(spectrum_of_bands(bands))); };
    const auto readings = measure(scene, 512);
    expect("sun on the ground", readings[0].illuminance_lx, lux(model.sun_irradiance({0, 0, 1})));
    expect("sun across", readings[1].illuminance_lx, lux(model.sun_irradiance(sun)));
    expect("sun grazing", readings[2].illuminance_lx, lux(model.sun_irradiance(grazing)));

    sky.sky_scale = 1;
    const SkyModel both(sky);
    auto& light = std::get<SkyLight>(scene.lights[0].model);
    light = sky;
    const Measured ground = measure(scene, 4096)[0].illuminance_lx;
    const double expected = lux(both.sun_irradiance({0, 0, 1})) + lux(both.sky_irradiance());
    expect("both on the ground", ground, expected);
    EXPECT_NEAR(ground.mean / expected, 1, 0.01);
  }
}

// A wall has of the ground the half of what that reflects to all sides: ρ E/2. With glass somewhere the sun
// is a light of its own, and the ground keeps its light.
TEST(Sensors, TheGroundLightsWalls) {
  const Vector3d sun = tilted(40), away{-1, 0, 0}, up{0, 0, 1};
  SkyLight sky;
  sky.to_sun = sun;
  const SkyModel unlit(sky);
  sky.ground = 0.3f;
  const auto lux = [](const auto& bands) { return photometric(luminance(spectrum_of_bands(bands))); };
  const double reflected = 0.3 * (lux(unlit.sun_irradiance(up)) + lux(unlit.sky_irradiance(up)));
  for (const bool glass : {false, true}) {
    Scene scene = with_sensors({{{0, 0, 0}, away}, {{0, 0, 0}, {0, 0, -1}}});
    if (glass)
      add_shape(scene, add_quads(scene, box_faces({0, 0, -70}, {0.1f, 0.1f, -69.9f})),
                Material{DielectricMaterial{}});
    scene.lights.push_back({sky, {}});
    const auto readings = measure(scene, 8192);
    const double wall = lux(unlit.sky_irradiance(away)) + reflected / 2;
    expect("wall", readings[0].illuminance_lx, wall);
    EXPECT_NEAR(readings[0].illuminance_lx.mean / wall, 1, 0.01);
    expect("ceiling", readings[1].illuminance_lx, reflected);
    EXPECT_NEAR(readings[1].illuminance_lx.mean / reflected, 1, 0.01);
  }
}

// ---- Daylight factors of a black room: the sky component of a window W wide and H high in a wall at the
// distance D, whose lower corner is straight ahead of a sensor that faces up.

constexpr double width = 3, height = 2, depth = 2.5;

// ∫ L cos θ dω over the window, by its mid-points; `sky` of the sine of the elevation.
template <class Sky>
double through_window(Sky&& sky) {
  constexpr int n = 600;
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double x = width * (i + 0.5) / n, z = height * (j + 0.5) / n;
      const double r2 = x * x + depth * depth + z * z, r = std::sqrt(r2);
      sum += sky(z / r) * (z / r) * (depth / r) / r2;
    }
  return sum * width * height / (n * n);
}

Scene black_room() {
  Scene scene = with_sensors({{{0, 0, 0}, {0, 0, 1}}});
  const auto wall = [&](Point3f a, Point3f b, Point3f c, Point3f d) {
    add_shape(scene, add_quads(scene, {{{a, b, c, d}}}), black);
  };
  const auto y = static_cast<float>(depth);
  const float w = static_cast<float>(width), h = static_cast<float>(height), far = 20;
  // The wall at y = D around the window, and the five others of a box.
  wall({-far, y, -far}, {far, y, -far}, {far, y, 0}, {-far, y, 0});
  wall({-far, y, h}, {far, y, h}, {far, y, far}, {-far, y, far});
  wall({-far, y, 0}, {0, y, 0}, {0, y, h}, {-far, y, h});
  wall({w, y, 0}, {far, y, 0}, {far, y, h}, {w, y, h});
  wall({-far, -far, -far}, {far, -far, -far}, {far, -far, far}, {-far, -far, far});
  wall({-far, -far, -far}, {-far, y, -far}, {-far, y, far}, {-far, -far, far});
  wall({far, -far, -far}, {far, y, -far}, {far, y, far}, {far, -far, far});
  wall({-far, -far, far}, {far, -far, far}, {far, y, far}, {-far, y, far});
  wall({-far, -far, -far}, {far, -far, -far}, {far, y, -far}, {-far, y, -far});
  return scene;
}

TEST(DaylightFactor, UniformSky) {
  Scene scene = black_room();
  scene.lights.push_back({InfiniteLight{ConstantSpectrum{1}}, {}});
  const double slant = std::hypot(height, depth);
  const double factor = (std::atan(width / depth) - depth / slant * std::atan(width / slant)) / (2 * pi);
  EXPECT_NEAR(through_window([](double) { return 1.0; }) / pi, factor, 1e-6);
  expect("uniform sky, %", measure(scene, 8192)[0].illuminance_lx, photometric(pi * factor));
  fmt::print("a daylight factor of {:.4f} %\n", 100 * factor);
}

// L = Lz (1 + 2 sin γ)/3 (Moon & Spencer 1942, CIE S 011 type 16), E = 7/9 π Lz in the open.
TEST(DaylightFactor, OvercastSky) {
  const auto overcast = [](double sine) { return (1 + 2 * std::max(0.0, sine)) / 3; };
  const TemporaryDirectory directory;
  constexpr int rows = 512;
  Image image = black_image(2 * rows, rows, 3);
  for (int y = 0; y < rows / 2; ++y)  // row centres from pole to pole, as they are looked up
    for (int i = 0; i < 6 * rows; ++i)
      image.values[static_cast<std::size_t>(y * 6 * rows + i)] =
          static_cast<float>(overcast(std::cos(pi * y / (rows - 1))));
  write_exr_image(directory / "overcast.exr", image);
  EnvironmentLight sky;
  sky.filename = (directory / "overcast.exr").string();
  sky.projection = EnvironmentLight::Projection::latitude_longitude;
  Scene open = with_sensors({{{0, 0, 0}, {0, 0, 1}}}), room = black_room();
  open.lights.push_back({sky, {}});
  room.lights.push_back({sky, {}});
  const Measured outside = measure(open, 4096)[0].illuminance_lx,
                 inside = measure(room, 8192)[0].illuminance_lx;
  const double factor = through_window(overcast) / (7.0 / 9 * pi), found = inside.mean / outside.mean;
  const double error =
      found * std::hypot(inside.standard_error / inside.mean, outside.standard_error / outside.mean);
  fmt::print("overcast sky: a daylight factor of {:.4f} ± {:.4f} % of {:.4f} %\n", 100 * found, 100 * error,
             100 * factor);
  EXPECT_NEAR(found, factor, 5 * error + 1e-3 * factor);
  EXPECT_NEAR(outside.mean, photometric(7.0 / 9 * pi), 5 * outside.standard_error + 2e-3 * outside.mean);
}

// Sensors, as pictures, know nothing of sub-domains.
TEST(Sensors, AreTheSameWhateverTheDomains) {
  Scene scene = lit_box(4);
  scene.film = sensor_film(2);
  scene.camera = SensorCamera{Transform{}, {{{0.1, 0.2, 0.3}, {0, 1, 0}}, {{-0.2, 0.1, 0}, {0, 0, 1}}}};
  const Rendered one = render(scene, 16, 1), eight = render(scene, 16, 8);
  EXPECT_EQ(one.film.hash(), eight.film.hash());
  EXPECT_GT(sensor_readings(one.film)[0].illuminance_lx.mean, 0);
}

}  // namespace
}  // namespace vitrail::test::sensors_test
