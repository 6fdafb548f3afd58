// SPDX-License-Identifier: Apache-2.0
// The sun's disc behind glass: what of it stands beside a straight edge, in a penumbra, against the closed
// form.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "scene/daylight/sky_model.h"
#include "scene/geometry/portable_math.h"
#include "scene/spectra/named_spectra.h"
#include "tests/laws/light/flat_scenes.h"

namespace vitrail::test::sun_disc_test {
namespace {

constexpr double diameter_deg = 8, height = 1;
constexpr float index = 1.5f;

// The share of a uniform disc beside an edge that runs s radii from its middle.
double share_beside(double s) { return 1 - (std::acos(s) - s * std::sqrt(1 - s * s)) / pi; }

Material glass() {
  DielectricMaterial m;
  m.eta = ConstantSpectrum{index};
  return Material{m};
}

// White ground, seen at x < 0 from above, but not from where glass mirrors the sun, which is in the zenith;
// an opaque half-plane at that height from x = 0 on.
Scene ground_beside_an_edge(double x, double half_width) {
  Scene scene;
  add_shape(scene, square(scene, 0, 0.3f), Material{DiffuseMaterial{ConstantSpectrum{0.5f}}});
  add_shape(scene, square(scene, static_cast<float>(height), 0.2f, 0.2f),
            Material{DiffuseMaterial{ConstantSpectrum{0}}});
  SkyLight sun;
  sun.sky_scale = 0;
  sun.sun_diameter_deg = diameter_deg;
  sun.limb_darkening = false;
  scene.lights.push_back({sun, {}});
  look_along(scene, direction(12, 90), {x, 0, 0}, half_width);
  return scene;
}

// Where an edge at the height seen through `thickness` of glass has the rim of the sun before it.
double penumbra(double thickness) {
  const double sine = std::sin(diameter_deg / 360 * pi), inside = sine / static_cast<double>(index);
  const auto tangent = [](double s) { return s / std::sqrt(1 - s * s); };
  return (height - thickness) * tangent(sine) + thickness * tangent(inside);
}

// Behind a pane: by connections.
TEST(SunDisc, CastsAPenumbraThroughAPane) {
  const float low = 0.3f, high = 0.7f;
  const double width = penumbra(static_cast<double>(high - low));
  const auto seen = [&](double x) {
    Scene scene = ground_beside_an_edge(x, 1e-4);
    add_shape(scene, add_quads(scene, box_faces({-.25f, -.25f, low}, {.25f, .25f, high})), glass());
    scene.settings.max_depth = 4;
    return mean_of(render(scene, 64).film);
  };
  const double lit = seen(-2 * width).value.y;
  ASSERT_GT(lit, 0);
  for (const double s : {0.05, 0.4, 0.8})
    expect_luminance(seen(-s * width), lit * share_beside(s), 0.01, fmt::format("{} radii", s), 0.005);
}

// Under the surface of glass that fills what is below, where connections find nothing: by photons. Without a
// disc there was no penumbra.
TEST(SunDisc, CastsAPenumbraOfPhotons) {
  const float surface = 0.8f;
  const double width = penumbra(static_cast<double>(surface));
  const auto seen = [&](double x, bool photons) {
    Scene scene = ground_beside_an_edge(x, 0.002);
    add_shape(scene, square(scene, surface, 0.3f), glass());
    scene.settings.max_depth = 4;
    RenderOptions options;
    options.picture.samples_per_pixel = photons ? 64 : 16;
    if (photons)
      options.picture.integrator = Integrator::photon, options.picture.photons = {25000, 0.016, 0.9};
    return mean_of(render(scene, std::move(options)).film).value.y;
  };
  EXPECT_EQ(seen(-2 * width, false), 0);
  const double lit = seen(-2 * width, true);
  ASSERT_GT(lit, 0);
  for (const double s : {0.05, 0.5}) {
    const double found = seen(-s * width, true) / lit;
    fmt::print("{} radii: {:.4f} of {:.4f}\n", s, found, share_beside(s));
    EXPECT_NEAR(found, share_beside(s), 0.05) << s;
  }
}

// Parallel rays into its middle, past or through or by a body of this material.
double seen_disc(const std::optional<Material>& material, bool in_the_way, Vector3d turned = {0, 0, 1}) {
  Scene scene;
  SkyLight sun;
  sun.sky_scale = 0;
  sun.sun_diameter_deg = diameter_deg;
  sun.limb_darkening = false;
  scene.lights.push_back({sun, {}});
  add_shape(scene, square(scene, -30, 0.1f, 8), Material{DiffuseMaterial{ConstantSpectrum{0.5f}}});
  const float x = in_the_way ? -1 : 5;
  if (material) add_shape(scene, add_quads(scene, box_faces({x, -1, 1}, {x + 2, 1, 2})), *material);
  look_along(scene, -turned, {0, 0, 0}, 0.1);
  scene.settings.max_depth = 30;
  return mean_of(render(scene, 64).film).value.y;
}

// What connections go to as a distant light where something refracts is seen all the same: by the camera,
// through glass and in mirrors.
TEST(SunDisc, IsSeenWhateverRefracts) {
  const double bare = seen_disc(std::nullopt, false);
  SkyLight sun;
  sun.sky_scale = 0, sun.sun_diameter_deg = diameter_deg, sun.limb_darkening = false;
  const SkyModel model(sun);
  EXPECT_NEAR(bare, luminance(spectrum_of_bands(model.sun(model.to_sun()))), 0.02 * bare);
  SubsurfaceMaterial wax;
  wax.eta = ConstantSpectrum{1.3f};
  EXPECT_NEAR(seen_disc(Material{wax}, false), bare, 0.01 * bare) << "beside wax";
  EXPECT_NEAR(seen_disc(glass(), false), bare, 0.01 * bare) << "beside glass";
  const double reflected = 0.04;  // of index 1.5
  EXPECT_NEAR(seen_disc(glass(), true), bare * (1 - reflected) / (1 + reflected), 0.02 * bare)
      << "through glass";
  EXPECT_NEAR(seen_disc(glass(), true, {0, 0, -1}), bare * 2 * reflected / (1 + reflected), 0.02 * bare)
      << "in the faces of glass";
}

// Seen by what scatters it counts once.
TEST(SunDisc, LightsAsMuchBesideGlass) {
  const auto lit = [](bool beside) {
    Scene scene = ground_beside_an_edge(-0.1, 0.02);
    if (beside) add_shape(scene, add_quads(scene, box_faces({5, 5, 5}, {6, 6, 6})), glass());
    scene.settings.max_depth = 4;
    return mean_of(render(scene, 64).film);
  };
  expect_luminance(lit(true), lit(false).value.y, 0.01, "beside glass", 0.005);
}

// The point of the disc is a function of the sample, whoever traces it.
TEST(SunDisc, IsOneWhateverTheDomains) {
  for (const Material& pane : {glass(), Material{DielectricMaterial{bk7()}}}) {
    Scene scene = ground_beside_an_edge(-0.01, 0.02);
    add_shape(scene, add_quads(scene, box_faces({-.25f, -.25f, 0.3f}, {.25f, .25f, 0.7f})), pane);
    scene.settings.max_depth = 8;
    const Rendered one = render(scene, 8, 1), eight = render(scene, 8, 8);
    EXPECT_GT(brightness(one.film).mean, 0);
    EXPECT_EQ(one.film.hash(), eight.film.hash());
  }
}

}  // namespace
}  // namespace vitrail::test::sun_disc_test
