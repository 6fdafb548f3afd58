// SPDX-License-Identifier: Apache-2.0
// Where shadow rays end: what stands before a lamp, however near to it, is in their way, and the lamp itself
// never is.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "scene/geometry/portable_math.h"
#include "tests/support/render.h"

namespace vitrail::test::shadow_ends_test {
namespace {

const Material black{DiffuseMaterial{ConstantSpectrum{0}}};
const Material white{DiffuseMaterial{ConstantSpectrum{1}}};

std::array<Point3f, 4> square(Point3f at, float half, bool up) {
  std::array<Point3f, 4> q{{{at.x - half, at.y - half, at.z},
                            {at.x + half, at.y - half, at.z},
                            {at.x + half, at.y + half, at.z},
                            {at.x - half, at.y + half, at.z}}};
  if (!up) std::swap(q[1], q[3]);
  return q;
}

// A white spot of 2 m, `distance` below a lamp in the plane z = 0 and `aside` of it, in units of the
// distance. Floats are finest at the lamp.
struct Room {
  double distance, aside = 0;
  float lamp_half = 1;
  Scene scene;

  Room(double d, double a, float half) : distance(d), aside(a), lamp_half(half) {
    const auto z = static_cast<float>(-distance), x = static_cast<float>(aside * distance);
    add_shape(scene, add_quads(scene, {square({x, 0, z}, 1, true)}), white);
    // Its counterpart.
    add_shape(scene, add_quads(scene, {square({-x, 0, -z}, 1, true)}), black);
    add_shape(scene, add_quads(scene, {square({0, 0, 0}, lamp_half, false)}), black,
              AreaLight{ConstantSpectrum{1}});
    OrthographicCamera camera;
    const Point3d spot{static_cast<double>(x), 0, static_cast<double>(z)};
    camera.camera_to_world = look_at(spot + Vector3d{0, 0, 0.25}, spot, {0, 1, 0});
    camera.screen = {-0.1, 0.1, -0.1, 0.1};
    scene.camera = camera;
    scene.film.width = scene.film.height = 8;
    scene.film.crop = {0, 8, 0, 8};
    scene.film.filter = BoxFilter{};
    scene.settings.max_depth = 1;
  }
  Brightness seen(int samples) const { return brightness(render(scene, samples).film); }
};

TEST(ShadowEnds, BehindWhatStandsBeforeALamp) {
  // Of a float: 2⁻²³ of the way to the lamp is the least that a ray's end can tell.
  for (const double distance : {20.0, 500.0, 20e3})
    for (const double gap : {2.5e-3, 2.5e-4, 2.5e-5, 2.5e-6})
      for (const double aside : {0.0, 1.0, 5.0}) {
        if (gap < distance * std::hypot(1, aside) * 0x1p-23) continue;
        Room room(distance, aside, 1);
        add_shape(room.scene, add_quads(room.scene, {square({0, 0, static_cast<float>(-gap)}, 1.5f, false)}),
                  black);
        EXPECT_EQ(room.seen(16).mean, 0) << gap << " m before a lamp at " << distance << ", aside " << aside;
      }
}

// Light comes through the sheet, by its own rays or by shadow rays or both, as if it hung half way.
double as_if_half_way(double distance, double gap, const Material& sheet, double thickness) {
  std::array<Brightness, 2> seen;
  for (int i = 0; i < 2; ++i) {
    const auto half = static_cast<float>(distance);
    Room room(distance, 0.1, half);
    const auto z = static_cast<float>(i == 0 ? -distance / 2 : -gap);
    if (thickness > 0)
      add_shape(room.scene,
                add_quads(room.scene, box_faces({-30 * half, -30 * half, z - static_cast<float>(thickness)},
                                                {30 * half, 30 * half, z})),
                sheet);
    else
      add_shape(room.scene, add_quads(room.scene, {square({0, 0, z}, 30 * half, false)}), sheet);
    room.scene.settings.max_depth = 3;
    seen[static_cast<std::size_t>(i)] = room.seen(256);
  }
  fmt::print("{:g} m before a lamp at {:g} m: {:.4f} ± {:.4f} of {:.4f}\n", gap, distance, seen[1].mean,
             seen[1].standard_error, seen[0].mean);
  EXPECT_GT(seen[0].mean, 0);
  return seen[1].mean / seen[0].mean;
}

TEST(ShadowEnds, BehindGlassBeforeALamp) {
  ThinDielectricMaterial thin;
  thin.transmittance_factor = ConstantSpectrum{0.25f};
  for (const double distance : {20.0, 500.0, 20e3})
    for (const double gap : {2.5e-3, 2.5e-5, 2.5e-6}) {
      if (gap < distance * 0x1p-23) continue;
      // Nearer, the lamp, which faces the ray, would be met before the back of the glass.
      if (gap > distance * 0x1p-20) {
        EXPECT_NEAR(as_if_half_way(distance, gap, Material{DielectricMaterial{ConstantSpectrum{1.5f}}}, 0.01),
                    1, 0.05);
      }
      EXPECT_NEAR(as_if_half_way(distance, gap, Material{thin}, 0), 1, 0.05);
    }
}

// ---- The lamp is not in the way

// Exporters put them there, and the floor's vertices are rounded: pbrt and Mitsuba end a shadow ray before
// it.
TEST(ShadowEnds, OfAPointLightThatStandsInASurface) {
  const auto seen = [](std::optional<float> tilt) {
    Room room(1, 1, 1);
    room.scene.shapes.pop_back();
    if (tilt) {
      std::array<Point3f, 4> floor = square({0, 0, 0}, 1, false);
      for (Point3f& p : floor) p.z = p.x * *tilt;
      add_shape(room.scene, add_quads(room.scene, {floor}), black);
    }
    room.scene.lights.push_back(Light{PointLight{{0, 0, 0}, ConstantSpectrum{1}}});
    return room.seen(64).mean;
  };
  const double alone = seen({});
  EXPECT_GT(alone, 0);
  for (const float tilt : {0.0f, 2e-7f, -2e-7f}) EXPECT_EQ(seen(tilt), alone) << tilt;
}

// ∫ cosθ cosθ′/r² dA / π of what a point with the normal +z sees of a mesh that hides nothing of itself that
// faces the point, as the mesh stands in the bundle.
double form_factor(const TriangleMesh& mesh, Point3d from, int steps) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    const auto p = [&](std::size_t k) { return cast<double>(mesh.positions[t[k]]); };
    const Vector3d e1 = p(1) - p(0), e2 = p(2) - p(0), across = cross(e1, e2);
    for (int i = 0; i < steps; ++i)
      for (int j = 0; j < steps; ++j) {
        const bool upper = i + j >= steps;
        const double u = (i + (upper ? 2.0 : 1.0) / 3) / steps, v = (j + (upper ? 2.0 : 1.0) / 3) / steps;
        if (u + v > 1) continue;
        for (const int flip : {0, 1}) {
          const double a = flip ? u + 1.0 / 3 / steps : u, b = flip ? v + 1.0 / 3 / steps : v;
          if (a + b > 1) continue;
          const Vector3d to = p(0) + e1 * a + e2 * b - from;
          const double r2 = dot(to, to), facing = -dot(to, across), height = to.z;
          if (facing > 0 && height > 0) sum += facing * height / (r2 * r2) / (2.0 * steps * steps);
        }
      }
  }
  return sum / pi;
}

