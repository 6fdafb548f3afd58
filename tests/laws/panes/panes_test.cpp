// SPDX-License-Identifier: Apache-2.0
// The sun through panes, wherever they stand and however they are written and stored: each takes from its
// light what its two faces reflect, to and fro between them, and nothing else. What is no pane lets no light
// of a point-like sun through, but for photons.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>

#include "scene/geometry/portable_math.h"
#include "scene/spectra/color.h"
#include "scene/spectra/named_spectra.h"
#include "tests/support/long_tests.h"
#include "tests/support/polarised.h"
#include "tests/support/render.h"
#include "tracer/bsdf/local.h"

namespace vitrail::test::panes_test {
namespace {

constexpr double irradiance = 3, albedo = 0.5;

// A floor about (x, 0, 0), seen from close above; x has a counterpart, so that it stays this far from the
// centre of the scene.
struct Site {
  double x = 0;
  Scene scene;
  Vector3d to_sun = normalize(Vector3d{0.3, 0.2, 1});

  explicit Site(double at, double floor_size = 1) : x(at) {
    const auto size = static_cast<float>(floor_size);
    for (const auto middle : {static_cast<float>(x), static_cast<float>(-x)})
      add_shape(scene,
                add_quads(scene, {{{{middle - size, -size, 0},
                                    {middle + size, -size, 0},
                                    {middle + size, size, 0},
                                    {middle - size, size, 0}}}}),
                Material{DiffuseMaterial{ConstantSpectrum{static_cast<float>(albedo)}}});
    look_from(0.5);
    scene.settings.max_depth = 1;
  }
  void look_from(double height, double fov_rad = 0.01) {
    set_camera(scene, {x, 0, height}, {x, 0, 0}, {0, 1, 0}, fov_rad, 4, 4);
  }
  Point3d point(double distance) const { return Point3d{x, 0, 0} + to_sun * distance; }
  void add_sun() {
    scene.lights.push_back(Light{DistantLight{-to_sun, ConstantSpectrum{static_cast<float>(irradiance)}}});
  }
  double open_sky() const { return albedo / pi * irradiance * to_sun.z; }
  // Of a film whose constant spectra have the luminance of these samples' wavelengths.
  double seen(int samples = 64) const {
    Scene sky;
    sky.camera = scene.camera;
    sky.film = scene.film;
    sky.lights.push_back(Light{InfiniteLight{ConstantSpectrum{1}}});
    return brightness(render(scene, samples).film).mean / brightness(render(sky, samples).film).mean;
  }
  double seen_by_photons() const {
    Scene sky;
    sky.camera = scene.camera;
    sky.film = scene.film;
    sky.lights.push_back(Light{InfiniteLight{ConstantSpectrum{1}}});
    RenderOptions options;
    options.picture.samples_per_pixel = 64;
    options.picture.integrator = Integrator::photon, options.picture.photons = {5000, 0.1, 0.8};
    return brightness(render(scene, options).film).mean / brightness(render(sky, options).film).mean;
  }
};

// From the unit cube about 0.
struct Pane {
  double size = 1, thickness = 0.006;
  double tilt_rad = 0;  // about the axis (1,1,0)
  bool shading_normals = false, instanced = false;
  Spectrum glass = ConstantSpectrum{1.5f};

