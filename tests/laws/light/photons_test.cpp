// SPDX-License-Identifier: Apache-2.0
// What photon mapping converges to: closed forms where photons alone bring light, and path tracing.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "scene/geometry/portable_math.h"
#include "tests/laws/light/flat_scenes.h"
#include "tests/support/long_tests.h"
#include "tracer/bsdf/fresnel.h"
#include "tracer/bsdf/plastic.h"
#include "tracer/photons/progressive.h"

namespace vitrail::test::photons_test {
namespace {

const int iterations = of_all(64, 32);

Rendered photon_mapped(const Scene& scene, std::uint64_t photons, double radius, double alpha = 2.0 / 3,
                       int spp = iterations) {
  RenderOptions options;
  options.picture.samples_per_pixel = spp;
  options.picture.integrator = Integrator::photon;
  options.picture.photons = {photons, radius, alpha};
  return render(scene, std::move(options));
}

double mean(const Rendered& rendered) { return brightness(rendered.film).mean; }

Material glass(const Spectrum& eta) {
  DielectricMaterial glass;
  glass.eta = eta;
  return Material{glass};
}

// A point light behind a sheet that bends nothing, and that no connection passes: intensity/d²·cos θ over the
// disc of each radius. Path tracing sees nothing of it.
TEST(Photons, IrradianceBehindASheet) {
  Scene scene;
  const double reflectance = 0.5, d = 1;
  add_shape(scene, square(scene, 0, 2), Material{DiffuseMaterial{ConstantSpectrum{0.5f}}});
  add_shape(scene, square(scene, 0.5f, 2), glass(ConstantSpectrum{1}));
  scene.lights.push_back({PointLight{{0, 0, d}, ConstantSpectrum{3}}, {}});
  look_along(scene, {0, 0, 1}, {}, 0.01);
  EXPECT_EQ(mean(render(scene, 4)), 0);
  const PhotonKey key{40000, 0.25, 0.8};
  double expected = 0;
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(iterations); ++i) {
    const double r = radius_of(key, i);
    expected += 3 * 2 / (r * r) * (1 / d - 1 / std::sqrt(d * d + r * r)) * d * reflectance / pi / iterations;
  }
  EXPECT_NEAR(mean(photon_mapped(scene, key.photons, key.first_radius, key.alpha)), expected,
              0.02 * expected);
}

// Where the scene asks for photons it gets them, with what it says of them; what is asked for goes before.
TEST(Photons, AsTheSceneAsks) {
  Scene scene;
  add_shape(scene, square(scene, 0, 2), Material{DiffuseMaterial{ConstantSpectrum{0.5f}}});
  add_shape(scene, square(scene, 0.5f, 2), glass(ConstantSpectrum{1}));
  scene.lights.push_back({PointLight{{0, 0, 1}, ConstantSpectrum{3}}, {}});
  look_along(scene, {0, 0, 1}, {}, 0.01);
  const Rendered asked = photon_mapped(scene, 2000, 0.25, 0.8, 4);
  scene.settings.photons = PhotonSettings{2000, 0.25, 0.8};
  EXPECT_EQ(render(scene, 4).film.hash(), asked.film.hash());
  scene.settings.photons = PhotonSettings{77, 0.5, 0.8};
  RenderOptions options;
  options.picture.samples_per_pixel = 4;
  options.picture.photons = {2000, 0.25, {}};
  EXPECT_EQ(render(scene, options).film.hash(), asked.film.hash());
  options.picture.photons = {};
  options.picture.integrator = Integrator::path;
  EXPECT_EQ(mean(render(scene, options)), 0);
  options.picture.photons.photons = 10;
  EXPECT_THROW(render(scene, options), UsageError);
}

// The same below a varnish: of what falls in along the normal the coat and the base send so much back.
TEST(Photons, IrradianceBelowASmoothCoat) {
  Scene scene;
  PlasticMaterial varnish;
  varnish.diffuse_reflectance = ConstantSpectrum{0.5f};
  const double d = 1;
  add_shape(scene, square(scene, 0, 2), Material{varnish});
  add_shape(scene, square(scene, 0.5f, 2), glass(ConstantSpectrum{1}));
  scene.lights.push_back({PointLight{{0, 0, d}, ConstantSpectrum{3}}, {}});
  const Vector3d out = direction(50, 30);
  look_along(scene, out, {}, 0.01);
  EXPECT_EQ(mean(render(scene, 4)), 0);
  const double eta = static_cast<double>(varnish.eta) / static_cast<double>(varnish.exterior_eta);
  const PlasticBsdf model{filled(0.5f), filled(1), eta, fresnel_diffuse(1 / eta)};
  const double f = static_cast<double>(eval(model, out, {0, 0, 1}).value[0]);
  EXPECT_NEAR(mean(photon_mapped(scene, 40000, 0.1)), 3 / (d * d) * f, 0.02 * 3 * f);
}

// All walls of a box shine: Σ ρᵏ over the depths.
TEST(Photons, FurnaceToEachDepth) {
  for (const int depth : {1, 2, 6}) {
    Scene scene = lit_box(12);
    scene.shapes.resize(1);
    scene.area_lights[0].radiance = ConstantSpectrum{1};
    scene.shapes[0].area_light = Id<AreaLight>{0};
    scene.settings.max_depth = depth;
    set_camera(scene, {0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 0.8, 12, 12);
    double expected = 0;
    for (int k = 0; k <= depth; ++k) expected += std::pow(0.6, k);
    EXPECT_NEAR(mean(photon_mapped(scene, 8000, 0.2)), expected, 0.01 * expected) << depth;
  }
}

// Beyond the edges of the walls a disc finds no photons: the wider, the darker. As it shrinks the picture
// becomes that of path tracing.
TEST(Photons, AsPathsAsTheRadiusShrinks) {
  const Scene scene = lit_box(16);
  const double paths = mean(render(scene, 256)), narrow = mean(photon_mapped(scene, 20000, 0.05));
  EXPECT_NEAR(narrow / paths, 1, 0.01);
  EXPECT_LT(mean(photon_mapped(scene, 2000, 1)), narrow);
}

// The pixels of an iteration share its photons and its wavelengths: what the batches of a film tell of the
// error of its mean is no less than the scatter of the means by their seeds.
TEST(Photons, TheFilmKnowsTheErrorOfItsMean) {
  const Scene scene = lit_box(12);
  constexpr int seeds = 12;
  double sum = 0, squares = 0, told = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    RenderOptions options;
    options.picture.samples_per_pixel = 64;
    options.picture.seed = static_cast<std::uint64_t>(seed);
    options.picture.integrator = Integrator::photon;
    options.picture.photons = {500, 0.2, 0.8};
    const Rendered rendered = render(scene, std::move(options));
    const Brightness b = brightness(rendered.film);
    const double shared = rendered.film.shared_error() * b.mean;
    sum += b.mean, squares += b.mean * b.mean;
    told += shared * shared / seeds;
  }
  const double variance = (squares - sum * sum / seeds) / (seeds - 1);
  // Of 12 seeds a standard deviation is known within 21 %. A batch has 32 wavelengths, all together 256,
  // which are stratified better: up to some 3 times as much is told.
  EXPECT_GT(told, 0.4 * variance);
  EXPECT_LT(told, 16 * variance);
}

// Light that connections do not look for, here of a sky that is the same all around, is seen through a sheet
// by the path that gathers, as no photon that came straight is kept.
TEST(Photons, ASkyBehindASheet) {
  Scene scene;
  add_shape(scene, square(scene, 0, 2), Material{DiffuseMaterial{ConstantSpectrum{0.5f}}});
  add_shape(scene, square(scene, 0.5f, 2), Material{ThinDielectricMaterial{}});
  scene.lights.push_back({InfiniteLight{ConstantSpectrum{1}}, {}});
  look_along(scene, {0, 0, 1}, {}, 0.01);
  const double paths = mean(render(scene, 1024));
  EXPECT_GT(paths, 0.3);
  EXPECT_NEAR(mean(photon_mapped(scene, 20000, 0.25)) / paths, 1, 0.02);
}

// Walls and block below a varnish: what the coat mirrors goes on, what the base scatters is gathered.
TEST(Photons, AsPathsBelowASmoothCoat) {
  Scene scene = lit_box(16);
  PlasticMaterial varnish;
  varnish.diffuse_reflectance = ConstantSpectrum{0.6f};
  for (Material& material : scene.materials)
    if (std::holds_alternative<DiffuseMaterial>(material.model)) material.model = varnish;
  scene.settings.max_depth = 6;
  const double paths = mean(render(scene, 512)), photons = mean(photon_mapped(scene, 8000, 0.05));
  fmt::print("photons {:+.2f} % of paths\n", 100 * (photons / paths - 1));
  EXPECT_NEAR(photons / paths, 1, 0.01);
}

// A slanted block of glass, without and with dispersion: refraction, total reflection, shading by what comes
// through, and photons that keep one wavelength.
TEST(Photons, AsPathsBehindGlass) {
  // SF11 (Schott).
  const Spectrum flint =
      SellmeierSpectrum{{1.73759695, 0.313747346, 1.89878101}, {0.013188707, 0.0623068142, 155.23629}};
  for (const bool disperses : {false, true}) {
    Scene scene = lit_box(16);
    const Vector3d x = normalize(Vector3d{1, 0.4, 0.2}), z = normalize(cross(x, Vector3d{-0.4, 1, 0.3})),
                   y = cross(z, x);
    auto faces = box_faces({-.45f, -.3f, -.4f}, {.45f, .3f, .4f});
    for (auto& face : faces)
      for (Point3f& corner : face) {
        const Point3d p = cast<double>(corner);
        corner = cast<float>(Point3d{0.1, -0.3, 0.2} + x * p.x + y * p.y + z * p.z);
      }
    add_shape(scene, add_quads(scene, faces), glass(disperses ? flint : ConstantSpectrum{1.5f}));
    scene.settings.max_depth = 8;
    const double paths = mean(render(scene, 512)), photons = mean(photon_mapped(scene, 8000, 0.06));
    fmt::print("photons {:+.2f} % of paths\n", 100 * (photons / paths - 1));
    EXPECT_NEAR(photons / paths, 1, 0.012) << disperses;
  }
}

}  // namespace
}  // namespace vitrail::test::photons_test