// Of a spot around `at`, far from the centre of the scene, below a lamp that is given about 0.
void expect_unshadowed(Point3d at, TriangleMesh lamp, const char* what, int steps, double tolerance = 0) {
  for (Point3f& p : lamp.positions) p = cast<float>(cast<double>(p) + (at - Point3d{}));
  Scene scene;
  const Point3f floor = cast<float>(at);
  add_shape(scene, add_quads(scene, {square(floor, 0.25f, true)}), white);
  add_shape(scene, add_quads(scene, {square({-floor.x, -floor.y, -floor.z}, 0.25f, true)}), black);
  const double expected = form_factor(lamp, at, steps), radiance = 0.1 / expected;
  scene.meshes.push_back(lamp);
  add_shape(scene, {2}, black, AreaLight{ConstantSpectrum{static_cast<float>(radiance)}});
  if (at.x != 0) {
    TriangleMesh opposite = lamp;
    for (Point3f& p : opposite.positions) p = {-p.x, -p.y, -p.z};
    scene.meshes.push_back(opposite);
    add_shape(scene, {3}, black);
  }
  OrthographicCamera camera;
  camera.camera_to_world = look_at(at + Vector3d{0, 0, 0.125}, at, {0, 1, 0});
  camera.screen = {-0.01, 0.01, -0.01, 0.01};
  scene.camera = camera;
  scene.film.width = scene.film.height = 8;
  scene.film.crop = {0, 8, 0, 8};
  scene.film.filter = BoxFilter{};
  scene.settings.max_depth = 1;
  const Brightness seen = brightness(render(scene, 512).film);
  fmt::print("{} at ({:g}, {:g}, {:g}): {:.5f} ± {:.5f} of 0.1\n", what, at.x, at.y, at.z, seen.mean,
             seen.standard_error);
  EXPECT_NEAR(seen.mean, 0.1, 4 * seen.standard_error + tolerance * 0.1);
}