  Transform turned() const { return rotate(tilt_rad, normalize(Vector3d{1, 1, 0})); }
  Vector3d normal() const { return transform_vector(turned(), {0, 0, 1}); }
};

Id<TriangleMesh> cube(Scene& scene, bool shading_normals) {
  const auto mesh = add_quads(scene, box_faces({-0.5f, -0.5f, -0.5f}, {0.5f, 0.5f, 0.5f}));
  if (shading_normals) {
    TriangleMesh& m = scene.meshes[mesh.value];
    for (std::size_t quad = 0; quad < 6; ++quad) {
      const auto p = [&](std::size_t k) { return cast<double>(m.positions[4 * quad + k]); };
      const Vector3f n = cast<float>(normalize(cross(p(1) - p(0), p(2) - p(0))));
      for (int k = 0; k < 4; ++k) m.normals.push_back({n.x, n.y, n.z});
    }
  }
  return mesh;
}

void add_pane(Scene& scene, const Pane& pane, Point3d centre) {
  const Transform place = translate(centre - Point3d{}) * pane.turned();
  const Transform stretch = scale({pane.size, pane.size, pane.thickness});
  const auto mesh = cube(scene, pane.shading_normals);
  add_shape(scene, mesh, Material{DielectricMaterial{pane.glass}});
  if (!pane.instanced) {
    scene.shapes.back().object_to_world = place * stretch;
    return;
  }
  Prototype prototype;
  prototype.shapes.push_back(scene.shapes.back());
  prototype.shapes.back().object_to_world = stretch;
  scene.shapes.pop_back();
  scene.prototypes.push_back(prototype);
  const Id<Prototype> id{static_cast<std::uint32_t>(scene.prototypes.size() - 1)};
  scene.instances.push_back({id, place, {}});
  // A second use, so that there is something to keep.
  scene.instances.push_back({id, place * translate({0, 0, 40 * pane.size}), {}});
}

// Of `count` panes, all reflections between their faces included.
double through(double cosine, double eta, int count = 1) {
  return over_polarisations([&](Fresnel f) {
    const double reflected = f(cosine, eta);
    return (1 - reflected) / (1 + (2 * count - 1) * reflected);
  });
}

// The bound of the error that the rounding of the corners makes, by the normal alone.
double rounding_of(const Site& site, const Pane& pane) {
  const double off = 0x1p-24 * std::abs(pane.normal().x) * site.x;
  const double tilt = 6 * off / (0.5 * pane.size), cosine = std::abs(dot(site.to_sun, pane.normal()));
  return 1e-4 + std::abs(through(cosine + tilt, 1.5) / through(cosine, 1.5) - 1) +
         std::abs(through(cosine - tilt, 1.5) / through(cosine, 1.5) - 1);
}

void expect_light_through(double x, const Pane& pane, const char* what) {
  Site site(x);
  site.look_from(std::min(0.5, 0.5 * pane.size));
  add_pane(site.scene, pane, site.point(2 * pane.size));
  site.add_sun();
  const double expected = site.open_sky() * through(std::abs(dot(site.to_sun, pane.normal())), 1.5);
  const double seen = site.seen();
  fmt::print("{}: x {:g}, {:g} m, {:g} m thick, {:.3f} rad: {:.6f} of {:.6f}\n", what, x, pane.size,
             pane.thickness, pane.tilt_rad, seen, expected);
  EXPECT_NEAR(seen / expected, 1, rounding_of(site, pane));
}

// As far as its faces are told apart by what a coordinate is rounded by.
TEST(SunThroughAPane, WhereverItStands) {
  for (const double x : {0.0, 1e3, 1e4, 1e5, 1e6, 1e7})
    expect_light_through(x, {.size = std::max(1.0, x * 1e-5), .thickness = std::max(0.006, x * 4e-9)},
                         "flat");
  for (const double x : {0.0, 1e3, 1e4, 1e5, 1e6, 1e7})
    for (const double tilt : {0.2, 0.7, -0.9})
      for (const bool normals : {false, true})
        for (const bool instanced : {false, true})
          expect_light_through(x,
                               {.size = std::max(1.0, x * 1e-4),
                                .thickness = std::max(0.006, x * 2e-6),
                                .tilt_rad = tilt,
                                .shading_normals = normals,
                                .instanced = instanced},
                               "tilted");
}

TEST(SunThroughAPane, OfAnySize) {
  for (const double size : {0.05, 0.2, 1.0, 5.0})
    for (const double thickness : {0.002, 0.02})
      for (const double x : {0.0, 300.0, 1000.0})
        expect_light_through(x, {.size = size, .thickness = thickness, .tilt_rad = 0.4}, "small");
}

// Wide panes: nothing that they reflect to and fro leaves between them.
TEST(SunThroughAPane, AndAnother) {
  for (const double x : {0.0, 1000.0})
    for (int count = 1; count <= 4; ++count)
      for (const double gap : {0.012, 0.1}) {
        Site site(x);
        const Pane pane{.size = 8, .tilt_rad = 0.5, .shading_normals = gap > 0.05};
        for (int i = 0; i < count; ++i)
          add_pane(site.scene, pane, site.point(2) + pane.normal() * (gap * (i - 1.5)));
        site.add_sun();
        const double all = through(std::abs(dot(site.to_sun, pane.normal())), 1.5, count);
        EXPECT_NEAR(site.seen() / (site.open_sky() * all), 1, count * rounding_of(site, pane))
            << count << " panes, " << gap << " apart at " << x;
      }
}

TEST(SunThroughAPane, OfSeveralSuns) {
  Site site(1000);
  const Pane pane{.tilt_rad = 0.5};
  add_pane(site.scene, pane, site.point(2));
  double expected = 0;
  const Vector3d middle = site.to_sun;
  for (const double turn : {0.0, 1e-4, 1e-2, -2e-2}) {
    site.to_sun = normalize(middle + Vector3d{turn, 0, 0});
    site.add_sun();
    expected += site.open_sky() * through(std::abs(dot(site.to_sun, pane.normal())), 1.5);
  }
  EXPECT_NEAR(site.seen(256) / expected, 1, rounding_of(site, pane));
}

// ---- As files have it, rounded to decimals

// A window of 3 × 2.5 m of 6 mm glass, turned about three axes, written with so many decimals.
void add_written_window(Site& site, int turn, int decimals, int panes) {
  const double step = std::pow(10.0, -decimals);
  const Transform turned = rotate(0.4 * turn, {0, 0, 1}) * rotate(0.35 * std::sin(turn), {1, 0, 0}) *
                           rotate(0.25 * std::cos(2 * turn), {0, 1, 0});
  const Vector3d normal = transform_vector(turned, {0, 0, 1});
  for (int i = 0; i < panes; ++i) {
    const auto mesh = cube(site.scene, false);
    const Transform place =
        translate(site.point(3) + normal * (0.03 * i) - Point3d{}) * turned * scale({3, 2.5, 0.006});
    for (Point3f& p : site.scene.meshes[mesh.value].positions) {
      const Point3d q = transform_point(place, cast<double>(p));
      const auto written = [&](double x) { return static_cast<float>(std::round(x / step) * step); };
      p = {written(q.x), written(q.y), written(q.z)};
    }
    add_shape(site.scene, mesh, Material{DielectricMaterial{ConstantSpectrum{1.5f}}});
  }
}

double through_written_window(int turn, int decimals, int panes) {
  Site site(0);
  add_written_window(site, turn, decimals, panes);
  site.add_sun();
  return site.seen();
}

TEST(SunThroughAPane, WhoseFileHasFewDecimals) {
  constexpr int turns = 16;
  for (const int panes : {1, 3}) {
    std::array<double, turns> exact{};
    for (int turn = 0; turn < turns; ++turn)
      exact[static_cast<std::size_t>(turn)] = through_written_window(turn, 12, panes);
    for (const int decimals : {3, 4, 6}) {
      double least = 2, most = 0;
      for (int turn = 0; turn < turns; ++turn) {
        const double share =
            through_written_window(turn, decimals, panes) / exact[static_cast<std::size_t>(turn)];
        least = std::min(least, share);
        most = std::max(most, share);
      }
      fmt::print("{} decimals, {} panes: {:.5f} to {:.5f} of what exact ones let through\n", decimals, panes,
                 least, most);
      EXPECT_GT(least, 0.998);
      EXPECT_LT(most, 1.002);
    }
  }
}

// ---- What is no pane

// A slab whose faces meet at an angle.
void add_wedge(Site& site, double wedge_rad) {
  Scene& scene = site.scene;
  const auto mesh = cube(scene, false);
  const float steep = static_cast<float>(wedge_rad / 2);
  const float half = std::max(0.05f, 0.6f * steep);
  for (Point3f& p : scene.meshes[mesh.value].positions) p.z = std::copysign(half + p.x * steep, p.z);
  add_shape(scene, mesh, Material{DielectricMaterial{ConstantSpectrum{1.5f}}});
  scene.shapes.back().object_to_world = translate(site.point(2) - Point3d{}) * Pane{.tilt_rad = 0.4}.turned();
}

double through_wedge(double x, double wedge_rad) {
  Site site(x);
  add_wedge(site, wedge_rad);
  site.add_sun();
  return site.seen() / site.open_sky();
}

// Either paths find it by a connection or photons bring it, never both, whatever the wedge.
TEST(SunThroughAWedge, IsFoundOnce) {
  for (const double wedge : {0.0, 3e-5, 1.2e-4, 1.3e-4, 3e-4, 2e-3}) {
    Site site(0);
    site.look_from(0.5, 0.5);  // so that many photons count
    add_wedge(site, wedge);
    site.add_sun();
    const double expected = through(std::abs(dot(site.to_sun, Pane{.tilt_rad = 0.4}.normal())), 1.5);
    const double by_paths = site.seen() / site.open_sky() / expected,
                 by_photons = site.seen_by_photons() / site.open_sky() / expected;
    fmt::print("a wedge of {:g} rad: {:.4f} by paths, {:.4f} by photons\n", wedge, by_paths, by_photons);
    EXPECT_NEAR(by_photons, 1, 0.02) << wedge;
    EXPECT_TRUE(by_paths == 0 || std::abs(by_paths - 1) < 0.005) << wedge;
    EXPECT_EQ(by_paths > 0, wedge < 1.25e-4) << wedge;
  }
}

TEST(SunThroughAWedge, IsDark) {
  for (const double wedge : {1e-1, 1e-2, 1e-3, 3e-4, 1.3e-4, 3e-5}) {
    const std::array<double, 3> seen{through_wedge(0, wedge), through_wedge(100, wedge),
                                     through_wedge(1000, wedge)};
    fmt::print("a wedge of {:g} rad: {:.4f}, at 100 m {:.4f}, at 1 km {:.4f}\n", wedge, seen[0], seen[1],
               seen[2]);
    // What is no worse than float glass, or the corners' rounding, of both faces, cannot tell from a pane.
    const std::array<double, 3> limits{1.3e-4, 1.3e-4, 1e-3};
    for (std::size_t i = 0; i < 3; ++i)
      if (wedge >= limits[i]) {
        EXPECT_EQ(seen[i], 0) << wedge;
      }
  }
}

// What connections lose is counted, whatever the wedge: of panes that taper, and of prisms.
TEST(SunThroughAWedge, IsToldAtEveryAngle) {
  for (const double wedge : {0.0, 3e-4, 2e-3, 0.02, 0.05, 0.15, 0.2, 0.3, 0.4, 0.6}) {
    Site site(0);
    add_wedge(site, wedge);
    site.add_sun();
    const TraceCounters traced = render(site.scene, 16).stats.traced;
    const double lost =
        static_cast<double>(traced.connections_in_wedges) / static_cast<double>(traced.connections_in_glass);
    const double widest_rad = 1e-9 * static_cast<double>(traced.widest_wedge_nrad);
    fmt::print("a wedge of {:g} rad: {:.3f} of {} are lost, the widest {:.4g}\n", wedge, lost,
               traced.connections_in_glass, widest_rad);
    EXPECT_EQ(lost, wedge > 0 ? 1 : 0) << wedge;
    EXPECT_NEAR(widest_rad, std::sin(2 * std::atan(wedge / 2)), 0.01 * wedge) << wedge;
  }
}

TEST(SunThroughCurvedGlass, IsDark) {
  Site site(0);
  constexpr int rings = 24, around = 48;
  TriangleMesh ball;
  for (int i = 0; i <= rings; ++i)
    for (int k = 0; k < around; ++k) {
      const double theta = pi * i / rings, phi = 2 * pi * k / around;
      const Vector3f p = cast<float>(
          Vector3d{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
      ball.positions.push_back({p.x, p.y, p.z});
      ball.normals.push_back({p.x, p.y, p.z});
    }
  for (std::uint32_t i = 0; i < rings; ++i)
    for (std::uint32_t k = 0; k < around; ++k) {
      const std::uint32_t a = i * around + k, b = i * around + (k + 1) % around, c = a + around,
                          d = b + around;
      if (i > 0) ball.triangles.push_back({a, c, b});
      if (i + 1 < rings) ball.triangles.push_back({b, c, d});
    }
  site.scene.meshes.push_back(ball);
  add_shape(site.scene, {static_cast<std::uint32_t>(site.scene.meshes.size() - 1)},
            Material{DielectricMaterial{ConstantSpectrum{1.5f}}});
  site.scene.shapes.back().object_to_world = translate(site.point(2.2) + Vector3d{0.2, 0.1, 0} - Point3d{});
  site.add_sun();
  EXPECT_EQ(site.seen(64), 0);
}

// ---- Dispersive glass

constexpr SpectralBins bins{.count = 47};  // of 10 nm

struct BinMean {
  double mean = 0, error = 0;  // by how its 16 pixels differ
};

// Radiance of each bin on a small screen across the sun's light, below a pane across +z.
std::vector<BinMean> spectrum_below(const Spectrum& glass, double incidence_rad, bool pane) {
  Site site(0, 1e-3);
  Scene& scene = site.scene;
  scene.shapes.clear();
  site.to_sun = {std::sin(incidence_rad), 0, std::cos(incidence_rad)};
  add_shape(scene, add_quads(scene, {{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}}}),
            Material{DiffuseMaterial{ConstantSpectrum{1}}});
  scene.shapes.back().object_to_world = rotate(incidence_rad, {0, 1, 0}) * scale({5e-3, 5e-3, 1});
  OrthographicCamera camera;
  camera.camera_to_world = look_at(Point3d{} + site.to_sun * 0.004, {0, 0, 0}, {0, 1, 0});
  camera.screen = {-4e-3, 4e-3, -4e-3, 4e-3};  // so wide that the wavelengths stay together
  scene.camera = camera;
  if (pane)
    add_shape(scene, add_quads(scene, box_faces({-400, -400, 0.0078125f}, {400, 400, 0.015625f})),
              Material{DielectricMaterial{glass}});
  site.add_sun();

  scene.film.spectrum = bins;
  // Light that grazes goes to and fro for long.
  const Film film = render(scene, incidence_rad > 1.56 ? of_all(512, 128) : 2048).film;
  std::vector<BinMean> means(static_cast<std::size_t>(bins.count));
  for (std::size_t bin = 0; bin < means.size(); ++bin) {
    auto& [mean, error] = means[bin];
    for (std::uint32_t pixel = 0; pixel < 16; ++pixel) mean += film.mean_of_bin(pixel, bin) / 16;
    for (std::uint32_t pixel = 0; pixel < 16; ++pixel)
      error += std::pow(film.mean_of_bin(pixel, bin) - mean, 2) / (16 * 15);
    error = std::sqrt(error);
  }
  return means;
}

TEST(SunThroughDispersiveGlass, EachWavelengthByItsOwnFresnel) {
  std::map<double, std::vector<BinMean>> open_sky;  // by degrees, whatever the glass
  for (const char* name : {"glass-BK7", "glass-SF11"}) {
    const Spectrum glass = *named_spectrum(name);
    for (const double degrees : are_long()
                                    ? std::vector{0.0, 30.0, 60.0, 75.0, 80.0, 85.0, 88.0, 89.0, 89.9, 89.99}
                                    : std::vector{0.0, 60.0, 80.0, 89.0, 89.99}) {
      const double incidence = degrees * pi / 180;
      if (!open_sky.contains(degrees)) open_sky[degrees] = spectrum_below(glass, incidence, false);
      const std::vector<BinMean>&open = open_sky[degrees], below = spectrum_below(glass, incidence, true);
      // By the width of a bin, and the direction rounded by 3.5e-7 rad; of a bin also by the noise of the few
      // that go to and fro, by chances that suit the mean of four wavelengths.
      const double rounding = 5e-4 + 7e-7 / std::cos(incidence);
      double sum[2]{}, weight[2]{};  // of the shorter half, and the longer
      for (std::size_t bin = 2; bin < 45; ++bin) {
        const double lambda = bins.centre_nm(static_cast<int>(bin));
        const double expected = through(std::cos(incidence), evaluate(glass, lambda));
        const double off = below[bin].mean / open[bin].mean / expected - 1,
                     error = below[bin].error / below[bin].mean;
        EXPECT_LT(std::abs(off), 8e-3 + rounding + 6 * error)
            << name << " at " << degrees << ", " << lambda << " nm";
        const int half = lambda < 550 ? 0 : 1;
        const double w = 1 / (error * error + 1e-8);
        sum[half] += w * off, weight[half] += w;
      }
      for (const int half : {0, 1}) {
        const double mean = sum[half] / weight[half], error = 1 / std::sqrt(weight[half]);
        fmt::print("{} at {}°, {} half: off by {:.5f} ± {:.5f}\n", name, degrees,
                   half == 0 ? "shorter" : "longer", mean, error);
        EXPECT_LT(std::abs(mean), rounding + 4 * error) << name << " at " << degrees;
      }
    }
  }
}

}  // namespace
}  // namespace vitrail::test::panes_test
