// SPDX-License-Identifier: Apache-2.0
// Alpha beside colours: a picture without its surroundings is the whole one less what they bring through
// 1 − A of each pixel, whatever leaves them to be seen: holes of every kind, sheets, media.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/laws/light/flat_scenes.h"
#include "tests/laws/light/media_scenes.h"
#include "tests/support/long_tests.h"

namespace vitrail::test::means_of_alpha_test {
namespace {

const Material grey{DiffuseMaterial{ConstantSpectrum{0.5f}}};

Id<Material> kept(Scene& scene, const Material& material) {
  scene.materials.push_back(material);
  return {static_cast<std::uint32_t>(scene.materials.size() - 1)};
}

struct Plate {
  const char* name;
  double alpha;  // NaN: by the law alone
  std::function<void(Scene&)> add;
};

void add_sheet(Scene& scene, const Material& material) {
  const Id<TriangleMesh> mesh = square(scene, 0, 8);
  scene.meshes[mesh.value].uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  add_shape(scene, mesh, material);
}

// Reflected by one face of glass at normal incidence, and by a sheet of it with all that goes to and fro.
constexpr double face = 0.04, sheet = 2 * face / (1 + face);

std::vector<Plate> plates() {
  const double nan = std::nan("");
  return {
      {"an opacity of the shape", 0.4, [](Scene& s) { add_sheet(s, grey), s.shapes.back().opacity = 0.4f; }},
      {"a mask", 0.4,
       [](Scene& s) {
         add_sheet(s, Material{MaskMaterial{0.4f, kept(s, grey)}});
       }},
      {"a mask by a texture", 0.5,
       [](Scene& s) {
         CheckerboardTexture cells{Spectrum{ConstantSpectrum{1}}, Spectrum{ConstantSpectrum{0}}};
         cells.mapping = UvMapping{2000, 2000, 0, 0, 0, 0};
         s.textures.push_back({cells, true, "", {}});
         add_sheet(s, Material{MaskMaterial{Id<Texture>{0}, kept(s, grey)}});
       }},
      {"a blend with nothing", 0.6,
       [](Scene& s) {
         const Id<Material> nothing = kept(s, Material{InterfaceMaterial{}}), something = kept(s, grey);
         add_sheet(s, Material{BlendMaterial{something, nothing, 0.4f}});
       }},
      {"a mask in a blend in a mask", 0.8 * 0.5 * 0.7,
       [](Scene& s) {
         const Id<Material> inner = kept(s, Material{MaskMaterial{0.7f, kept(s, grey)}});
         const Id<Material> nothing = kept(s, Material{InterfaceMaterial{}});
         add_sheet(s, Material{MaskMaterial{0.8f, kept(s, Material{BlendMaterial{inner, nothing, 0.5f}})}});
       }},
      {"two masks", 1 - 0.6 * 0.3,
       [](Scene& s) {
         add_sheet(s, Material{MaskMaterial{0.4f, kept(s, grey)}});
         add_shape(s, square(s, -1, 8), Material{MaskMaterial{0.7f, kept(s, grey)}});
       }},
      {"a sheet of glass", sheet, [](Scene& s) { add_sheet(s, Material{ThinDielectricMaterial{}}); }},
      {"a sheet that absorbs", 1 - 0.5 * (1 - sheet),
       [](Scene& s) {
         ThinDielectricMaterial tinted;
         tinted.transmittance_factor = ConstantSpectrum{0.5f};
         add_sheet(s, Material{tinted});
       }},
      {"a mask before a sheet of glass", 1 - 0.6 * (1 - sheet),
       [](Scene& s) {
         add_sheet(s, Material{MaskMaterial{0.4f, kept(s, grey)}});
         add_shape(s, square(s, -1, 8), Material{ThinDielectricMaterial{}});
       }},
      {"air that absorbs", 1 - std::exp(-0.5 * 2),
       [](Scene& s) {
         fill(s, {"", {0, 0, 0}, 1, false, 0.5}, false, Material{InterfaceMaterial{}});
       }},
      {"fog", nan,
       [](Scene& s) {
         fill(s, {"", {0, 0, 0}, 1, false, 0.5}, false, Material{InterfaceMaterial{}});
         s.media.back().coefficients = AbsorptionScattering{ConstantSpectrum{0.1f}, ConstantSpectrum{0.4f}};
       }},
      {"a pane of glass", 1,
       [](Scene& s) {
         add_shape(s, add_quads(s, box_faces({-8, -8, -0.1f}, {8, 8, 0})), Material{DielectricMaterial{}});
       }},
      {"frosted glass", 1,
       [](Scene& s) {
         DielectricMaterial frosted;
         frosted.roughness.alpha_u = frosted.roughness.alpha_v = 0.2f;
         add_sheet(s, Material{frosted});
       }},
      {"a grey wall", 1, [](Scene& s) { add_sheet(s, grey); }},
      {"nothing", 0, [](Scene&) {}},
  };
}

struct Seen {
  Mean picture;
  double alpha = 0, alpha_error = 0;
};

Seen seen(Scene scene, Integrator integrator, bool hides) {
  scene.settings.hides_emitters = hides;
  scene.film.layers.add(Layer::alpha);
  RenderOptions options;
  options.picture.samples_per_pixel = of_all(64, 32);
  options.picture.integrator = integrator;
  if (integrator == Integrator::photon) options.picture.photons = {2000, 0.1, 0.9};
  const Film film = render(scene, std::move(options)).film;
  Seen result{mean_of(film)};
  const auto pixels = static_cast<std::uint32_t>(film.width() * film.height());
  double squares = 0;
  for (std::uint32_t i = 0; i < pixels; ++i) {
    const double a = film.mean_of_layer(i, Layer::alpha, 0);
    result.alpha += a / pixels, squares += a * a / pixels;
  }
  result.alpha_error = std::sqrt(std::max(0.0, squares - result.alpha * result.alpha) / (pixels - 1));
  return result;
}

TEST(MeansOfAlpha, OfWhatLeavesTheSurroundingsToBeSeen) {
  for (const Plate& plate : plates())
    for (const Integrator integrator : {Integrator::path, Integrator::direct, Integrator::photon}) {
      Scene scene;
      scene.lights.push_back({InfiniteLight{ConstantSpectrum{1}}, {}});
      scene.settings.max_depth = 12;
      plate.add(scene);
      if (integrator == Integrator::photon && !scene.media.empty()) continue;
      look_along(scene, {0, 0, 1}, {}, 0.3);
      const Seen whole = seen(scene, integrator, false), hidden = seen(scene, integrator, true);
      const std::string what = fmt::format("{}, integrator {}", plate.name, static_cast<int>(integrator));
      fmt::print("{}: A {:.4f}, {:.4f} of {:.4f}\n", what, hidden.alpha, hidden.picture.value.y,
                 whole.picture.value.y);
      EXPECT_EQ(whole.alpha, hidden.alpha) << what;
      if (!std::isnan(plate.alpha)) {
        EXPECT_NEAR(hidden.alpha, plate.alpha, 4.5 * hidden.alpha_error + 2e-5) << what;
      }
      // Of light of equal energy, whose luminance is known by few wavelengths.
      EXPECT_NEAR(whole.picture.value.y - hidden.picture.value.y, 1 - hidden.alpha,
                  4.5 * whole.picture.error.y + 0.01)
          << what;
    }
}

// The same hole, told in other ways, is one picture.
TEST(MeansOfAlpha, HidesLampsBehindHoles) {
  for (const Plate& plate : plates()) {
    if (plate.alpha == 1) continue;
    Scene scene;
    plate.add(scene);
    add_shape(scene, square(scene, -2, 8), Material{DiffuseMaterial{ConstantSpectrum{0}}},
              AreaLight{ConstantSpectrum{4}});
    scene.settings.max_depth = 12;
    look_along(scene, {0, 0, 1}, {}, 0.3);
    const Seen whole = seen(scene, Integrator::path, false), hidden = seen(scene, Integrator::path, true);
    fmt::print("{}: A {:.4f}, {:.4f} of {:.4f}\n", plate.name, hidden.alpha, hidden.picture.value.y,
               whole.picture.value.y);
    EXPECT_EQ(whole.alpha, 1) << plate.name << ": a lamp that is seen covers";
    EXPECT_NEAR(whole.picture.value.y - hidden.picture.value.y, 4 * (1 - hidden.alpha),
                4.5 * whole.picture.error.y + 0.04)
        << plate.name;
  }
}

}  // namespace
}  // namespace vitrail::test::means_of_alpha_test
