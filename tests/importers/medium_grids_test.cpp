// SPDX-License-Identifier: Apache-2.0
// Grids of media as another format has them.
#include "importers/writing/medium_grids.h"

#include <gmock/gmock.h>
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include <nanovdb/util/IO.h>
#include <nanovdb/util/Primitives.h>
#pragma GCC diagnostic pop

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>

#include "importers/mitsuba/read/mitsuba.h"
#include "importers/mitsuba/write/write_mitsuba.h"
#include "importers/pbrt/read/pbrt.h"
#include "importers/pbrt/write/write_pbrt.h"
#include "scene/geometry/pi.h"
#include "scene/system/diagnostics.h"
#include "tests/importers/temporary_folder.h"
#include "tests/importers/written_scenes.h"

namespace vitrail::medium_grids_test {
namespace {

Grid grid(int nx, int channels, std::vector<float> values, GridEdge edge) {
  Grid g;
  g.nx = nx, g.ny = g.nz = 1, g.channels = channels, g.edge = edge;
  g.values = std::move(values);
  return g;
}

Scene with_medium(Medium medium) {
  Scene scene = square_scene(Material{InterfaceMaterial{}});
  medium.name = "m";
  scene.media.push_back(std::move(medium));
  scene.shapes[0].interior = Id<Medium>{0};
  return scene;
}

const auto product = [](double a, double b) { return a * b; };

TEST(MediumGrids, TheFinerOnesCells) {
  const Grid a = grid(2, 1, {1, 3}, GridEdge::held),
             b = grid(4, 3, std::vector<float>(12, 2), GridEdge::held);
  const Grid both = combined_cells(a, b, product);
  EXPECT_EQ(both.nx, 4);
  EXPECT_EQ(both.values, (std::vector<float>{2, 2, 2, 3, 3, 3, 5, 5, 5, 6, 6, 6})) << "linear in between";
  EXPECT_EQ(combined_cells(Spectrum{ConstantSpectrum{2}}, a, product).values, (std::vector<float>{2, 6}));
  Grid lost = a;
  lost.values.clear();
  EXPECT_THROW(combined_cells(lost, b, product), Error);
}

TEST(MediumGrids, OneMoreLayerOfCells) {
  const Grid g = grid(2, 1, {1, 3}, GridEdge::held), held = with_cells_around(g, false),
             zero = with_cells_around(g, true);
  EXPECT_EQ(held.bounds, (Bounds3d{{-0.5, -1, -1}, {1.5, 2, 2}}));
  ASSERT_EQ(held.values.size(), 36u);
  EXPECT_THAT(std::vector<float>(held.values.begin() + 16, held.values.begin() + 20),
              testing::ElementsAre(1, 1, 3, 3));
  EXPECT_THAT(std::vector<float>(zero.values.begin() + 16, zero.values.begin() + 20),
              testing::ElementsAre(0, 1, 3, 0));
}

// Mitsuba's grids of extinction and albedo, one of them in a file, are pbrt's rgbgrid.
TEST(MediumGrids, ExtinctionAndAlbedoForPbrt) {
  const TemporaryFolder folder;
  Grid in_file = grid(2, 1, {4, 8}, GridEdge::held);
  std::string bytes(48, '\0');
  bytes.append(reinterpret_cast<const char*>(in_file.values.data()), 8);
  in_file.filename = folder.write("t.vol", bytes).string();
  in_file.values.clear();
  Medium medium;
  medium.coefficients = ExtinctionAlbedo{in_file, grid(2, 3, {1, .5, .25, .5, .5, 0}, GridEdge::held)};
  write_pbrt(with_medium(medium), folder / "out.pbrt");
  const Scene again = read_pbrt(folder / "out.pbrt").scene;
  const auto& both = std::get<AbsorptionScattering>(again.media.at(0).coefficients);
  const auto cells = [](const VolumeParameter& value) {
    const auto& v = std::get<Grid>(value).values;  // 4 × 3 × 3 cells, of which two are its own
    return std::vector<float>(v.begin() + 17 * 3, v.begin() + 19 * 3);
  };
  EXPECT_THAT(cells(both.sigma_s), testing::ElementsAre(4, 2, 1, 4, 4, 0));
  EXPECT_THAT(cells(both.sigma_a), testing::ElementsAre(0, 2, 3, 4, 4, 8));
}

TEST(MediumGrids, AbsorptionAndScatteringForMitsuba) {
  const TemporaryFolder folder;
  Medium medium;
  medium.coefficients = AbsorptionScattering{grid(2, 3, {1, 2, 3, 0, 0, 2}, GridEdge::zero),
                                             grid(2, 3, {3, 2, 1, 1, 0, 6}, GridEdge::zero)};
  const Diagnostics notes = write_mitsuba(with_medium(medium), folder / "out.xml");
  for (const Diagnostic& note : notes) EXPECT_THAT(note.message, testing::Not(testing::HasSubstr("mean")));
  const Scene again = read_mitsuba(folder / "out.xml").scene;
  const auto& e = std::get<ExtinctionAlbedo>(again.media.at(0).coefficients);
  const Grid sigma_t = with_values(std::get<Grid>(e.sigma_t)), albedo = with_values(std::get<Grid>(e.albedo));
  EXPECT_EQ(sigma_t.nx, 4) << "zeros around it";
  EXPECT_THAT(std::vector<float>(sigma_t.values.begin() + 17 * 3, sigma_t.values.begin() + 19 * 3),
              testing::ElementsAre(4, 4, 4, 1, 0, 8));
  EXPECT_THAT(albedo.values, testing::ElementsAre(.75f, .5f, .25f, 1, 0, .75f));
}

// A density times a coloured extinction keeps its colour.
TEST(MediumGrids, ColouredDensityForMitsuba) {
  const TemporaryFolder folder;
  Medium medium;
  medium.density = grid(2, 1, {1, 2}, GridEdge::held);
  medium.coefficients =
      ExtinctionAlbedo{reflectance_from_rgb({0.5, 0.25, 1}), Spectrum{ConstantSpectrum{0.5f}}};
  write_mitsuba(with_medium(medium), folder / "out.xml");
  const Scene again = read_mitsuba(folder / "out.xml").scene;
  const auto& e = std::get<ExtinctionAlbedo>(again.media.at(0).coefficients);
  const Grid sigma_t = with_values(std::get<Grid>(e.sigma_t));
  ASSERT_EQ(sigma_t.channels, 3);
  const std::vector<float> expected{0.5f, 0.25f, 1, 1, 0.5f, 2};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(sigma_t.values.at(i), expected[i], 1e-4) << i;
}

// Voxels of 0.5 around (1, 0, 0), which is turned by 30° about z.
void expect_fog_in_place(const Grid& grid, const Transform& to_world) {
  const Vector3d size = grid.bounds.upper - grid.bounds.lower;
  EXPECT_NEAR(length(transform_vector(to_world, {size.x / grid.nx, 0, 0})), 0.5, 1e-5);
  const Point3d middle = transform_point(to_world, grid.bounds.lower + 0.5 * size);
  EXPECT_NEAR(middle.x, std::cos(pi / 6), 1e-5);
  EXPECT_NEAR(middle.y, std::sin(pi / 6), 1e-5);
}

// A turned fog: pbrt gets the file and the place that it had, Mitsuba the same values.
TEST(MediumGrids, NanoVdbForBoth) {
  const TemporaryFolder folder;
  const auto file = folder.write("fog.nvdb", "");
  nanovdb::io::writeGrid(
      file.string(), nanovdb::createFogVolumeSphere<float>(3.0f, {1, 0, 0}, 0.5, 3.0, {0, 0, 0}, "density"));
  const Scene scene =
      read_pbrt(
          folder.write("in.pbrt",
                       "Film \"rgb\" WorldBegin Rotate 30 0 0 1 MakeNamedMedium \"m\" \"string type\" "
                       "\"nanovdb\" \"string filename\" \"fog.nvdb\" MediumInterface \"m\" \"\" Material "
                       "\"interface\" Shape \"sphere\" \"float radius\" 9"))
          .scene;
  const Grid fog = with_values(std::get<Grid>(scene.media.at(0).density));
  ASSERT_GT(std::ranges::count(fog.values, 1.0f), 100);
  write_pbrt(scene, folder / "out.pbrt");
  const Medium pbrt = read_pbrt(folder / "out.pbrt").scene.media.at(0);
  EXPECT_EQ(with_values(std::get<Grid>(pbrt.density)), fog);
  write_mitsuba(scene, folder / "out.xml");
  const Medium mitsuba = read_mitsuba(folder / "out.xml").scene.media.at(0);
  const Grid written = with_values(std::get<Grid>(std::get<ExtinctionAlbedo>(mitsuba.coefficients).sigma_t));
  const auto sum = [](const Grid& grid) { return std::reduce(grid.values.begin(), grid.values.end(), 0.0); };
  EXPECT_EQ(written.nx, fog.nx + 2) << "zeros around it";
  EXPECT_NEAR(static_cast<double>(mitsuba.scale) * sum(written), 2 * sum(fog), 1e-4 * sum(fog))
      << "σa + σs = 2";
  expect_fog_in_place(fog, pbrt.medium_to_world);
  expect_fog_in_place(written, mitsuba.medium_to_world);
}

}  // namespace
}  // namespace vitrail::medium_grids_test
