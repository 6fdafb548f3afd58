// SPDX-License-Identifier: Apache-2.0
// Cases after CIE 171:2006, "Test cases to assess the accuracy of lighting computer programs", chapter 5,
// whose references are analytical. The geometries are of this test, and what is expected follows from
// published configuration factors (Howell, A Catalog of Radiation Heat Transfer Configuration Factors, B-3,
// B-4: of a plane element to a parallel and to a perpendicular rectangle with a corner on its normal or
// before it) and Fresnel's equations. All surfaces are black where nothing else is said.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "film/sensor_readings.h"
#include "scene/daylight/photometry.h"
#include "scene/daylight/sky_distribution.h"
#include "scene/geometry/portable_math.h"
#include "scene/models/sensor_file.h"
#include "tests/support/render.h"

namespace vitrail::test::daylight_cases_test {
namespace {

Material diffuse(float reflectance) { return Material{DiffuseMaterial{ConstantSpectrum{reflectance}}}; }

void add_wall(Scene& scene, Point3f a, Point3f b, Point3f c, Point3f d, float reflectance = 0) {
  add_shape(scene, add_quads(scene, {{{a, b, c, d}}}), diffuse(reflectance));
}

void add_slab(Scene& scene, Point3f lower, Point3f upper, const Material& material) {
  add_shape(scene, add_quads(scene, box_faces(lower, upper)), material);
}

void under_uniform_sky(Scene& scene) { scene.lights.push_back({InfiniteLight{ConstantSpectrum{1}}, {}}); }

// The illuminance at each sensor over that of the open ground under the uniform sky of radiance 1.
void expect_factors(const char* what, Scene scene, const std::vector<Sensor>& sensors,
                    const std::vector<double>& expected, int samples, double slack = 1e-4) {
  scene.film = sensor_film(sensors.size());
  scene.camera = SensorCamera{Transform{}, sensors};
  const std::vector<SensorReading> readings = sensor_readings(render(scene, samples).film);
  const double open = photometric(pi);
  double worst = 0;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    const double found = readings[i].illuminance_lx.mean / open,
                 error = readings[i].illuminance_lx.standard_error / open;
    worst = std::max(worst, std::abs(found / expected[i] - 1));
    EXPECT_NEAR(found, expected[i], 4.5 * error + slack * expected[i]) << what << ", point " << i;
    EXPECT_LT(error, 0.02 * expected[i]) << what << ", point " << i;
    fmt::print("{}, point {}: {:.4f} ± {:.4f} % of {:.4f} %\n", what, i, 100 * found, 100 * error,
               100 * expected[i]);
  }
  fmt::print("{}: within {:.2f} %\n", what, 100 * worst);
}

// To a parallel rectangle at the distance d, one corner on the element's normal, a × b.
double parallel_corner(double a, double b, double d) {
  const double x = a / d, y = b / d, rx = std::sqrt(1 + x * x), ry = std::sqrt(1 + y * y);
  return (x / rx * std::atan(y / rx) + y / ry * std::atan(x / ry)) / (2 * pi);
}
// The same of a rectangle from (x0, y0) to (x1, y1) about the element's foot.
double parallel(double x0, double x1, double y0, double y1, double d) {
  const auto f = [&](double x, double y) {
    return std::copysign(1, x) * std::copysign(1, y) * parallel_corner(std::abs(x), std::abs(y), d);
  };
  return f(x1, y1) - f(x0, y1) - f(x1, y0) + f(x0, y0);
}
// To a perpendicular rectangle at the distance d that begins in the element's plane, one lower corner
// straight ahead, w × h.
double perpendicular_corner(double w, double h, double d) {
  const double slant = std::hypot(h, d);
  return (std::atan(w / d) - d / slant * std::atan(w / slant)) / (2 * pi);
}
double perpendicular(double x0, double x1, double h0, double h1, double d) {
  const auto f = [&](double x, double h) {
    return std::copysign(1, x) * perpendicular_corner(std::abs(x), h, d);
  };
  return f(x1, h1) - f(x0, h1) - f(x1, h0) + f(x0, h0);
}

// ---- A room of 4 × 4 × 3, the floor at z = 0, its middle at the origin.

constexpr float half = 2, top = 3;

void add_floor_and_sides(Scene& scene, bool front) {
  add_wall(scene, {-half, -half, -.01f}, {half, -half, -.01f}, {half, half, -.01f}, {-half, half, -.01f});
  add_wall(scene, {-half, -half, -.01f}, {-half, half, -.01f}, {-half, half, top}, {-half, -half, top});
  add_wall(scene, {half, -half, -.01f}, {half, half, -.01f}, {half, half, top}, {half, -half, top});
  add_wall(scene, {-half, -half, -.01f}, {half, -half, -.01f}, {half, -half, top}, {-half, -half, top});
  if (front)
    add_wall(scene, {-half, half, -.01f}, {half, half, -.01f}, {half, half, top}, {-half, half, top});
}

// A plane with a hole, in (u, v): four strips around it. `at` gives the place.
void add_frame(Scene& scene, const std::function<Point3f(float, float)>& at, std::array<float, 4> outer,
               std::array<float, 4> hole) {
  const auto strip = [&](float u0, float u1, float v0, float v1) {
    if (u1 > u0 && v1 > v0) add_wall(scene, at(u0, v0), at(u1, v0), at(u1, v1), at(u0, v1));
  };
  strip(outer[0], outer[1], outer[2], hole[2]);
  strip(outer[0], outer[1], hole[3], outer[3]);
  strip(outer[0], hole[0], hole[2], hole[3]);
  strip(hole[1], outer[1], hole[2], hole[3]);
}

Scene room_with_roof_light(float side) {
  Scene scene;
  add_floor_and_sides(scene, true);
  const float h = side / 2;
  add_frame(scene,
            [](float u, float v) {
              return Point3f{u, v, top};
            },
            {-half, half, -half, half}, {-h, h, -h, h});
  under_uniform_sky(scene);
  scene.settings.max_depth = 4;
  return scene;
}

// A window of 2 × 1 from z = 1 in the wall y = 2.
constexpr float sill = 1, head = 2, jamb = 1;
Scene room_with_window() {
  Scene scene;
  add_floor_and_sides(scene, false);
  add_wall(scene, {-half, -half, top}, {half, -half, top}, {half, half, top}, {-half, half, top});
  add_frame(scene,
            [](float u, float v) {
              return Point3f{u, half, v};
            },
            {-half, half, -.01f, top}, {-jamb, jamb, sill, head});
  under_uniform_sky(scene);
  scene.settings.max_depth = 4;
  return scene;
}

const std::vector<Sensor> on_the_floor{
    {{0, 1, 0}, {0, 0, 1}}, {{0, 0, 0}, {0, 0, 1}}, {{0, -1.5, 0}, {0, 0, 1}}, {{-1.5, -0.5, 0}, {0, 0, 1}}};

// Of a pane with parallel faces: its two reflections without end, absorbing nothing, of s and p apart.
constexpr double index = 1.52;
double pane(double cosine) {
  const double sine2 = (1 - cosine * cosine) / (index * index), inside = std::sqrt(1 - sine2);
  const double s = (cosine - index * inside) / (cosine + index * inside),
               p = (index * cosine - inside) / (index * cosine + inside);
  const auto passes = [](double f) { return (1 - f) / (1 + f); };
  return (passes(s * s) + passes(p * p)) / 2;
}

// ∫ T cos cos/(π r²) dA over a rectangle of a plane, by its middle points: from the floor's point to u, v.
double through(const Point3d& from, const std::function<Point3d(double, double)>& at, Vector3d normal,
               double u0, double u1, double v0, double v1,
               const std::function<double(double)>& transmittance) {
  constexpr int n = 300;
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Vector3d way = at(u0 + (u1 - u0) * (i + 0.5) / n, v0 + (v1 - v0) * (j + 0.5) / n) - from;
      const double r = length(way), cosine = std::abs(dot(way, normal)) / r;
      sum += transmittance(cosine) * way.z / r * cosine / (pi * r * r);
    }
  return sum * (u1 - u0) * (v1 - v0) / (n * n);
}

