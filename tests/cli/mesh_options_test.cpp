// SPDX-License-Identifier: Apache-2.0
// --tessellate, --repair, --orient, --subdivide and --decimate as a user types them.
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>

#include "film/film_progress.h"
#include "importers/export.h"
#include "importers/import.h"
#include "tests/support/command.h"
#include "tests/support/render.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/test_scenes.h"

namespace vitrail::mesh_options_test {
namespace {

using ::testing::HasSubstr;

class MeshOptions : public ::testing::Test {
 protected:
  MeshOptions() {  // 3200 triangles, and two that are too many
    TriangleMesh torus = test::bumpy_torus(40);
    torus.triangles.push_back(torus.triangles[7]);
    torus.triangles.push_back({5, 5, 6});
    Scene scene = test::scene_of(torus);
    test::set_camera(scene, {30, 30, 30}, {}, {0, 0, 1}, 0.8, 64, 48);
    scene.lights.push_back({InfiniteLight{ConstantSpectrum{1}}});
    export_scene(scene, folder_ / "in.pbrt");
  }
  std::string path(const char* name) const { return (folder_ / name).string(); }
  test::CommandResult run(const char* verb, const std::string& arguments) {
    return test::run(test::vitrail(verb) + " " + path("in.pbrt") + " " + arguments);
  }
  std::size_t triangles(const char* name) {
    return import_scene(path(name)).scene.meshes.at(0).triangles.size();
  }