TriangleMesh tilted_square(double half, double height, double tilt_rad) {
  TriangleMesh mesh;
  for (const Point3f& p : square({0, 0, 0}, static_cast<float>(half), false))
    mesh.positions.push_back(cast<float>(transform_point(
        translate({0, 0, height}) * rotate(tilt_rad, normalize(Vector3d{1, 2, 0})), cast<double>(p))));
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

TEST(ShadowEnds, BeforeAFlatLamp) {
  for (const double x : {0.0, 1e3, 1e6})
    for (const double tilt : {0.0, 0.4, 1.2})
      expect_unshadowed({x, x / 2, 0}, tilted_square(1, 2, tilt), "a tilted square", 64);
  // Small and far away, where the direction is rounded by more than the lamp is wide.
  expect_unshadowed({0, 0, 0}, tilted_square(0.01, 2e4, 0.3), "a point", 4);
  expect_unshadowed({1e4, 0, 0}, tilted_square(0.01, 2e4, 0.3), "a point", 4);
  // Grazed.
  expect_unshadowed({0, 0, 0}, tilted_square(1, 2, 1.5), "a slanting square", 64);
}

TriangleMesh ball(Point3d centre, double radius, std::uint32_t rings, bool inwards) {
  TriangleMesh mesh;
  const std::uint32_t around = 2 * rings;
  for (std::uint32_t i = 0; i <= rings; ++i)
    for (std::uint32_t k = 0; k < around; ++k) {
      const double theta = pi * i / rings, phi = 2 * pi * k / around;
      mesh.positions.push_back(
          cast<float>(centre + Vector3d{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                                        std::cos(theta)} *
                                   radius));
    }
  for (std::uint32_t i = 0; i < rings; ++i)
    for (std::uint32_t k = 0; k < around; ++k) {
      const std::uint32_t a = i * around + k, b = i * around + (k + 1) % around, c = a + around,
                          d = b + around;
      if (i > 0) mesh.triangles.push_back({a, c, b});
      if (i + 1 < rings) mesh.triangles.push_back({b, c, d});
    }
  if (inwards)
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

TEST(ShadowEnds, BeforeACurvedLamp) {
  for (const std::uint32_t rings : {8u, 32u, 120u}) {
    const int steps = static_cast<int>(240 / rings);  // across a triangle: the horizon cuts some
    expect_unshadowed({0, 0, 0}, ball({0.5, 0, 3}, 1, rings, false), "a ball", steps, 2e-4);
    expect_unshadowed({1e3, 0, 0}, ball({0.5, 0, 3}, 1, rings, false), "a ball", steps, 2e-3);
    expect_unshadowed({0, 0, 0}, ball({0.1, 0.2, 0.3}, 5, rings, true), "a hollow", steps, 2e-4);
    expect_unshadowed({1e3, 0, 0}, ball({0.1, 0.2, 0.3}, 5, rings, true), "a hollow", steps, 2e-3);
  }
}

// A lamp in a ceiling, flush with it: neither is in the other's way.
TEST(ShadowEnds, BeforeALampInACeiling) {
  for (const double aside : {0.0, 2.0, 20.0}) {
    Room room(2, aside, 1);
    const Brightness alone = room.seen(512);
    const auto strip = [](float x0, float x1, float y0, float y1) {
      return std::array<Point3f, 4>{{{x0, y0, 0}, {x0, y1, 0}, {x1, y1, 0}, {x1, y0, 0}}};
    };
    add_shape(room.scene,
              add_quads(room.scene, {strip(-90, -1, -90, 90), strip(1, 90, -90, 90), strip(-1, 1, -90, -1),
                                     strip(-1, 1, 1, 90)}),
              black);
    const Brightness flush = room.seen(512);
    EXPECT_GT(alone.mean, 0);
    EXPECT_NEAR(flush.mean, alone.mean, 4 * (flush.standard_error + alone.standard_error)) << aside;
  }
}

}  // namespace
}  // namespace vitrail::test::shadow_ends_test