// 5.9: a roof's opening without glass.
TEST(DaylightCases, RoofOpening) {
  for (const float side : {1.0f, 4.0f}) {
    std::vector<double> expected;
    for (const Sensor& s : on_the_floor)
      expected.push_back(parallel(-side / 2 - s.position.x, side / 2 - s.position.x, -side / 2 - s.position.y,
                                  side / 2 - s.position.y, top));
    expect_factors(fmt::format("5.9, {} × {}", side, side).c_str(), room_with_roof_light(side), on_the_floor,
                   expected, side > 2 ? 1024 : 8192);
  }
}

// ---- The fifteen skies of the CIE: a, b, c, d, e of ISO 15469.

constexpr double cie_shapes[15][5] = {
    {4, -0.7, 0, -1, 0},        {4, -0.7, 2, -1.5, 0.15},  {1.1, -0.8, 0, -1, 0},
    {1.1, -0.8, 2, -1.5, 0.15}, {0, -1, 0, -1, 0},         {0, -1, 2, -1.5, 0.15},
    {0, -1, 5, -2.5, 0.3},      {0, -1, 10, -3, 0.45},     {-1, -0.55, 2, -1.5, 0.15},
    {-1, -0.55, 5, -2.5, 0.3},  {-1, -0.55, 10, -3, 0.45}, {-1, -0.32, 10, -3, 0.45},
    {-1, -0.32, 16, -3, 0.3},   {-1, -0.15, 16, -3, 0.3},  {-1, -0.15, 24, -2.8, 0.15}};
