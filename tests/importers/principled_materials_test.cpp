// SPDX-License-Identifier: Apache-2.0
// Principled materials as pbrt shows what is written of them: of as much light, under a sky of 1.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "importers/pbrt/read/pbrt.h"
#include "importers/pbrt/write/write_pbrt.h"
#include "tests/importers/temporary_folder.h"
#include "tests/support/render.h"

namespace vitrail::principled_materials_test {
namespace {

// A square in the plane z = 0, of the colours of a wall, seen at an angle.
Scene scene_of(const PrincipledMaterial& model, double angle_rad) {
  Scene scene;
  test::set_camera(scene, {20 * std::sin(angle_rad), 0, 20 * std::cos(angle_rad)}, {}, {0, 1, 0}, 0.01, 8, 8);
  const Id<TriangleMesh> mesh = test::add_quads(scene, {{{{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}}}});
  test::add_shape(scene, mesh, Material{model});
  scene.lights.push_back({InfiniteLight{ConstantSpectrum{1}}});
  return scene;
}

double albedo(const Scene& scene) { return test::brightness(test::render(scene, 128).film).mean; }

double written_over_own(const PrincipledMaterial& model, double angle_rad) {
  const TemporaryFolder folder;
  const Scene own = scene_of(model, angle_rad);
  write_pbrt(own, folder / "out.pbrt");
  Scene again = read_pbrt(folder / "out.pbrt").scene;
  return albedo(again) / albedo(own);
}

void expect_as_bright(float color, float roughness, float metallic, bool below = false) {
  const PrincipledMaterial model{
      .base_color = ConstantSpectrum{color}, .roughness = roughness, .metallic = metallic, .below = below};
  for (const double angle : {0.0, 1.0})
    EXPECT_NEAR(written_over_own(model, angle), 1, 0.05) << fmt::format(
        "colour {}, roughness {}, metallic {}, below {}, {} rad", color, roughness, metallic, below, angle);
}

TEST(PrincipledMaterials, KeepTheirLightInPbrt) {
  for (const float color : {0.2f, 0.5f, 0.8f})
    for (const float roughness : {0.5f, 1.0f}) expect_as_bright(color, roughness, 0);
  expect_as_bright(0.5f, 0.3f, 0);
  for (const float roughness : {0.5f, 1.0f}) expect_as_bright(0.5f, roughness, 0, true);
}

// Of colours that metals have: pbrt's metal of .2 is 15 % brighter at 1 rad.
TEST(PrincipledMaterials, KeepTheirLightInPbrtWherePartlyMetal) {
  expect_as_bright(0.5f, 0.5f, 0.5f);
  expect_as_bright(0.8f, 0.3f, 0.25f);
}

}  // namespace
}  // namespace vitrail::principled_materials_test
