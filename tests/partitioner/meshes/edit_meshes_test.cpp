// SPDX-License-Identifier: Apache-2.0
#include "partitioner/meshes/edit_meshes.h"

#include <gmock/gmock.h>

#include <set>

#include "importers/import.h"
#include "importers/shapes/shapes.h"
#include "scene/shapes/deferred_mesh.h"
#include "tests/partitioner/meshes/shapes.h"
#include "tests/support/command.h"

namespace vitrail::edit_meshes_test {
namespace {

using ::testing::HasSubstr;

const Subdivision loop = [](const TriangleMesh& cage, int levels,
                            std::vector<std::array<Point2d, 3>>& corners) {
  return loop_subdivide(cage, levels, &corners);
};

Scene scene_of(std::vector<TriangleMesh> meshes) {
  Scene scene;
  scene.materials.emplace_back();
  for (std::uint32_t i = 0; i < meshes.size(); ++i) {
    Shape& shape = scene.shapes.emplace_back();
    shape.mesh = {i};
  }
  scene.meshes = std::move(meshes);
  return scene;
}

TEST(Subdivide, SeamsStayClosedAndKeepTheirUvs) {
  const TriangleMesh cage = test::torus(12, 8, 1, 0.3, true);
  const SubdividedMesh fine = subdivide(cage, 2, loop);
  EXPECT_TRUE(fine.manifold);
  EXPECT_EQ(fine.mesh.triangles.size(), 16 * cage.triangles.size());
  EXPECT_EQ(fine.mesh.positions.size(), (4u * 12 + 1) * (4 * 8 + 1));  // two seams, as in the cage
  const auto edges = test::edges_by_triangles(fine.mesh);
  EXPECT_EQ(edges[1] + edges[3], 0u);
  double uv_area = 0;
  for (std::size_t i = 0; i < fine.mesh.triangles.size(); ++i) {
    const auto uv = [&](std::size_t k) { return fine.mesh.uvs[fine.mesh.triangles[i][k]]; };
    const double area =
        ((uv(1).x - uv(0).x) * (uv(2).y - uv(0).y) - (uv(1).y - uv(0).y) * (uv(2).x - uv(0).x)) / 2;
    EXPECT_NEAR(area, 1. / (2 * 12 * 8 * 16), 1e-7);
    uv_area += area;
  }
  EXPECT_NEAR(uv_area, 1, 1e-5);
}

// A uv is where the position is: both are linear on a flat sheet.
TEST(Subdivide, ParametersBelongToTheirCorners) {
  TriangleMesh sheet = test::grid(3, [](double, double) { return 0.; });
  for (const Point3f p : sheet.positions) sheet.uvs.push_back({p.x, p.y});
  const SubdividedMesh fine = subdivide(sheet, 3, loop);
  for (std::size_t v = 0; v < fine.mesh.positions.size(); ++v) {
    const Point3f p = fine.mesh.positions[v];
    if (std::min({p.x, p.y, 1 - p.x, 1 - p.y}) < 0.4f) continue;  // borders round the corners
    EXPECT_NEAR(p.x, fine.mesh.uvs[v].x, 1e-5);
    EXPECT_NEAR(p.y, fine.mesh.uvs[v].y, 1e-5);
  }
}

TEST(Subdivide, FaceAttributesAreTheParents) {
  TriangleMesh cage = test::sphere(0);
  cage.attributes = {{"face_number", true, 1, {0, 1, 2, 3, 4, 5, 6, 7}}};
  const TriangleMesh fine = subdivide(cage, 2, loop).mesh;
  for (std::size_t i = 0; i < fine.triangles.size(); ++i)
    EXPECT_EQ(fine.attributes[0].values[i], static_cast<float>(i / 16));
}

TEST(EditMeshes, NothingAskedNothingDone) {
  Scene scene = scene_of({test::as_soup(test::sphere(2))});
  const TriangleMesh before = scene.meshes[0];
  const EditedMeshes edited = edit_meshes(scene, {});
  EXPECT_EQ(scene.meshes[0], before);
  EXPECT_TRUE(edited.notes.empty());
}

TEST(EditMeshes, InOrderAndWithNotes) {
  TriangleMesh soup = test::as_soup(test::sphere(4));
  soup.triangles.push_back({0, 0, 1});
  soup.triangles.push_back(soup.triangles[5]);
  test::turn_at_random(soup, 1);
  Scene scene = scene_of({soup, test::sphere(4)});
  scene.meshes.push_back(test::as_soup(test::sphere(1)));  // that no shape uses
  scene.files = {"a.pbrt"};
  scene.shapes[0].origin = {0, 4, 1};
  const EditedMeshes edited = edit_meshes(scene, {true, true, 0, 0.5, {}});
  EXPECT_EQ(edited.triangles_before, 2048u + 2 + 2048);
  EXPECT_NEAR(static_cast<double>(edited.triangles_after), 1024 + 1024, 4);
  EXPECT_GT(test::volume6(scene.meshes[0]), 24);
  EXPECT_EQ(scene.meshes[2].positions.size(), 96u);
  ASSERT_EQ(edited.notes.size(), 4u);
  EXPECT_THAT(edited.notes[0].message,
              HasSubstr("1 triangles of zero area removed, 1 duplicate triangles removed"));
  EXPECT_THAT(edited.notes[1].message, HasSubstr("mesh oriented"));
  EXPECT_THAT(edited.notes[2].message, HasSubstr("mesh decimated: 1024 of 2048"));
  EXPECT_EQ(to_string(edited.notes[0].location), "a.pbrt:4:1");
}

TEST(EditMeshes, FrontsOfTheWorldAreOutside) {
  Scene scene = scene_of({test::sphere(2), test::sphere(2), test::sphere(2), test::turned(test::sphere(2))});
  scene.shapes[1].flip_orientation = true;
  scene.shapes[2].object_to_world = scale({1, -1, 1});
  scene.area_lights.emplace_back();
  scene.shapes[3].area_light = Id<AreaLight>{0};
  edit_meshes(scene, {false, true, 0, 1, {}});
  EXPECT_GT(test::volume6(scene.meshes[0]), 0);
  EXPECT_LT(test::volume6(scene.meshes[1]), 0);
  EXPECT_LT(test::volume6(scene.meshes[2]), 0);
  EXPECT_LT(test::volume6(scene.meshes[3]), 0);  // it shines inwards, as before
  EXPECT_EQ(scene.shapes[3].area_light, (Id<AreaLight>{0}));
}

TEST(EditMeshes, MeshesInTheirFilesAreEditedWhenLoaded) {
  const auto load = [] { return test::sphere(5); };
  Scene scene = scene_of({MeshMemory(0).keep(load(), load), MeshMemory(0).keep(load(), load)});
  Scene in_memory = scene_of({load(), load()});
  const MeshEdits edits{false, false, 0, 0.25, {}};
  EXPECT_EQ(edit_meshes(in_memory, edits).triangles_after, 4096u);
  EXPECT_THROW(edit_meshes(scene, edits, {0, 1 << 20, 0}), MachineError);  // the work on one takes more
  constexpr std::uint64_t one = 2048 * 12 + 1026 * 12, enough = 1u << 30;  // one of them is decimated to this
  for (const std::uint64_t kept : {std::uint64_t{0}, one, 2 * one}) {
    Scene some = scene;
    EXPECT_EQ(edit_meshes(some, edits, {kept, enough, 0}).triangles_after, 4096u);
    std::uint64_t in_files = 0;
    TriangleMesh storage;
    for (const TriangleMesh& mesh : some.meshes) {
      in_files += mesh.deferred != nullptr;
      EXPECT_EQ(loaded(mesh, storage), in_memory.meshes[0]);
    }
    EXPECT_EQ(in_files, 2 - kept / one);
  }
}

TEST(EditMeshes, TheSameWithAnyNumberOfThreads) {
  std::vector<TriangleMesh> meshes;
  for (int i = 0; i < 12; ++i) meshes.push_back(test::torus(30 + i, 20));
  Scene all = scene_of(meshes);
  edit_meshes(all, {true, true, 1, 0.3, loop});
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    Scene one = scene_of({meshes[i]});
    edit_meshes(one, {true, true, 1, 0.3, loop});
    EXPECT_EQ(all.meshes[i], one.meshes[0]);
  }
}

class CorpusMeshes : public ::testing::TestWithParam<const char*> {};

TEST_P(CorpusMeshes, AreRepairedOrientedAndDecimated) {
  const std::filesystem::path file = test::corpus() / GetParam();
  if (test::corpus().empty() || !std::filesystem::exists(file)) GTEST_SKIP() << "no corpus";
  const Scene original = import_scene(file).scene;
  Scene scene = original;
  edit_meshes(scene, {true, true, 0, 0.25, {}});
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    if (original.meshes[i].triangles.empty()) continue;
    const Bounds3f bounds = bounds_of(original.meshes[i]);
    const double diagonal = length(cast<double>(extent(bounds)));
    EXPECT_LT(test::greatest_distance(original.meshes[i], scene.meshes[i]), 0.03 * diagonal);
    EXPECT_LT(test::greatest_distance(scene.meshes[i], original.meshes[i]), 0.03 * diagonal);
    EXPECT_LT(scene.meshes[i].triangles.size(), original.meshes[i].triangles.size());
    RecordProperty("triangles", static_cast<int>(scene.meshes[i].triangles.size()));
  }
}

INSTANTIATE_TEST_SUITE_P(Files, CorpusMeshes,
                         ::testing::Values("mitsuba-data/common/meshes/bunny.ply",
                                           "mitsuba-data/common/meshes/teapot.ply",
                                           "mitsuba-data/tests/scenes/participating_media/meshes/torus1.obj",
                                           "pbrt/sphere-env/geometry/sphere.ply"));

}  // namespace
}  // namespace vitrail::edit_meshes_test
