// SPDX-License-Identifier: Apache-2.0
// A million lamps, each of another brightness.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "scene/geometry/portable_math.h"
#include "scene/system/resource_usage.h"
#include "tests/extremes/measure.h"
#include "tests/laws/exact/soup.h"

namespace vitrail::test::many_lights_test {
namespace {

// All `side`² of them 5 above a floor, `spacing` apart, with the middle over the origin.
struct Lamp {
  Point3d at;
  double intensity;  // along its normal, which looks down
};

std::vector<Lamp> lamps(int side, double spacing) {
  SoupRandom random(5);
  std::vector<Lamp> all;
  for (int i = 0; i < side; ++i)
    for (int k = 0; k < side; ++k) {
      const double half = (side - 1) / 2.0;
      all.push_back({{(i - half) * spacing, (k - half) * spacing, 5}, random.log_uniform(1e-3, 10)});
    }
  return all;
}

// Radiance of a floor of albedo .5 at p. `lambertian`: a small flat lamp, else a point.
double radiance_at(Point3d p, const std::vector<Lamp>& all, bool lambertian) {
  long double sum = 0;
  for (const Lamp& one : all) {
    const Vector3d d = one.at - p;
    const long double d2 = dot(d, d), cosine = d.z / std::sqrt(d2);
    sum += one.intensity * cosine / d2 * (lambertian ? cosine : 1);
  }
  return static_cast<double>(0.5L / static_cast<long double>(pi) * sum);
}

// Triangles of 1 cm, of ten lights of different radiance.
void add_triangles(Scene& scene, const std::vector<Lamp>& all) {
  constexpr float edge = 0.01f, area = edge * edge / 2;
  constexpr std::size_t kinds = 10;
  std::vector<TriangleMesh> meshes(kinds);
  for (std::size_t i = 0; i < all.size(); ++i) {
    TriangleMesh& mesh = meshes[i % kinds];
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const Point3f p = cast<float>(all[i].at);
    const Vector3f third{edge / 3, edge / 3, 0};
    mesh.positions.insert(mesh.positions.end(),
                          {p - third, p - third + Vector3f{0, edge, 0}, p - third + Vector3f{edge, 0, 0}});
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  for (std::size_t kind = 0; kind < kinds; ++kind) {
    scene.meshes.push_back(std::move(meshes[kind]));
    add_shape(scene, {static_cast<std::uint32_t>(scene.meshes.size() - 1)}, matte(0),
              lamp(all[kind].intensity / static_cast<double>(area)));
  }
}

void expect_sum(const char* what, Scene& scene, const std::vector<Lamp>& all, bool lambertian, int samples) {
  scene.settings.max_depth = 1;
  set_orthographic(scene, {0.3, 0.2, 4}, {0.3, 0.2, 0}, {0, 1, 0}, 0.01, 32);
  const Measured b = measure(scene, samples);
  expect_relative(fmt::format("{} {}", all.size(), what), radiance_at({0.3, 0.2, 0}, all, lambertian), b.mean,
                  5e-4, b.standard_error);
  report("their noise at that many samples a pixel, relative", b.standard_error * 32 / b.mean);
}

TEST(ManyLights, AMillionTriangles) {
  std::vector<Lamp> all = lamps(1000, 0.1);
  for (std::size_t i = 0; i < all.size(); ++i) all[i].intensity = all[i % 10].intensity;
  Scene scene;
  add_shape(scene, add_quads(scene, {square_at(0, 60)}), matte(0.5f));
  add_triangles(scene, all);
  expect_sum("lamps of 1 cm", scene, all, true, run_whole() ? 4096 : 256);
  report("peak of the process", static_cast<double>(peak_resident_bytes()) / 1e6, "MB");
}

TEST(ManyLights, APointEach) {
  const std::vector<Lamp> all = run_whole() ? lamps(1000, 0.1) : lamps(316, 0.1);
  Scene scene;
  add_shape(scene, add_quads(scene, {square_at(0, 60)}), matte(0.5f));
  for (const Lamp& one : all) add_point(scene, one.at, one.intensity);
  expect_sum("point lights", scene, all, false, run_whole() ? 4096 : 256);
  report("peak of the process", static_cast<double>(peak_resident_bytes()) / 1e6, "MB");
}

}  // namespace
}  // namespace vitrail::test::many_lights_test
