// SPDX-License-Identifier: Apache-2.0
// Panes and depth: what passes them on its way from the last scattering to its light is not counted, whoever
// finds the light. And thick slabs, behind which the wavelengths lie beside each other.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "scene/geometry/portable_math.h"
#include "scene/spectra/named_spectra.h"
#include "tests/laws/light/flat_scenes.h"
#include "tests/support/long_tests.h"
#include "tracer/bsdf/local.h"

namespace vitrail::test::pane_depth_test {
namespace {

enum class Source { sun, sky, lamp };

Scene below_panes(Source light, int panes, int depth) {
  Scene scene;
  const Material grey{DiffuseMaterial{ConstantSpectrum{0.5f}}};
  add_shape(scene, square(scene, 0, 2), grey);
  for (int i = 0; i < panes; ++i) {
    const float z = 0.5f + 0.125f * static_cast<float>(i);
    add_shape(scene, add_quads(scene, box_faces({-2, -2, z}, {2, 2, z + 0.0625f})),
              Material{DielectricMaterial{ConstantSpectrum{1.5f}}});
  }
  if (light == Source::sun)
    scene.lights.push_back(Light{DistantLight{normalize(Vector3d{0.3, 0.2, -1}), ConstantSpectrum{3}}});
  else if (light == Source::sky)
    scene.lights.push_back(Light{InfiniteLight{ConstantSpectrum{1}}});
  else
    add_shape(scene, add_quads(scene, {{{{-1, -1, 2}, {-1, 1, 2}, {1, 1, 2}, {1, -1, 2}}}}), grey,
              AreaLight{ConstantSpectrum{1}});
  scene.settings.max_depth = depth;
  look_along(scene, {0, 0, 1}, {}, 1);
  // From below the panes.
  std::get<OrthographicCamera>(scene.camera).camera_to_world = look_at({0, 0, 0.25}, {0, 0, 0}, {0, 1, 0});
  return scene;
}

double by_paths(const Scene& scene, int samples) { return brightness(render(scene, samples).film).mean; }

double by_photons(const Scene& scene, std::uint64_t photons) {
  RenderOptions options;
  options.picture.samples_per_pixel = 32;  // Of four wavelengths each: fewer have a tint.
  options.picture.integrator = Integrator::photon;
  options.picture.photons = {photons, 0.1, 0.9};
  return brightness(render(scene, std::move(options)).film).mean;
}

TEST(DepthBehindPanes, IsThatOfTheOpen) {
  for (const Source light : {Source::sun, Source::sky, Source::lamp})
    for (const int panes : {1, 4}) {
      const int samples = light == Source::sun ? 16 : 256;
      const double deep = by_paths(below_panes(light, panes, 60), samples);
      for (const int depth : are_long()   ? std::vector{1, 3, 8}
                             : panes == 1 ? std::vector{1, 8}
                                          : std::vector{3}) {
        const Scene scene = below_panes(light, panes, depth);
        const double paths = by_paths(scene, samples);
        const double photons = by_photons(scene, light == Source::sky ? 16000 : 4000);
        fmt::print("light {}, {} panes, depth {}: {:.4f} of what a depth of 60 has, photons ÷ paths {:.4f}\n",
                   static_cast<int>(light), panes, depth, paths / deep, photons / paths);
        // What is reflected between faces, and between them and the floor, still counts.
        EXPECT_GT(paths / deep, 0.5) << panes << ' ' << depth;
        EXPECT_NEAR(photons / paths, 1, 0.03) << panes << ' ' << depth;
      }
    }
}

// ---- Thick slabs

// The greatest difference of X and Z, over that of white, along a row of pixels that sees a bright half plane
// below a slab of flint at 65°.
double colours_at_an_edge(double thickness, double pixel, bool one_wavelength) {
  Scene scene;
  const double incidence = 65 * pi / 180;
  const auto t = static_cast<float>(thickness);
  const double shift = thickness * std::tan(std::asin(std::sin(incidence) / 1.78));
  const auto edge = static_cast<float>(shift);
  add_shape(scene,
            add_quads(scene, {{{{edge, -20, -t - 0.001f},
                                {20, -20, -t - 0.001f},
                                {20, 20, -t - 0.001f},
                                {edge, 20, -t - 0.001f}}}}),
            Material{DiffuseMaterial{ConstantSpectrum{0}}}, AreaLight{ConstantSpectrum{1}});
  add_shape(scene, add_quads(scene, box_faces({-20, -20, -t}, {20, 20, 0})),
            Material{DielectricMaterial{*named_spectrum("glass-SF11")}});
  scene.settings.max_depth = 4;
  const Vector3d out{-std::sin(incidence), 0, std::cos(incidence)};
  set_camera(scene, Point3d{} + out * 10.0, {0, 0, 0}, {0, 1, 0}, pixel * 8 / 10, 32, 8);
  RenderOptions options;
  options.picture.samples_per_pixel = 256;
  options.picture.samples.sampling.one_wavelength = one_wavelength;
  const Film film = render(scene, std::move(options)).film;
  std::array<XYZ, 32> column{};
  for (std::uint32_t i = 0; i < 32 * 8; ++i) {
    const XYZ c = film.mean(i);
    column[i % 32].x += c.x, column[i % 32].y += c.y, column[i % 32].z += c.z;
  }
  const XYZ white = column[0].y > column[31].y ? column[0] : column[31];
  double greatest = 0;
  for (const XYZ& c : column) greatest = std::max(greatest, std::abs(c.x / white.x - c.z / white.z));
  return greatest;
}

TEST(ThickSlabs, HaveColouredEdges) {
  for (const double pixels : {4.0, 1.0, 0.25}) {
    const double thickness = 0.5, aside = 0.0135 * thickness;
    const double four = colours_at_an_edge(thickness, aside / pixels, false),
                 one = colours_at_an_edge(thickness, aside / pixels, true);
    fmt::print("{} pixels wide: {:.3f}, by single wavelengths {:.3f}\n", pixels, four, one);
    EXPECT_NEAR(four, one, 0.08);
  }
}

TEST(ThinPanes, KeepTheirWavelengths) {
  // 6 mm at a pixel of a millimetre: both the picture and its noise stay as they were.
  const auto noise = [](bool one) {
    Scene scene;
    add_shape(scene, add_quads(scene, {{{{-20, -20, -1}, {20, -20, -1}, {20, 20, -1}, {-20, 20, -1}}}}),
              Material{DiffuseMaterial{ConstantSpectrum{0}}}, AreaLight{ConstantSpectrum{1}});
    add_shape(scene, add_quads(scene, box_faces({-20, -20, -0.006f}, {20, 20, 0})),
              Material{DielectricMaterial{*named_spectrum("glass-BK7")}});
    set_camera(scene, {-1, 0, 1}, {0, 0, 0}, {0, 1, 0}, 0.01, 16, 16);
    RenderOptions options;
    options.picture.samples_per_pixel = 16;
    options.picture.samples.sampling.one_wavelength = one;
    return brightness(render(scene, std::move(options)).film).standard_error;
  };
  const double four = noise(false), one = noise(true);
  fmt::print("noise of four wavelengths {:.3g}, of one {:.3g}\n", four, one);
  EXPECT_LT(four, 0.7 * one);
}

}  // namespace
}  // namespace vitrail::test::pane_depth_test
