// SPDX-License-Identifier: Apache-2.0
// Fog in NanoVDB's files, through pbrt's reader: what a ray keeps of white light, against the integral along
// it.
#include <gtest/gtest.h>
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include <nanovdb/util/IO.h>
#include <nanovdb/util/Primitives.h>
#include <nanovdb/util/SampleFromVoxels.h>
#pragma GCC diagnostic pop

#include <cmath>
#include <fstream>

#include "importers/pbrt/read/pbrt.h"
#include "tests/laws/light/flat_scenes.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::nanovdb_media_test {
namespace {

using Fog = nanovdb::GridHandle<>;

// A ball of fog of radius 1 about (0, 0, 0), which fades within the outer 6 of its 20 voxels.
Fog fog_ball() {
  return nanovdb::createFogVolumeSphere<float>(1.0f, {0, 0, 0}, 0.05, 6.0, {0, 0, 0}, "density");
}

// ∫ density along z at that place, by NanoVDB's own interpolation.
double depth_at(const Fog& fog, double x, double y) {
  const auto& grid = *fog.grid<float>();
  const auto density = nanovdb::createSampler<1>(grid.tree());
  constexpr int steps = 20000;
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double z = -1.5 + 3 * (i + 0.5) / steps;
    sum += density(grid.worldToIndex(nanovdb::Vec3d(x, y, z))) * 3 / steps;
  }
  return sum;
}

// What is left of a white sky behind the fog, straight along z at (x, y). `placed`: directives before the
// medium.
Mean left_of_the_sky(const std::filesystem::path& file, const std::string& placed, double x, double y,
                     double scale = 2) {
  const auto scene_file = file.parent_path() / "scene.pbrt";
  std::ofstream(scene_file) << "Film \"rgb\"\nWorldBegin\nLightSource \"infinite\" \"rgb L\" [1 1 1]\n"
                               "AttributeBegin\n"
                            << placed
                            << "\nMakeNamedMedium \"m\" \"string type\" \"nanovdb\" \"string filename\" \""
                            << file.filename().string()
                            << "\" \"rgb sigma_a\" [1 1 1] \"rgb sigma_s\" [0 0 0] \"float scale\" " << scale
                            << "\n"
                               "AttributeEnd\nMediumInterface \"m\" \"\" Material \"interface\"\n"
                               "Shape \"sphere\" \"float radius\" 9\n";
  Scene scene = read_pbrt(scene_file).scene;
  look_along(scene, {0, 0, 1}, {x, y, 0}, 1e-4);
  return mean_of(render(scene, 2048).film);
}

TEST(NanoVdbMedia, FogBallIsAsThickAsItsVoxels) {
  const TemporaryDirectory folder;
  const auto file = folder / "fog.nvdb";
  const Fog fog = fog_ball();
  nanovdb::io::writeGrid(file.string(), fog);
  // By hand at the middle: 1.4 of full density and 2 · .3 of a ramp, whose mean is half.
  EXPECT_NEAR(depth_at(fog, 0, 0), 1.7, 0.03);
  const double white = left_of_the_sky(file, "", 5, 5).value.y;
  for (const double x : {0.0, 0.513, 0.87, 0.98})
    expect_luminance(left_of_the_sky(file, "", x, 0.1), white * std::exp(-2 * depth_at(fog, x, 0.1)), 0.01,
                     "beside the middle", 4e-3);
  // Coefficients are per length of the world: the same voxels, three times as thick.
  expect_luminance(left_of_the_sky(file, "Translate 1 2 3 Scale 3 3 3", 1.6, 2.2, 0.5),
                   white * std::exp(-0.5 * 3 * depth_at(fog, 0.2, 0.2 / 3)), 0.01, "placed and stretched",
                   2e-3);
}

}  // namespace
}  // namespace vitrail::test::nanovdb_media_test