  test::TemporaryDirectory folder_;
};

TEST_F(MeshOptions, ConvertWritesWhatTheyMake) {
  const auto repaired = run("convert", path("repaired.pbrt") + " --repair --report " + path("report.json"));
  EXPECT_EQ(repaired.status, 0) << repaired.output;
  EXPECT_THAT(repaired.output, HasSubstr("meshes: 3202 triangles became 3200"));
  EXPECT_THAT(repaired.output, HasSubstr("1 triangles of zero area removed, 1 duplicate triangles removed"));
  EXPECT_EQ(triangles("repaired.pbrt"), 3200u);
  EXPECT_THAT(test::read_json(path("report.json")).dump(), HasSubstr("mesh repaired"));

  EXPECT_EQ(run("convert", path("few.ply") + " --repair --orient --decimate 0.25").status, 0);
  EXPECT_EQ(triangles("few.ply"), 800u);
  EXPECT_EQ(run("convert", path("many.ply") + " --repair --subdivide 1 --decimate 0.5").status, 0);
  EXPECT_EQ(triangles("many.ply"), 6400u);
}

// A ray meets both walls of a tube: together they let through what the curve does. Rendered, the inner one is
// nothing; written, each lets through 1 − √(1 − α).
TEST_F(MeshOptions, TubesOfCurvesLetThroughWhatTheCurvesDo) {
  std::ofstream(folder_ / "in.pbrt")
      << "Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 8\nPixelFilter \"box\"\n"
         "LookAt 0 0 5 0 0 0 0 1 0 Camera \"perspective\" \"float fov\" 1\n"
         "WorldBegin LightSource \"infinite\" \"rgb L\" [1 1 1]\n"
         "Material \"diffuse\" \"rgb reflectance\" [.5 .5 .5]\n"
         "Shape \"curve\" \"point3 P\" [-2 0 0 -.7 0 0 .7 0 0 2 0 0] \"float width\" .4 "
         "\"string type\" \"cylinder\" \"float alpha\" .5\n";
  const auto rendered =
      run("render", "-o " + path("out.film") + " --spp 1024 --force --quiet --tessellate 32");
  ASSERT_EQ(rendered.status, 0) << rendered.output;
  EXPECT_NEAR(test::brightness(read_film(folder_ / "out.film", nullptr)).mean, 0.75, 0.004);
  ASSERT_EQ(run("convert", path("out.pbrt") + " --tessellate 32").status, 0);
  const Shape shape = import_scene(folder_ / "out.pbrt").scene.shapes.at(0);
  EXPECT_NEAR(std::get<float>(shape.opacity), 1 - std::sqrt(0.5), 1e-6);
}

TEST_F(MeshOptions, StrictDoesNotRefuseWhatWasAskedFor) {
  ASSERT_EQ(run("convert", path("plain.pbrt") + " --strict").status, 0);
  const auto result = run("convert", path("few.pbrt") + " --strict --repair --decimate 0.25");
  EXPECT_EQ(result.status, 0) << result.output;
}

TEST_F(MeshOptions, PartitionAndRenderTakeThem) {
  const auto result =
      run("partition", "-o " + path("a.vit") + " --decimate 0.25 --repair --stats " + path("a.json"));
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_EQ(test::read_json(path("a.json")).at("input_triangles"), 800);
  // The mesh, stays in its file.
  const auto small =
      run("partition",
          "-o " + path("b.vit") + " --decimate 0.25 --repair --domains-at-once 1 --stats " + path("b.json"));
  EXPECT_EQ(small.status, 0) << small.output;
  EXPECT_EQ(test::read_json(path("b.json")).at("input_triangles"), 800);
  const std::string films[] = {path("a.film"), path("b.film"), path("c.film")};
  const auto render = [&](const std::string& input, const std::string& film, const std::string& more) {
    const auto done = test::run(test::vitrail("render") + " " + input + " -o " + film + " --spp 1 " + more +
                                " --stats " + film + ".json");
    EXPECT_EQ(done.status, 0) << done.output;
    return test::read_json(film + ".json").at("film_hash");
  };
  const auto hash = render(path("a.vit"), films[0], "");
  EXPECT_EQ(render(path("b.vit"), films[1], ""), hash);
  EXPECT_EQ(render(path("in.pbrt"), films[2], "--decimate 0.25 --repair"), hash);
  EXPECT_NE(render(path("in.pbrt"), films[2], "--force"), hash);
}

// A disk and 1100 spheres in a row, which a partitioner reads as one record.
class TessellateOption : public MeshOptions {
 protected:
  TessellateOption() {
    std::ofstream scene(folder_ / "in.pbrt");
    scene << "LookAt 0 -60 30 30 0 0 0 0 1 Camera \"perspective\" Film \"rgb\" \"integer xresolution\" 64 "
             "\"integer yresolution\" 48 WorldBegin LightSource \"infinite\" Shape \"disk\" \"float radius\" "
             "50\n";
    for (int i = 0; i < 1100; ++i)
      scene << "AttributeBegin Translate " << i % 50 << ' ' << i / 50 << " 1 Scale 1 2 1 Shape \"sphere\" "
            << "\"float radius\" .4 AttributeEnd\n";
  }
};

TEST_F(TessellateOption, MakesMeshesOfQuadrics) {
  const auto plain = run("convert", path("plain.pbrt") + " --strict --report " + path("plain.json"));
  EXPECT_EQ(plain.status, 0) << plain.output;
  EXPECT_EQ(test::read_json(path("plain.json")).at("quadrics"), "1100 spheres, 1 disk");
  EXPECT_TRUE(import_scene(path("plain.pbrt")).scene.meshes.at(1).quadric);
  const auto meshes =
      run("convert", path("meshes.pbrt") + " --strict --tessellate 8 --report " + path("m.json"));
  EXPECT_EQ(meshes.status, 0) << meshes.output;
  EXPECT_THAT(meshes.output, HasSubstr("quadrics: 2 became 56 triangles"));
  EXPECT_THAT(test::read_json(path("m.json")).dump(),
              HasSubstr("sphere tessellated: 8 segments for a full turn"));
  EXPECT_EQ(triangles("meshes.pbrt"), 8u);
  EXPECT_EQ(import_scene(path("meshes.pbrt")).scene.meshes.at(1).triangles.size(), 48u);
  EXPECT_THAT(run("inspect", "").output, HasSubstr("quadrics: 1100 spheres, 1 disk"));
}

TEST_F(TessellateOption, BeforeTheOthers) {
  const auto kept = run("convert", path("kept.pbrt") + " --decimate 0.5");
  EXPECT_THAT(kept.output, HasSubstr("quadrics stay as they are"));
  EXPECT_TRUE(import_scene(path("kept.pbrt")).scene.meshes.at(1).quadric);
  EXPECT_EQ(run("convert", path("finer.pbrt") + " --tessellate 8 --subdivide 1").status, 0);
  EXPECT_EQ(import_scene(path("finer.pbrt")).scene.meshes.at(1).triangles.size(), 4 * 48u);
}

TEST_F(TessellateOption, PartitionAndRenderTakeIt) {
  const auto input = [&](const char* what, const std::string& more) {
    const auto done = run("partition", "-o " + path("a.vit") + " --force --stats " + path("a.json") + more);
    EXPECT_EQ(done.status, 0) << done.output;
    return test::read_json(path("a.json")).at(what).get<int>();
  };
  EXPECT_EQ(input("input_triangles", " --tessellate 8"), 8 + 1100 * 48);
  EXPECT_EQ(input("input_triangles", ""), 0);
  EXPECT_EQ(input("quadrics", ""), 1101);
  const auto hash = [&](const std::string& rendered, const std::string& more) {
    const auto done = test::run(test::vitrail("render") + " " + rendered + " -o " + path("x.film") +
                                " --force --spp 1 --stats " + path("x.json") + more);
    EXPECT_EQ(done.status, 0) << done.output;
    return test::read_json(path("x.json")).at("film_hash");
  };
  const auto quadrics = hash(path("in.pbrt"), ""), coarse = hash(path("in.pbrt"), " --tessellate 8");
  EXPECT_NE(quadrics, coarse);
  ASSERT_EQ(run("convert", path("meshes.pbrt") + " --tessellate 8").status, 0);
  EXPECT_EQ(hash(path("meshes.pbrt"), ""), coarse);
}

TEST_F(MeshOptions, WrongOnesAreUsage) {
  for (const char* wrong : {"--tessellate 2", "--tessellate 5000", "--decimate 0", "--decimate 1.5",
                            "--decimate nan", "--decimate few", "--subdivide -1"}) {
    const auto result = run("convert", path("out.ply") + " " + wrong);
    EXPECT_EQ(result.status, 2) << wrong << result.output;
  }
  ASSERT_EQ(run("partition", "-o " + path("a.vit")).status, 0);
  const auto bundle =
      test::run(test::vitrail("render") + " " + path("a.vit") + " -o " + path("a.png") + " --decimate 0.25");
  EXPECT_EQ(bundle.status, 2);
  EXPECT_THAT(bundle.output, HasSubstr("give --decimate to partition"));
}

}  // namespace
}  // namespace vitrail::mesh_options_test
