// SPDX-License-Identifier: Apache-2.0
// A thin beam through a prism and through a ball of glass: at each wavelength, the angle at which the light
// leaves has to be Snell's. It falls on a far screen that shines from 0 at one edge to 1 at the other, so the
// spectrum of the beam over the one that a screen of 1 gives is the place where each wavelength lands.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "scene/geometry/portable_math.h"
#include "scene/spectra/named_spectra.h"
#include "tests/support/render.h"

namespace vitrail::test::dispersion_test {
namespace {

constexpr double screen_distance = 500;
constexpr SpectralBins bins{.count = 235};  // of 2 nm

// All in the plane z = 0.
struct Experiment {
  Scene glass;          // without camera and screen
  Point3d target;       // where the beam meets the glass
  double beam_rad = 0;  // its direction, from +x
  Point3d (*leaves)(const Experiment&, double n) = nullptr;
  double (*deviation_rad)(const Experiment&, double n) = nullptr;  // clockwise
  Spectrum eta;
  double incidence_rad = 0;

  double index(double lambda_nm) const { return evaluate(eta, lambda_nm); }
  double angle(double lambda_nm) const { return beam_rad - deviation_rad(*this, index(lambda_nm)); }
  Point3d exit(double lambda_nm) const { return leaves(*this, index(lambda_nm)); }
};

Vector3d towards(double angle) { return {std::cos(angle), std::sin(angle), 0}; }

Point3f rounded(const Point3d& p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

// Across the light of the middle of the spectrum; `start` + u·`along`, u in [0,1].
struct Screen {
  Point3d start;
  Vector3d along;
};

Screen screen_of(const Experiment& e) {
  const double middle = (e.angle(bins.min_nm) + e.angle(bins.max_nm)) / 2;
  const double half = 0.6 * std::abs(e.angle(bins.min_nm) - e.angle(bins.max_nm));
  const Point3d centre = e.exit(550) + towards(middle) * screen_distance;
  const Vector3d along = towards(middle + pi / 2) * (screen_distance * std::tan(half));
  return {centre - along, along * 2.0};
}

// Mean radiance of each bin.
std::vector<double> spectrum_of_beam(const Experiment& e, bool ramp) {
  Scene scene = e.glass;
  OrthographicCamera camera;
  camera.camera_to_world = look_at(e.target - towards(e.beam_rad) * 3.0, e.target, {0, 0, 1});
  camera.screen = {-1e-7, 1e-7, -1e-7, 1e-7};
  scene.camera = camera;
  scene.film.width = scene.film.height = 4;
  scene.film.crop = {0, 4, 0, 4};
  scene.film.filter = BoxFilter{};
  scene.settings.max_depth = 2;  // two refractions and nothing else

  const Screen screen = screen_of(e);
  const Vector3d up{0, 0, 10};
  TriangleMesh mesh;
  for (const Point3d& p : {screen.start - up, screen.start + screen.along - up,
                           screen.start + screen.along + up, screen.start + up})
    mesh.positions.push_back(rounded(p));
  mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  // A black one opposite keeps the glass in the middle of the scene, where floats are finest.
  TriangleMesh opposite = mesh;
  for (Point3f& p : opposite.positions) p = {-p.x, -p.y, -p.z};
  scene.meshes.push_back(opposite);
  const Material black{DiffuseMaterial{ConstantSpectrum{0}}};
  add_shape(scene, {static_cast<std::uint32_t>(scene.meshes.size() - 1)}, black);
  scene.meshes.push_back(mesh);
  AreaLight light{ConstantSpectrum{1}};
  light.two_sided = true;
  // Textures that shine are under D65, of which the ratio of the two knows nothing.
  const Spectrum begin = ConstantSpectrum{ramp ? 0.0f : 1.0f}, one = ConstantSpectrum{1};
  scene.textures.push_back({BilinearTexture{begin, begin, one, one, UvMapping{}}, false, "", {}});
  light.radiance = Id<Texture>{static_cast<std::uint32_t>(scene.textures.size() - 1)};
  add_shape(scene, {static_cast<std::uint32_t>(scene.meshes.size() - 1)}, black, light);

  scene.film.spectrum = bins;
  const Film film = render(scene, 4096, 2).film;
  std::vector<double> means;
  for (int bin = 0; bin < bins.count; ++bin) {
    double sum = 0;
    for (std::uint32_t pixel = 0; pixel < 16; ++pixel)
      sum += film.mean_of_bin(pixel, static_cast<std::size_t>(bin));
    means.push_back(sum / 16);
  }
  return means;
}

// Every wavelength of a bin lands between where the ends of the bin do: that is all the measure can tell,
// beside the rounding of vertices and the facets of a ball.
void expect_snell(const Experiment& e, const char* name) {
  constexpr double slack_rad = 2e-6;
  const std::vector<double> ramp = spectrum_of_beam(e, true), all = spectrum_of_beam(e, false);
  const Screen screen = screen_of(e);
  double worst = 0, resolution = 0;
  for (double lambda = 400; lambda < 760; lambda += 18) {
    const int bin = static_cast<int>((lambda - bins.min_nm) / bins.width_nm());
    const auto at = static_cast<std::size_t>(bin);
    const double centre = bins.centre_nm(bin), half = bins.width_nm() / 2;
    ASSERT_GT(all[at], 0) << name << ", " << centre << " nm";
    const Vector3d ray = screen.start + screen.along * (ramp[at] / all[at]) - e.exit(centre);
    const double measured = e.beam_rad - std::atan2(ray.y, ray.x), expected = e.beam_rad - e.angle(centre);
    const double width = std::abs(e.angle(centre - half) - e.angle(centre + half)) / 2 + slack_rad;
    EXPECT_NEAR(measured, expected, width) << name << ", " << centre << " nm";
    worst = std::max(worst, std::abs(measured - expected));
    resolution = std::max(resolution, width);
  }
  fmt::print("{}: spectrum over {:.4f}°, largest error {:.6f}°, resolution {:.6f}°\n", name,
             std::abs(e.angle(400) - e.angle(742)) * 180 / pi, worst * 180 / pi, resolution * 180 / pi);
}

// ---- A prism of 60°, its apex up, at the height 0; the beam comes from −x and is bent down, to its base

constexpr double apex_rad = pi / 3;

double prism_inside(const Experiment& e, double n) { return std::asin(std::sin(e.incidence_rad) / n); }

Experiment prism(const Spectrum& glass, double incidence_rad) {
  const auto half = static_cast<float>(std::tan(apex_rad / 2));
  const Point3f a0{-half, -1, -1}, b0{half, -1, -1}, c0{0, 0, -1}, a1{-half, -1, 1}, b1{half, -1, 1},
      c1{0, 0, 1};
  Experiment e;
  e.eta = glass;
  e.incidence_rad = incidence_rad;
  e.target = {-std::tan(apex_rad / 2) / 2, -0.5, 0};
  e.beam_rad = incidence_rad - apex_rad / 2;
  e.deviation_rad = [](const Experiment& of, double n) {
    const double second = apex_rad - prism_inside(of, n);
    return of.incidence_rad + std::asin(n * std::sin(second)) - apex_rad;
  };
  e.leaves = [](const Experiment& of, double n) {
    const Vector3d d = towards(prism_inside(of, n) - apex_rad / 2);
    const double slope = std::tan(apex_rad / 2);  // x = −slope·y on the second face
    return of.target + d * (-(of.target.x + slope * of.target.y) / (d.x + slope * d.y));
  };
  add_shape(e.glass, add_quads(e.glass, {{{a0, a1, c1, c0}}, {{b0, c0, c1, b1}}, {{a0, b0, b1, a1}}}),
            Material{DielectricMaterial{glass}});
  return e;
}

TEST(Dispersion, PrismSendsEachWavelengthWhereSnellSays) {
  expect_snell(prism(bk7(), 0.86), "BK7 prism");
  expect_snell(prism(*named_spectrum("glass-SF11"), 1.1), "SF11 prism");
}

// ---- A ball of radius 1 about the origin, of which a slice about z = 0 is enough

// Deviates by 2(i − r), both angles being equal at the two refractions. The beam goes along +x above the
// centre and is bent down. A bundle keeps 16 bits of normals: vertices stand where that is exact.
Experiment ball(const Spectrum& glass, double incidence_rad) {
  constexpr int segments = 8000;         // facets are 8·10⁻⁸ inside of the sphere
  constexpr double half_width = 0.0005;  // along z: 1.3·10⁻⁷
  Experiment e;
  e.eta = glass;
  e.incidence_rad = incidence_rad;
  e.target = Point3d{-std::cos(incidence_rad), std::sin(incidence_rad), 0};
  e.deviation_rad = [](const Experiment& of, double n) {
    return 2 * (of.incidence_rad - std::asin(std::sin(of.incidence_rad) / n));
  };
  e.leaves = [](const Experiment& of, double n) {
    const double inside = std::asin(std::sin(of.incidence_rad) / n);
    return Point3d{} + towards(pi - of.incidence_rad - (pi - 2 * inside));
  };
  TriangleMesh mesh;
  const double radius = std::sqrt(1 - half_width * half_width);
  for (int s = 0; s < segments; ++s)
    for (const double z : {-half_width, half_width}) {
      const Vector3d across = towards(2 * pi * (s + 0.5) / segments) * radius;
      const Point3f p = rounded({across.x, across.y, z});
      const Normal3f n = decode_normal(encode_normal(to_normal(cast<double>(p - Point3f{}))));
      mesh.positions.push_back({n.x, n.y, n.z});
      mesh.normals.push_back(n);
    }
  constexpr auto count = static_cast<std::uint32_t>(2 * segments);
  for (std::uint32_t i = 0; i < count; i += 2) {
    mesh.triangles.push_back({i, (i + 2) % count, (i + 3) % count});
    mesh.triangles.push_back({i, (i + 3) % count, i + 1});
  }
  e.glass.meshes.push_back(std::move(mesh));
  add_shape(e.glass, {0}, Material{DielectricMaterial{glass}});
  return e;
}

TEST(Dispersion, BallDeviatesByTwiceTheBendOfOneRefraction) {
  for (const double degrees : {25.0, 50.0, 75.0})
    for (const char* glass : {"glass-BK7", "glass-SF11"})
      expect_snell(ball(*named_spectrum(glass), degrees * pi / 180),
                   fmt::format("{} ball, incidence {}°", glass, degrees).c_str());
}

}  // namespace
}  // namespace vitrail::test::dispersion_test