// The sun is 30° high and a little aside of the window's normal.
const SunPosition sun_of_skies{.elevation_deg = 30, .azimuth_deg = 20};

// The standard's own formula, over what it gives to a plane that faces up.
class CieSky {
 public:
  explicit CieSky(int type) : k_(cie_shapes[type - 1]) {
    constexpr int rows = 400, columns = 400;
    for (int i = 0; i < rows; ++i)
      for (int j = 0; j < columns; ++j) {
        const double z = (i + 0.5) / rows, across = std::sqrt(1 - z * z), phi = 2 * pi * (j + 0.5) / columns;
        horizontal_ +=
            relative({across * std::cos(phi), across * std::sin(phi), z}) * z * 2 * pi / (rows * columns);
      }
  }
  // 1/sr
  double operator()(Vector3d d) const { return d.z > 0 ? relative(d) / horizontal_ : 0; }

 private:
  double relative(Vector3d d) const {
    const double cosine = std::clamp(dot(d, direction_of(sun_of_skies)), -1.0, 1.0), chi = std::acos(cosine);
    return (1 + k_[0] * std::exp(k_[1] / d.z)) *
           (1 + k_[2] * (std::exp(k_[3] * chi) - std::exp(k_[3] * pi / 2)) + k_[4] * cosine * cosine);
  }
  const double* k_;
  double horizontal_ = 0;
};

// Without its sun; a ground that reflects `ground` of it.
void under_cie_sky(Scene& scene, int type, float ground) {
  SkyLight light;
  light.to_sun = direction_of(sun_of_skies);
  light.sun_scale = 0, light.ground = ground;
  *light.distribution = cie_sky(type, sun_of_skies, {}).distribution;
  (*light.distribution)->diffuse_lx = photometric(pi);
  scene.lights = {{light, {}}};
}

// ∫ L cos cos/r² dA over a rectangle of a plane with this normal, by its middle points.
double sky_through(const CieSky& sky, const Sensor& s, const std::function<Point3d(double, double)>& at,
                   Vector3d normal, double u0, double u1, double v0, double v1) {
  constexpr int n = 200;
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Vector3d way = at(u0 + (u1 - u0) * (i + 0.5) / n, v0 + (v1 - v0) * (j + 0.5) / n) - s.position;
      const double r = length(way);
      const Vector3d d = way * (1 / r);
      sum += sky(d) * std::max(0.0, dot(d, s.normal)) * std::abs(dot(d, normal)) / (r * r);
    }
  return sum * (u1 - u0) * (v1 - v0) / (n * n);
}

// 5.9 under the CIE's general skies.
TEST(DaylightCases, RoofOpeningUnderTheSkiesOfTheCie) {
  const std::vector<Sensor> sensors{on_the_floor[0], on_the_floor[3]};
  for (int type = 1; type <= 15; ++type) {
    Scene scene = room_with_roof_light(2);
    under_cie_sky(scene, type, 0);
    const CieSky sky(type);
    std::vector<double> expected;
    for (const Sensor& s : sensors)
      expected.push_back(sky_through(
          sky, s,
          [](double u, double v) {
            return Point3d{u, v, top};
          },
          {0, 0, 1}, -1, 1, -1, 1));
    expect_factors(fmt::format("5.9, type {}", type).c_str(), scene, sensors, expected, 4096, 2e-3);
  }
}

