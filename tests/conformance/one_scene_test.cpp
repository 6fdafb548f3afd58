// SPDX-License-Identifier: Apache-2.0
// One scene in every format: written for pbrt, Mitsuba and, as far as it can say it, OBJ, it imports to equal
// meshes, camera, lights and film, and renders to the same film.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "importers/export.h"
#include "importers/import.h"
#include "scene/shapes/deferred_mesh.h"
#include "scene/spectra/rgb_to_spectrum.h"
#include "tests/importers/mitsuba/mitsuba_oracle.h"
#include "tests/support/command.h"
#include "tests/support/equal_scenes.h"
#include "tests/support/paths.h"
#include "tests/support/render.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::one_scene_test {
namespace {

namespace fs = std::filesystem;

const std::string square = "\"integer indices\" [0 1 2 0 2 3]";

// A room with a lamp, a block and a pane, in the words of pbrt.
const std::string room =
    "LookAt 0.1 0.5 -3.2 0 0.4 0 0 1 0 Camera \"perspective\" \"float fov\" 40\n"
    "Film \"rgb\" \"integer xresolution\" 48 \"integer yresolution\" 32 Sampler \"zsobol\" \"integer "
    "pixelsamples\" 4\n"
    "PixelFilter \"box\" Integrator \"path\" \"integer maxdepth\" 6\n"
    "WorldBegin\n"
    "LightSource \"point\" \"rgb I\" [.4 .5 .6] \"point3 from\" [-.8 .9 -.9]\n"
    "LightSource \"distant\" \"rgb L\" [.3 .2 .1] \"point3 from\" [1 3 -2] \"point3 to\" [0 0 0]\n"
    "MakeNamedMaterial \"chalk\" \"string type\" \"diffuse\" \"rgb reflectance\" [.7 .6 .5]\n"
    "MakeNamedMaterial \"moss\" \"string type\" \"diffuse\" \"rgb reflectance\" [.1 .4 .1]\n"
    "MakeNamedMaterial \"pane\" \"string type\" \"dielectric\" \"float eta\" 1.5\n"
    "NamedMaterial \"chalk\"\n"
    "Shape \"trianglemesh\" " +
    square +
    " \"point3 P\" [-2 0 -2 -2 0 2 2 0 2 2 0 -2]\n"
    "Shape \"trianglemesh\" " +
    square +
    " \"point3 P\" [-2 0 2 -2 3 2 2 3 2 2 0 2]\n"
    "NamedMaterial \"moss\"\n"
    "AttributeBegin Translate .3 .25 .4 Rotate 30 0 1 0 Scale .5 .5 .5 Shape \"sphere\" AttributeEnd\n"
    "NamedMaterial \"pane\"\n"
    "AttributeBegin Translate -.5 .4 -.3 Rotate 20 0 1 0 Shape \"trianglemesh\" \"integer indices\" [0 2 1 0 "
    "3 2 4 5 6 4 6 7] "
    "\"point3 P\" [-.4 -.3 0 .4 -.3 0 .4 .3 0 -.4 .3 0 -.4 -.3 .02 .4 -.3 .02 .4 .3 .02 -.4 .3 .02] "
    "AttributeEnd\n"
    "NamedMaterial \"chalk\" AreaLightSource \"diffuse\" \"rgb L\" [5 5 4]\n"
    "Shape \"trianglemesh\" " +
    square + " \"point3 P\" [-.5 2.5 -.5 .5 2.5 -.5 .5 2.5 .5 -.5 2.5 .5]\n";

std::uint64_t film_hash(const Scene& scene) { return test::render(scene, 4).film.hash(); }

class OneScene : public ::testing::Test {
 protected:
  OneScene() {
    std::ofstream(folder_ / "room.pbrt") << room;
    original_ = import_scene(folder_ / "room.pbrt").scene;
  }
  Scene through(const Scene& scene, const char* name, Diagnostics* diagnostics = nullptr) {
    Diagnostics written = export_scene(scene, folder_ / name);
    if (diagnostics) *diagnostics = std::move(written);
    return import_scene(folder_ / name).scene;
  }
  test::TemporaryDirectory folder_;
  Scene original_;
};

TEST_F(OneScene, ComesBackEqualFromPbrtAndMitsuba) {
  for (const char* name : {"again.pbrt", "again.xml"}) {
    Diagnostics written;
    const Scene again = through(original_, name, &written);
    for (const Diagnostic& d : written) ADD_FAILURE() << name << ": " << d.message;
    EXPECT_EQ(test::difference(original_, again), "") << name;
    EXPECT_EQ(film_hash(again), film_hash(original_)) << name;
  }
}

TEST_F(OneScene, ComesBackEqualFromPbrtByMitsubaToPbrt) {
  const Scene there = through(original_, "there.xml"), back = through(there, "back.pbrt");
  EXPECT_EQ(test::difference(original_, back), "");
  EXPECT_EQ(film_hash(back), film_hash(original_));
}

// OBJ has neither camera nor lights, other than those that shine by their material: these are put in.
TEST_F(OneScene, HasTheSameSurfacesInObj) {
  Scene again = through(original_, "room.obj");
  std::size_t triangles = 0, expected = 0;
  for (const TriangleMesh& mesh : again.meshes) triangles += mesh.triangles.size();
  for (const TriangleMesh& mesh : original_.meshes) {
    TriangleMesh storage;
    expected += loaded(mesh, storage).triangles.size();
  }
  EXPECT_EQ(triangles, expected);
  // What OBJ itself can say comes back as it is: a scene of OBJ in every format.
  again = through(again, "objects.obj");
  for (const char* name : {"objects.pbrt", "objects.xml", "more.obj"}) {
    Scene said = again;
    // OBJ's lights shine to both sides, Mitsuba's to one: they are left out there.
    if (std::string_view(name).ends_with(".xml"))
      for (Shape& shape : said.shapes) shape.area_light.reset();
    Scene other = through(said, name);
    other.camera = said.camera, other.lights = said.lights;
    other.film = said.film, other.settings = said.settings;
    EXPECT_EQ(test::difference(said, other), "") << name;
    EXPECT_EQ(film_hash(other), film_hash(said)) << name;
  }
}

// Of Y, blue, green and red: means over the picture, from Mitsuba's own render.
double mean_luminance_by_mitsuba(const fs::path& scene, const fs::path& folder, int spp) {
  const std::string out = (folder / "mitsuba.npy").string();
  const std::string command = fmt::format(
      "{0} {1}/tests/importers/render_mitsuba.py {2} {3} --spp {4} > /dev/null 2>&1 && {0} -c \"import "
      "numpy; "
      "print(float((numpy.load('{3}') @ [0.212639, 0.715169, 0.072192]).mean()))\"",
      mitsuba_python(), test::source_dir(), scene.string(), out, spp);
  const test::CommandResult result = test::run(command);
  EXPECT_EQ(result.status, 0) << result.output;
  return std::atof(result.output.c_str());
}

TEST_F(OneScene, LooksTheSameToMitsuba) {
  if (mitsuba_python().empty())
    GTEST_SKIP() << "skipped: Mitsuba 3 is not installed (python3 -m pip install mitsuba)";
  // Without the pane: through panes Mitsuba has no light from points and from afar.
  std::erase_if(original_.shapes, [&](const Shape& shape) {
    return std::holds_alternative<DielectricMaterial>(original_.materials[shape.material.value].model);
  });
  export_scene(original_, folder_ / "room.xml");
  constexpr int spp = 64;
  const test::Brightness ours = test::brightness(test::render(original_, spp).film);
  const double theirs = mean_luminance_by_mitsuba(folder_ / "room.xml", folder_ / ".", spp);
  fmt::print("mean luminance: {:.5f} ± {:.5f} here, {:.5f} in Mitsuba, ratio {:.4f}\n", ours.mean,
             ours.standard_error, theirs, theirs / ours.mean);
  // The spheres are triangles here and there; both pictures have noise of about the same size.
  EXPECT_NEAR(theirs, ours.mean, 4 * 1.5 * ours.standard_error + 0.005 * ours.mean);
}

}  // namespace
}  // namespace vitrail::one_scene_test
