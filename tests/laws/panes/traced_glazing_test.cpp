// SPDX-License-Identifier: Apache-2.0
// A pane that rays meet lets through and reflects what `vitrail glazing` says, from either side, at any
// angle.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "glazing/system_file.h"
#include "importers/reading/glazing_material.h"
#include "tests/glazing/glazing_files.h"
#include "tests/laws/light/flat_scenes.h"
#include "tests/support/command.h"

namespace vitrail::test::traced_glazing_test {
namespace {

Material material_of(Scene& scene, const std::string& file) {
  const auto add = [&](Material m) {
    scene.materials.push_back(std::move(m));
    return Id<Material>{static_cast<std::uint32_t>(scene.materials.size() - 1)};
  };
  return Material{glazing_model(file, add).model};
}

// Equal light of all wavelengths from a lamp below, through the pane, to eyes above; or from all around.
Mean seen(const std::string& file, double theta_deg, bool from_all_around) {
  Scene scene;
  if (from_all_around) {
    scene.lights.resize(1);
    scene.lights[0].model = InfiniteLight{ConstantSpectrum{1}};
  } else {
    add_shape(scene, square(scene, -1), Material{DiffuseMaterial{ConstantSpectrum{0}}},
              AreaLight{ConstantSpectrum{1}});
  }
  add_shape(scene, square(scene, 0), material_of(scene, file));
  look_along(scene, direction(theta_deg, 20), {}, 0.01);
  scene.settings.max_depth = 10;
  return mean_of(render(scene, 256).film);
}

double expected(const std::string& file, double theta_deg, auto value) {
  const GlazingSystem system = read_system({file}).system;
  std::vector<std::array<double, 2>> samples;
  for (double nm = lambda_min_nm; nm <= lambda_max_nm; ++nm)
    samples.push_back({nm, value(system_values(system, nm, std::cos(theta_deg * std::numbers::pi / 180),
                                               Polarisation::apart))});
  return luminance(Spectrum{tabulate(samples, true)});
}

// Within 0.1 %, beside the noise of counting.
void expect_traced(const std::string& file, const std::string& what) {
  for (const double theta : {0.0, 15.0, 60.0}) {
    const std::string where = what + " at " + std::to_string(theta);
    expect_luminance(seen(file, theta, false), expected(file, theta, [](PaneValues v) { return v.t; }), 0.002,
                     where, 1e-3);
    expect_luminance(seen(file, theta, true), expected(file, theta, [](PaneValues v) { return v.t + v.rf; }),
                     0.002, where + ", reflected and let through", 1e-3);
  }
}

TEST(TracedGlazing, IsTheSystem) {
  const TemporaryDirectory directory;
  write_text(directory / "low-e.txt",
             "wavelength_nm T Rf Rb\n300 0.1 0.3 0.1\n450 0.7 0.1 0.25\n550 0.8 0.05 0.15\n650 0.6 0.2 "
             "0.35\n2500 0.1 0.8 0.9\n");
  write_text(directory / "clear.dat", optics_text);
  for (const char* flipped : {"false", "true"}) {
    const auto file =
        write_text(directory / "unit.json", std::string(R"({"layers": [{"pane": "low-e.txt", "flipped": )")
                                                .append(flipped)
                                                .append(R"(}, {"gap_mm": 12}, {"pane": "clear.dat"}]})"));
    expect_traced(file.string(), std::string("flipped: ").append(flipped));
  }
}

// Frits scatter in all directions alike, as much as at the normal.
TEST(TracedGlazing, ScattersWhatItsPanesDo) {
  const TemporaryDirectory directory;
  write_text(directory / "frit.txt", optics_frit);
  write_text(directory / "clear.dat", optics_text);
  for (const char* panes :
       {R"({"pane": "frit.txt"})", R"({"pane": "frit.txt"}, {"gap_mm": 12}, {"pane": "clear.dat"})",
        R"({"pane": "clear.dat"}, {"gap_mm": 12}, {"pane": "frit.txt", "flipped": true})"}) {
    const auto file =
        write_text(directory / "unit.json", fmt::format(R"({{"layers": [{}]}})", panes)).string();
    const GlazingSystem system = read_system({file}).system;
    const auto expected_of = [&](auto value) {
      std::vector<std::array<double, 2>> samples;
      for (double nm = lambda_min_nm; nm <= lambda_max_nm; ++nm)
        samples.push_back({nm, value(system_streams(system, nm, 1, Polarisation::apart))});
      return luminance(Spectrum{tabulate(samples, true)});
    };
    const auto seen_from_inside = [&](auto add_light, double theta_deg) {
      Scene scene;
      add_light(scene);
      add_shape(scene, square(scene, 0), material_of(scene, file));
      look_along(scene, -direction(theta_deg, 20), {}, 0.01);
      scene.settings.max_depth = 10;
      return mean_of(render(scene, 256).film);
    };
    const auto from_outside = seen_from_inside(
        [](Scene& scene) {
          constexpr float w = 1000;  // it shines down
          add_shape(scene, add_quads(scene, {{{{-w, -w, 1}, {-w, w, 1}, {w, w, 1}, {w, -w, 1}}}}),
                    Material{DiffuseMaterial{ConstantSpectrum{0}}}, AreaLight{ConstantSpectrum{1}});
        },
        0);
    expect_luminance(from_outside, expected_of([](const Streams& s) { return s.t(); }), 0.004, panes, 1e-3);
    // The sun comes at the normal: all that is seen from aside is scattered.
    const auto from_the_sun = seen_from_inside(
        [](Scene& scene) {
          scene.lights.push_back(Light{DistantLight{{0, 0, -1}, ConstantSpectrum{1}}});
        },
        50);
    expect_luminance(from_the_sun,
                     expected_of([](const Streams& s) { return s.scattered.t; }) / std::numbers::pi, 0.01,
                     panes, 1e-3);
    expect_luminance(seen(file, 0, true),
                     expected_of([](const Streams& s) { return s.t() + s.direct.rf + s.scattered.rf; }),
                     0.004, panes, 1e-3);
  }
}

TEST(TracedGlazing, EverySystemOfTheCorpus) {
  const auto products = corpus() / "glazing" / "products";
  if (!std::filesystem::exists(products))
    GTEST_SKIP() << "no corpus of glazing: set VITRAIL_CORPUS to its folder";
  const TemporaryDirectory directory;
  const auto unit = [&](const std::string& name, const std::string& panes) {
    return write_text(directory / name, "{\"layers\": [" + panes + "]}").string();
  };
  const auto pane = [&](const char* file) { return "{\"pane\": \"" + (products / file).string() + "\"}"; };
  for (const char* file : {"CLEAR_3.json", "nfrc_6046.json", "nfrc_20748.oag", "OpticsNanometers.txt"})
    expect_traced((products / file).string(), file);
  expect_traced(unit("a.json", pane("CLEAR_3.json") + "," + pane("CLEAR_3.json")), "two clear panes");
  expect_traced(unit("b.json", pane("nfrc_2191.json") + "," + pane("CLEAR_3.json")), "low-e and clear");
}

}  // namespace
}  // namespace vitrail::test::traced_glazing_test