// 5.11 under them, before a ground that reflects 0.3: a point of the floor, one of the back wall, and one of
// the ceiling, which sees the ground alone.
TEST(DaylightCases, FacadeOpeningUnderTheSkiesOfTheCie) {
  constexpr double ground = 0.3, height = 1.5;
  const std::vector<Sensor> sensors{
      on_the_floor[1], {{0, -half + 0.01, height}, {0, 1, 0}}, {{0, 0, top - 0.01}, {0, 0, -1}}};
  for (int type = 1; type <= 15; ++type) {
    Scene scene = room_with_window();
    under_cie_sky(scene, type, static_cast<float>(ground));
    const CieSky sky(type);
    std::vector<double> expected;
    for (const Sensor& s : sensors)
      expected.push_back(sky_through(
          sky, s,
          [](double u, double v) {
            return Point3d{u, half, v};
          },
          {0, 1, 0}, -jamb, jamb, sill, head));
    const double depth = 2 * half - 0.01, below = top - 0.01;
    expected[1] += ground * parallel(-jamb, jamb, sill - height, 0, depth);
    expected[2] += ground * perpendicular(-jamb, jamb, below - head, below - sill, half);
    expect_factors(fmt::format("5.11, type {}", type).c_str(), scene, sensors, expected, 4096, 2e-3);
  }
}

// 5.10: with clear glass.
TEST(DaylightCases, GlazedRoof) {
  Scene scene = room_with_roof_light(2);
  DielectricMaterial glass;
  glass.eta = ConstantSpectrum{static_cast<float>(index)};
  add_slab(scene, {-1.05f, -1.05f, top + .001f}, {1.05f, 1.05f, top + .007f}, Material{glass});
  scene.settings.max_depth = 12;
  std::vector<double> expected;
  for (const Sensor& s : on_the_floor)
    expected.push_back(through(
        s.position,
        [](double u, double v) {
          return Point3d{u, v, top};
        },
        {0, 0, 1}, -1, 1, -1, 1, pane));
  // The rays' ways through the pane are up to 6 mm aside.
  expect_factors("5.10", scene, on_the_floor, expected, 8192, 2e-3);
}

double window_from(const Sensor& s, double from, double to) {
  return perpendicular(-jamb - s.position.x, jamb - s.position.x, from, to, half - s.position.y);
}

// 5.11: a façade's opening without glass; the floor sees the sky alone.
TEST(DaylightCases, FacadeOpening) {
  std::vector<double> expected;
  for (const Sensor& s : on_the_floor) expected.push_back(window_from(s, sill, head));
  expect_factors("5.11", room_with_window(), on_the_floor, expected, 4096);
}

// 5.12: with clear glass.
TEST(DaylightCases, GlazedFacade) {
  Scene scene = room_with_window();
  DielectricMaterial glass;
  glass.eta = ConstantSpectrum{static_cast<float>(index)};
  add_slab(scene, {-jamb - .05f, half + .001f, sill - .05f}, {jamb + .05f, half + .007f, head + .05f},
           Material{glass});
  scene.settings.max_depth = 12;
  std::vector<double> expected;
  for (const Sensor& s : on_the_floor)
    expected.push_back(through(
        s.position,
        [](double u, double v) {
          return Point3d{u, half, v};
        },
        {0, 1, 0}, -jamb, jamb, sill, head, pane));
  expect_factors("5.12", scene, on_the_floor, expected, 8192, 4e-3);
}

// 5.13: under a horizontal mask, as wide as the world and 1 deep: it hides what of the window is above a
// line.
TEST(DaylightCases, FacadeUnderAHorizontalMask) {
  constexpr double out = 1;
  Scene scene = room_with_window();
  const float end = half + static_cast<float>(out);
  add_wall(scene, {-500, half, head}, {500, half, head}, {500, end, head}, {-500, end, head});
  std::vector<Sensor> sensors{on_the_floor[1], on_the_floor[2], on_the_floor[3]};
  std::vector<double> expected;
  for (const Sensor& s : sensors) {
    const double d = half - s.position.y;
    expected.push_back(window_from(s, sill, head * d / (d + out)));
  }
  expect_factors("5.13", scene, sensors, expected, 16384);
}

