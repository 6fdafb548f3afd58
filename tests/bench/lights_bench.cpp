// SPDX-License-Identifier: Apache-2.0
// What a light sample and the density of a given triangle cost, in CPU time, and how much noise the choice of
// the light makes: 1 to 10⁵ triangles, by the tree and by power alone.
#include <fmt/format.h>

#include <cmath>

#include "tests/bench/timing.h"
#include "tests/tracer/lights/light_fixtures.h"

namespace vitrail::test {
namespace {

// Small lamps all over a flat room of 20 × 20 × 4, each shining down; `spread`: of their power, e-folds.
std::vector<EmissiveTriangle> lamps(std::uint32_t count, Random& random) {
  std::vector<EmissiveTriangle> all;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Point3d p{random.between(-10, 10), random.between(-10, 10), random.between(0, 4)};
    const double size = 0.02 + 0.05 * random();
    const Vector3d e1 = random.direction() * size;
    Vector3d e2 = random.direction() * size;
    if (cross(e1, e2).z > 0) e2 = -e2;
    all.push_back({{cast<float>(p), cast<float>(p + e1), cast<float>(p + e2)}, {}, i, 0});
  }
  return all;
}

// A sphere of radius 1 that shines, as a mesh.
std::vector<EmissiveTriangle> sphere(std::uint32_t count) {
  const auto rings = static_cast<int>(std::max(2.0, std::sqrt(count / 4.0)));
  const int sectors = 2 * rings;
  const auto at = [&](int i, int j) {
    const double t = 3.14159265358979 * i / rings, f = 6.28318530717959 * (j % sectors) / sectors;
    return cast<float>(Point3d{std::sin(t) * std::cos(f), std::sin(t) * std::sin(f), std::cos(t) + 2});
  };
  std::vector<EmissiveTriangle> all;
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < sectors; ++j)
      for (int half = 0; half < 2; ++half)
        if (half ? i > 0 : i + 1 < rings)
          all.push_back({{at(i, j), at(i + 1, half ? j + 1 : j), half ? at(i, j + 1) : at(i + 1, j + 1)},
                         {},
                         static_cast<std::uint32_t>(all.size()),
                         0});
  return all;
}

void run(const char* what, const std::vector<EmissiveTriangle>& triangles, LightChoice choice) {
  AreaLight light;
  light.radiance = Spectrum{ConstantSpectrum{1}};
  LightScene scene;
  scene.area_lights = {&light, 1};
  scene.triangles = triangles;
  scene.bounds = {{-10, -10, 0}, {10, 10, 4}};
  const double before = cpu_seconds();
  const LightSampler s = make_light_sampler(scene, ImageSource{}, choice);
  const double built = cpu_seconds() - before;

  constexpr int count = 400000, points = 1 << 12;
  Random random(7);
  std::vector<Point3d> p;
  for (int i = 0; i < points; ++i)
    p.push_back({random.between(-10, 10), random.between(-10, 10), random.between(0, 0.5)});
  std::vector<std::array<float, 4>> u;
  for (int i = 0; i < (1 << 16); ++i) u.push_back(random.four());
  const SampledWavelengths w = some_wavelengths();

  double sum = 0;
  const double start = cpu_seconds();
  for (int i = 0; i < count; ++i)
    if (const auto l = sample_light(s, p[static_cast<std::size_t>(i % points)],
                                    u[static_cast<std::size_t>(i & 0xffff)], w))
      sum += l->pdf;
  const double sampled = cpu_seconds();
  for (int i = 0; i < count; ++i)
    sum += triangle_pdf(
        s, p[static_cast<std::size_t>(i % points)],
        static_cast<std::uint32_t>(static_cast<double>(u[static_cast<std::size_t>(i & 0xffff)][0]) *
                                   static_cast<double>(triangles.size())),
        {}, 1, 0.5);
  const double asked = cpu_seconds();

  // Relative variance of the irradiance of a floor, mean over points.
  double noise = 0;
  int lit = 0;
  for (int k = 0; k < 200; ++k) {
    double first = 0, second = 0;
    constexpr int samples = 1000;
    for (int i = 0; i < samples; ++i)
      if (const auto l = sample_light(s, p[static_cast<std::size_t>(k)], random.four(), w)) {
        const double x = static_cast<double>(l->radiance[0]) * std::max(0.0, l->to_light.z) / l->pdf;
        first += x / samples;
        second += x * x / samples;
      }
    if (first > 0) noise += second / (first * first) - 1, ++lit;
  }
  fmt::print("{:7} {:7} {:6} {:9.0f} {:9.0f} {:9.1f} {:9.2f}{}\n", what, triangles.size(),
             choice == LightChoice::tree ? "tree" : "power", 1e9 * (sampled - start) / count,
             1e9 * (asked - sampled) / count, 1e3 * built, noise / std::max(1, lit), sum > 0 ? "" : " dark");
}

// A sky of 1024 × 512 with a sun, in memory.
void run_environment() {
  std::vector<double> texels;
  for (int i = 0; i < 1024 * 512; ++i) texels.push_back(i == 300000 ? 1e4 : 1 + i % 7);
  const auto image = std::make_shared<GreyImage>(1024, 512, texels);
  EnvironmentLight sky;
  sky.projection = EnvironmentLight::Projection::latitude_longitude;
  const std::vector<Light> lights{{sky, {}}};
  LightScene scene;
  scene.lights = lights;
  const double before = cpu_seconds();
  const LightSampler s = make_light_sampler(scene, only(image));
  const double built = cpu_seconds();
  Random random(1);
  constexpr int count = 400000;
  double sum = 0;
  for (int i = 0; i < count; ++i)
    if (const auto l = sample_light(s, {0, 0, 0}, random.four(), some_wavelengths())) sum += l->pdf;
  const double sampled = cpu_seconds();
  for (int i = 0; i < count; ++i) sum += background(s, random.direction(), some_wavelengths()).pdf;
  const double asked = cpu_seconds();
  fmt::print(
      "environment of 1024 x 512: {:.0f} ns a sample, {:.0f} ns a look-up with its pdf, {:.0f} ms to "
      "build{}\n",
      1e9 * (sampled - built) / count, 1e9 * (asked - sampled) / count, 1e3 * (built - before),
      sum > 0 ? "" : " dark");
}

int main_program() {
  fmt::print("{:7} {:>7} {:6} {:>9} {:>9} {:>9} {:>9}\n", "lights", "number", "choice", "ns/sample", "ns/pdf",
             "build ms", "variance");
  for (const std::uint32_t count : {1u, 2u, 8u, 32u, 100u, 1000u, 100000u})
    for (const LightChoice choice : {LightChoice::power, LightChoice::tree}) {
      Random random(1);
      run("lamps", lamps(count, random), choice);
      if (count >= 32) run("sphere", sphere(count), choice);
    }
  run_environment();
  return 0;
}

}  // namespace
}  // namespace vitrail::test

int main() { return vitrail::test::main_program(); }
