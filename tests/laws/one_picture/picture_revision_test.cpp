// SPDX-License-Identifier: Apache-2.0
// Films say by which revision of the pictures they were made, and those of different ones do not merge. So
// the revision has to rise with every change that shows in a picture: this test tells.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "scene/spectra/named_spectra.h"
#include "tests/support/render.h"

namespace vitrail::test::picture_revision_test {
namespace {

constexpr std::uint32_t known_revision = 21;
constexpr const char* known_pictures = "7264be6b7c0f472d";

std::array<Point3f, 4> tile(float x, float z) {
  return {{{x, 0, z}, {x + 1, 0, z}, {x + 1, 1, z + 0.2f}, {x, 1, z + 0.2f}}};
}

// A box of grids above the floor: a density, and colours of what scatters.
void add_cloud(Scene& scene) {
  Medium cloud;
  Grid density, colors;
  density.nx = 5, density.ny = 2, density.nz = 2;
  for (int i = 0; i < 20; ++i) density.values.push_back(static_cast<float>(i % 7) / 2);
  colors.nx = 2, colors.ny = colors.nz = 1, colors.channels = 3,
  colors.values = {1, 0.5f, 0.2f, 0.3f, 0.6f, 1};
  density.bounds = colors.bounds = {{-4, 1.2, -1}, {4, 2, 1}};
  cloud.coefficients = AbsorptionScattering{ConstantSpectrum{0.1f}, colors};
  cloud.density = density;
  add_shape(scene, add_quads(scene, box_faces({-4, 1.2f, -1}, {4, 2, 1})), Material{InterfaceMaterial{}});
  scene.media.push_back(cloud);
  scene.shapes.back().interior = Id<Medium>{1}, scene.shapes.back().exterior = Id<Medium>{0};
}

// One row of tiles, a material each, over a floor in mist, under lights of every kind that has no file.
// Numbers of the C library that depend on the machine have no part in it.
Scene everything() {
  Scene scene;
  DielectricMaterial frosted;
  frosted.roughness.alpha_u = 0.2f, frosted.roughness.alpha_v = 0.1f;
  ConductorMaterial metal;
  metal.roughness.alpha_u = metal.roughness.alpha_v = 0.3f;
  PrincipledMaterial principled;
  principled.clearcoat = 0.5f, principled.sheen = 0.3f, principled.spec_tint = 0.4f;
  const std::vector<MaterialModel> models{DiffuseMaterial{},
                                          DielectricMaterial{bk7()},
                                          frosted,
                                          ThinDielectricMaterial{},
                                          metal,
                                          PlasticMaterial{},
                                          CoatedDiffuseMaterial{},
                                          principled,
                                          PrincipledMaterial{.below = true},
                                          DiffuseTransmissionMaterial{},
                                          CoatedConductorMaterial{}};
  float x = -5;
  for (const MaterialModel& model : models)
    add_shape(scene, add_quads(scene, {tile(x++, 0)}), Material{model});
  add_shape(scene, add_quads(scene, {{{{-9, -0.1f, -9}, {-9, -0.1f, 9}, {9, -0.1f, 9}, {9, -0.1f, -9}}}}),
            Material{DiffuseMaterial{}});
  add_shape(scene, add_quads(scene, {{{{-2, 3, -2}, {2, 3, -2}, {2, 3, 0}, {-2, 3, 0}}}}),
            Material{DiffuseMaterial{}}, AreaLight{ConstantSpectrum{3}, true});
  scene.lights.push_back(Light{PointLight{{1, 2, -1}, ConstantSpectrum{2}}});
  scene.lights.push_back(Light{DistantLight{{0.6, -0.8, 0}, ConstantSpectrum{1}}});
  scene.lights.push_back(Light{InfiniteLight{ConstantSpectrum{0.3f}}});
  Medium mist;
  mist.coefficients = AbsorptionScattering{ConstantSpectrum{0.01f}, ConstantSpectrum{0.03f}};
  mist.g = 0.5f;
  scene.media.push_back(mist);
  scene.camera_medium = Id<Medium>{0};
  add_cloud(scene);
  PerspectiveCamera camera;
  camera.camera_to_world = look_at({0, 0.5, -6}, {0, 0.5, 0}, {0, 1, 0});
  camera.screen = {-0.9, 0.9, -0.15, 0.15};
  camera.lens = {0.01, 6};
  scene.camera = camera;
  scene.film.width = 60, scene.film.height = 10;
  scene.film.crop = {0, 60, 0, 10};
  scene.film.filter = MitchellFilter{};
  scene.settings.max_depth = 6;
  return scene;
}

TEST(PictureRevision, RisesWithEveryChangeOfAPicture) {
  const Rendered rendered = render(everything(), 8, 3, 1);
  EXPECT_EQ(rendered.stats.refused, Refused{});
  const std::string found = fmt::format("{:016x}", rendered.film.hash());
  EXPECT_TRUE(this_renderer().revision == known_revision && found == known_pictures)
      << "the pictures of revision " << known_revision << " had the hash " << known_pictures
      << "; these, of revision " << this_renderer().revision << ", have " << found
      << ". Where that is meant, raise picture_revision in film/renderer_version.cpp, and put both here.";
}

}  // namespace
}  // namespace vitrail::test::picture_revision_test