// 5.14: before a vertical mask, as wide as the world, 6 away and 4 high: it hides what is below a line.
TEST(DaylightCases, FacadeBeforeAVerticalMask) {
  constexpr double away = 6, high = 4;
  Scene scene = room_with_window();
  const float y = half + static_cast<float>(away), z = static_cast<float>(high);
  add_wall(scene, {-500, y, -1}, {500, y, -1}, {500, y, z}, {-500, y, z});
  std::vector<double> expected;
  for (const Sensor& s : on_the_floor) {
    const double d = half - s.position.y;
    expected.push_back(window_from(s, std::max<double>(sill, high * d / (d + away)), head));
  }
  expect_factors("5.14", scene, on_the_floor, expected, 4096);
}

// 5.6: parallel light on a diffuse surface of 4 × 4 that lies on the ground, and what it sends to a wall and
// a ceiling that see no more.
TEST(DaylightCases, DiffuseReflection) {
  constexpr float reflectance = 0.8f;
  Scene scene;
  add_wall(scene, {-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}, reflectance);
  const Vector3d sun = normalize(Vector3d{0.3, -0.6, -1});
  // Irradiance 1 on the ground over that of the uniform sky in the open, π.
  scene.lights.push_back({DistantLight{sun, ConstantSpectrum{static_cast<float>(-pi / sun.z)}}, {}});
  scene.settings.max_depth = 2;
  // The wall looks to −y, with the sun behind it; the ceiling down.
  std::vector<Sensor> sensors;
  std::vector<double> expected;
  for (const double z : {0.5, 1.5, 2.5}) {
    sensors.push_back({{0, half, z}, {0, -1, 0}});
    expected.push_back(static_cast<double>(reflectance) * perpendicular(-half, half, 0, 2 * half, z));
  }
  for (const double x : {0.0, 1.0}) {
    sensors.push_back({{x, 0.5, top}, {0, 0, -1}});
    expected.push_back(static_cast<double>(reflectance) *
                       parallel(-half - x, half - x, -half - 0.5, half - 0.5, top));
  }
  expect_factors("5.6", scene, sensors, expected, 512);
}

// 5.8: in a closed room of one reflectance ρ a lamp's flux Φ makes a mean illuminance of Φ/(A(1 − ρ)) over
// all its area A, whatever its shape: what is absorbed is what is sent.
TEST(DaylightCases, InterreflectionKeepsTheFlux) {
  constexpr float reflectance = 0.5f;
  constexpr int n = 8;
  Scene scene;
  auto faces = box_faces({-half, -half, -half}, {half, half, half});
  for (auto& face : faces) std::swap(face[1], face[3]);
  add_shape(scene, add_quads(scene, faces), diffuse(reflectance));
  scene.lights.push_back({PointLight{{0.4, 0.2, 0.1}, ConstantSpectrum{1}}, {}});
  scene.settings.max_depth = 24;
  std::vector<Sensor> sensors;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0})
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const double w = half * (1 - 1e-5);
          Sensor s{{}, {}};
          s.position[axis] = side * w, s.normal[axis] = -side;
          s.position[(axis + 1) % 3] = half * (2 * (i + 0.5) / n - 1);
          s.position[(axis + 2) % 3] = half * (2 * (j + 0.5) / n - 1);
          sensors.push_back(s);
        }
  scene.film = sensor_film(sensors.size());
  scene.camera = SensorCamera{Transform{}, sensors};
  const Point3d lamp = std::get<PointLight>(scene.lights[0].model).position;
  const auto count = static_cast<double>(sensors.size());
  double found = 0, direct = 0;  // means over the cells' middles
  for (const SensorReading& r : sensor_readings(render(scene, 64).film))
    found += r.illuminance_lx.mean / count;
  for (const Sensor& s : sensors) {
    const Vector3d way = lamp - s.position;
    direct += dot(way, s.normal) / std::pow(length(way), 3) / count;
  }
  constexpr double area = 6 * 16, rho = static_cast<double>(reflectance);
  const double expected = photometric(direct + 4 * pi / area * rho / (1 - rho));
  fmt::print("5.8: {:.2f} of {:.2f} lx\n", found, expected);
  EXPECT_NEAR(found / expected, 1, 0.004);
}

}  // namespace
}  // namespace vitrail::test::daylight_cases_test
