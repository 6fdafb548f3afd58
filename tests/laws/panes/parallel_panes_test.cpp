// SPDX-License-Identifier: Apache-2.0
// The sun through parallel panes and sheets: what all orders of the reflections between their faces let
// through, by the adding method (Stokes 1862) in double, of s and p apart.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "scene/geometry/portable_math.h"
#include "scene/spectra/named_spectra.h"
#include "tests/laws/light/flat_scenes.h"
#include "tests/support/polarised.h"

namespace vitrail::test::parallel_panes_test {
namespace {

constexpr float lowest = 0.0078125f;

// What a face, or several, reflect from either side and let through.
struct Faces {
  double from_below, from_above, up, down;
};
Faces upon(Faces above, Faces below, double between = 1) {
  const double a2 = between * between, all = 1 / (1 - above.from_below * a2 * below.from_above);
  return {below.from_below + below.up * below.down * a2 * above.from_below * all,
          above.from_above + above.up * above.down * a2 * below.from_above * all,
          below.up * between * above.up * all, above.down * between * below.down * all};
}
Faces interface_at(double cosine, double eta, Fresnel fresnel) {
  const double r = fresnel(cosine, eta);
  return {r, r, 1 - r, 1 - r};
}
Faces pane_at(double cosine, double eta, Fresnel fresnel, double inside = 1) {
  return upon(interface_at(cosine, eta, fresnel), interface_at(cosine, eta, fresnel), inside);
}
Faces many(Faces one, int count) {
  Faces all = one;
  for (int i = 1; i < count; ++i) all = upon(one, all);
  return all;
}

using Glazing = std::function<void(Scene&)>;

// A small white ground in the sun, under what is put over it.
Scene ground(double theta_deg, const Glazing& glazing) {
  Scene scene;
  add_shape(scene, square(scene, 0, 2e-4f), Material{DiffuseMaterial{ConstantSpectrum{0.1f}}});
  glazing(scene);
  OrthographicCamera camera;
  camera.camera_to_world = look_at({0, 0, 0.004}, {0, 0, 0}, {0, 1, 0});
  camera.screen = {-1e-4, 1e-4, -1e-4, 1e-4};
  scene.camera = camera;
  scene.film.width = scene.film.height = 16;
  scene.film.crop = {0, 16, 0, 16};
  scene.film.filter = BoxFilter{};
  scene.lights.push_back(Light{DistantLight{-direction(theta_deg, 20), ConstantSpectrum{1}}});
  scene.settings.max_depth = 200;
  return scene;
}

Brightness let_through(double theta_deg, const Glazing& glazing, int samples) {
  const auto seen = [&](const Glazing& g) { return brightness(render(ground(theta_deg, g), samples).film); };
  const Brightness behind = seen(glazing);
  const double open = seen([](Scene&) {}).mean;
  return {behind.mean / open, behind.standard_error / open};
}

void expect_let_through(double theta_deg, const Glazing& glazing, double expected, const std::string& what,
                        double slack = 1e-3, int samples = 128) {
  const auto [found, error] = let_through(theta_deg, glazing, samples);
  fmt::print("{} at {}°: {:.6f} of {:.6f}, {:+.3f} ± {:.3f} %\n", what, theta_deg, found, expected,
             100 * (found / expected - 1), 100 * error / expected);
  EXPECT_NEAR(found / expected, 1, slack + 2 * error / expected) << what << " at " << theta_deg;
}

void add_panes(Scene& scene, int count, const Material& material, float half_width = 400) {
  for (int i = 0; i < count; ++i) {
    const float low = lowest * static_cast<float>(2 * i + 1);
    add_shape(
        scene,
        add_quads(scene, box_faces({-half_width, -half_width, low}, {half_width, half_width, low + lowest})),
        material);
  }
}

double cosine_at(double theta_deg) { return direction(theta_deg, 20).z; }

// Of so many panes, whose glass lets `inside` through from face to face.
double through_panes(double cosine, int count, double inside = 1) {
  return over_polarisations([&](Fresnel f) { return many(pane_at(cosine, 1.5, f, inside), count).up; });
}

constexpr double angles[] = {0, 60, 75, 85};

TEST(ParallelPanes, OfGlass) {
  for (const double theta : angles)
    for (const int count : {1, 2, 4, 8})
      expect_let_through(
          theta, [&](Scene& scene) { add_panes(scene, count, Material{DielectricMaterial{}}); },
          through_panes(cosine_at(theta), count), fmt::format("{} panes", count));
}

// More faces than any glazing has.
TEST(ParallelPanes, HoweverManyThereAre) {
  for (const int count : {20, 40})
    expect_let_through(
        30, [&](Scene& scene) { add_panes(scene, count, Material{DielectricMaterial{}}); },
        through_panes(cosine_at(30), count), fmt::format("{} panes", count), 3e-3);
}

TEST(ParallelPanes, ThatAbsorb) {
  for (const double theta : angles)
    for (const int count : {1, 2, 4}) {
      const double sigma = 30, cosine = cosine_at(theta),
                   inside = std::sqrt(1 - (1 - cosine * cosine) / (1.5 * 1.5));
      const auto grey = [&](Scene& scene) {
        Medium medium;
        medium.coefficients =
            AbsorptionScattering{ConstantSpectrum{static_cast<float>(sigma)}, ConstantSpectrum{0}};
        scene.media.push_back(medium);
        const std::size_t before = scene.shapes.size();
        add_panes(scene, count, Material{DielectricMaterial{}});
        for (std::size_t i = before; i < scene.shapes.size(); ++i) scene.shapes[i].interior = Id<Medium>{0};
      };
      const double a = std::exp(-sigma * static_cast<double>(lowest) / inside);
      expect_let_through(theta, grey, through_panes(cosine, count, a), fmt::format("{} grey panes", count));
    }
}

// A tank: faces between two media, neither of which is the light's.
TEST(ParallelPanes, OfGlassAroundWater) {
  for (const float air : {1.0f, 1.000277f})
    for (const double theta : angles) {
      DielectricMaterial glass, water;
      glass.eta = ConstantSpectrum{1.5f}, glass.exterior_eta = ConstantSpectrum{air};
      water.eta = ConstantSpectrum{1.33f}, water.exterior_eta = ConstantSpectrum{1.5f};
      const double outer = 1.5 / static_cast<double>(air), inner = 1.33 / 1.5, cosine = cosine_at(theta),
                   inside = std::sqrt(1 - (1 - cosine * cosine) / (outer * outer));
      expect_let_through(
          theta,
          [&](Scene& scene) {
            const auto add = [&](float low, float high, const Material& m) {
              add_shape(scene, add_quads(scene, box_faces({-400, -400, low}, {400, 400, high})), m);
            };
            add(lowest, 4 * lowest, Material{glass});
            add(2 * lowest, 3 * lowest, Material{water});
          },
          over_polarisations([&](Fresnel f) {
            const Faces face = interface_at(cosine, outer, f);
            return upon(face, upon(pane_at(inside, inner, f), face)).up;
          }),
          fmt::format("a tank in air of {}", air));
    }
}

// Factors of what the faces reflect and let through are a part of every order.
TEST(ParallelPanes, WithFactors) {
  DielectricMaterial glass;
  glass.reflectance_factor = ConstantSpectrum{0.5f}, glass.transmittance_factor = ConstantSpectrum{0.8f};
  for (const double theta : angles) {
    const double expected = over_polarisations([&](Fresnel f) {
      const double r = f(cosine_at(theta), 1.5), t = 0.8 * (1 - r);
      return many(Faces{r / 2, r / 2, t, t}, 4).up;
    });
    expect_let_through(
        theta, [&](Scene& scene) { add_panes(scene, 2, Material{glass}); }, expected,
        "two panes with factors");
  }
}

Faces thin_at(double cosine, Fresnel fresnel) {
  const double face = fresnel(cosine, 1.5), r = 2 * face / (1 + face);
  return {r, r, 1 - r, 1 - r};
}

void add_sheets(Scene& scene, int count, const Material& material) {
  for (int i = 0; i < count; ++i)
    add_shape(scene, square(scene, lowest * static_cast<float>(i + 1), 400), material);
}

TEST(ParallelPanes, OfThinGlass) {
  for (const double theta : angles)
    for (const int count : {1, 2, 4, 8})
      expect_let_through(
          theta, [&](Scene& scene) { add_sheets(scene, count, Material{ThinDielectricMaterial{}}); },
          over_polarisations([&](Fresnel f) { return many(thin_at(cosine_at(theta), f), count).up; }),
          fmt::format("{} sheets", count));
}

TEST(ParallelPanes, OfThinAndSolidGlass) {
  for (const double theta : {0.0, 60.0, 85.0}) {
    const double cosine = cosine_at(theta);
    expect_let_through(
        theta,
        [&](Scene& scene) {
          add_panes(scene, 2, Material{DielectricMaterial{}});
          for (const float z : {2.5f, 6.0f})
            add_shape(scene, square(scene, lowest * z, 400), Material{ThinDielectricMaterial{}});
        },
        over_polarisations([&](Fresnel f) {
          const Faces sheet = thin_at(cosine, f), pane = pane_at(cosine, 1.5, f);
          return upon(sheet, upon(pane, upon(sheet, pane))).up;
        }),
        "two panes and two sheets");
  }
}

// Coated on one side: sheets that reflect and let through otherwise from behind.
Material coated(Scene& scene, const Faces& f) {
  const auto side = [&](double reflected, double transmitted) {
    MeasuredSheet table;
    table.wavelengths_nm = {550}, table.cosines = {1};
    table.reflectance = {static_cast<float>(reflected)},
    table.transmittance = {static_cast<float>(transmitted)};
    scene.materials.push_back(Material{MeasuredMaterial{"", table}});
    return Id<Material>{static_cast<std::uint32_t>(scene.materials.size() - 1)};
  };
  return Material{TwoSidedMaterial{side(f.from_above, f.down), side(f.from_below, f.up)}};
}

TEST(ParallelPanes, OfCoatedSheets) {
  const Faces coat{0.3, 0.1, 0.55, 0.6}, mirror{0.5, 0.7, 0.2, 0.25};
  for (const int count : {1, 2, 3})
    expect_let_through(
        50,
        [&](Scene& scene) {
          for (int i = 0; i < count; ++i) {
            const float z = lowest * static_cast<float>(2 * i + 1);
            add_shape(scene, square(scene, z, 400), coated(scene, coat));
            add_shape(scene, square(scene, z + lowest, 400), coated(scene, mirror));
          }
        },
        many(upon(mirror, coat), count).up, fmt::format("{} coated units", count));
}

// A mirror of which half is there.
TEST(ParallelPanes, OfHalfMirrors) {
  const auto half = [](Scene& scene) {
    ConductorMaterial silver;
    silver.metal = PerfectReflector{};
    silver.reflectance_factor = ConstantSpectrum{0.9f};
    for (const float z : {1.0f, 2.0f}) {
      scene.materials.push_back(Material{silver});
      const Id<Material> id{static_cast<std::uint32_t>(scene.materials.size() - 1)};
      add_shape(scene, square(scene, lowest * z, 400), Material{MaskMaterial{0.5f, id}});
    }
  };
  expect_let_through(40, half, many(Faces{0.45, 0.45, 0.5, 0.5}, 2).up, "two half mirrors");
}

// Paths that see a lamp through panes carry both polarisations.
TEST(ParallelPanes, ThatPathsSeeThrough) {
  for (const double theta : {45.0, 60.0, 75.0})
    for (const int count : {1, 2, 4}) {
      Scene scene;
      add_shape(scene, square(scene, -0.5f, 400), Material{DiffuseMaterial{ConstantSpectrum{0}}},
                AreaLight{ConstantSpectrum{1}});
      add_panes(scene, count, Material{DielectricMaterial{}});
      look_along(scene, direction(theta, 20), {}, 0.01);
      scene.settings.max_depth = 1000;
      expect_luminance(mean_of(render(scene, 256).film), through_panes(cosine_at(theta), count), 0.01,
                       fmt::format("{} panes at {}°", count, theta));
    }
}

// Sheets that end: of all that goes to and fro, the part that meets both.
TEST(ParallelPanes, ThatEnd) {
  const double theta = 60, slope = std::tan(theta * pi / 180);
  const auto seen = [&](const Glazing& sheets) {
    Scene scene = ground(theta, sheets);
    scene.lights[0] = Light{DistantLight{-direction(theta), ConstantSpectrum{1}}};
    return brightness(render(scene, 1024).film).mean;
  };
  const double open = seen([](Scene&) {});
  for (const int orders : {0, 1, 2}) {
    // Each time a connection comes back to the lower sheet, it does so further towards +x.
    const auto end = static_cast<float>(0.1 * slope + (orders + 0.5) * 0.2 * slope);
    const double found = seen([&](Scene& scene) {
      const Material thin{ThinDielectricMaterial{}};
      add_shape(scene, add_quads(scene, {{{{-1, -1, 0.1f}, {end, -1, 0.1f}, {end, 1, 0.1f}, {-1, 1, 0.1f}}}}),
                thin);
      add_shape(scene, square(scene, 0.2f, 40), thin);
    });
    const double expected = over_polarisations([&](Fresnel f) {
      const Faces sheet = thin_at(std::cos(theta * pi / 180), f);
      double all = 0;
      for (int i = 0; i <= orders; ++i) all += std::pow(sheet.from_above * sheet.from_below, i);
      return all * sheet.up * sheet.up;
    });
    fmt::print("{} times to and fro: {:.6f} of {:.6f}\n", orders, found / open, expected);
    EXPECT_NEAR(found / open / expected, 1, 1e-3) << orders;
  }
}

// Photons of what connections find are not kept, and all others are: what the ground reflects, and the panes
// give back to it.
TEST(ParallelPanes, BringOnePictureByPhotonsAndPaths) {
  for (const bool thin : {false, true})
    for (const double theta : {60.0}) {
      Scene scene;
      add_shape(scene, square(scene, 0, 2), Material{DiffuseMaterial{ConstantSpectrum{0.5f}}});
      for (const float z : {0.5f, 0.6f, 0.7f})
        if (thin)
          add_shape(scene, square(scene, z, 2), Material{ThinDielectricMaterial{}});
        else
          add_shape(scene, add_quads(scene, box_faces({-2, -2, z}, {2, 2, z + 0.02f})),
                    Material{DielectricMaterial{}});
      OrthographicCamera camera;
      camera.camera_to_world = look_at({0, 0, 0.4}, {0, 0, 0}, {0, 1, 0});
      camera.screen = {-.1, .1, -.1, .1};
      scene.camera = camera;
      scene.film.width = scene.film.height = 8;
      scene.film.crop = {0, 8, 0, 8};
      scene.film.filter = BoxFilter{};
      scene.lights.push_back(Light{DistantLight{-direction(theta, 20), ConstantSpectrum{1}}});
      scene.settings.max_depth = 40;
      RenderOptions photons;
      photons.picture.samples_per_pixel = 32;
      photons.picture.integrator = Integrator::photon, photons.picture.photons = {40000, 0.2, 0.9};
      const double mapped = brightness(render(scene, std::move(photons)).film).mean,
                   traced = brightness(render(scene, 256).film).mean;
      fmt::print("{} panes at {}°: photons {:.5f}, paths {:.5f}, {:+.2f} %\n", thin ? "thin" : "solid", theta,
                 mapped, traced, 100 * (mapped / traced - 1));
      EXPECT_NEAR(mapped / traced, 1, 0.02) << theta;
    }
}

TEST(ParallelPanes, AreOneFilmWhateverTheDomains) {
  Scene scene = ground(75, [](Scene& s) {
    add_panes(s, 3, Material{DielectricMaterial{}}, 0.1f);
    add_shape(s, square(s, lowest * 7.5f, 0.1f), Material{ThinDielectricMaterial{}});
  });
  const Rendered one = render(scene, 8, 1);
  EXPECT_GT(brightness(one.film).mean, 0);
  for (const std::uint32_t domains : {4u, 32u})
    EXPECT_EQ(one.film.hash(), render(scene, 8, domains).film.hash());
}

}  // namespace
}  // namespace vitrail::test::parallel_panes_test
