// SPDX-License-Identifier: Apache-2.0
// Near and far planes of cameras, pixel by pixel against Mitsuba 3: as the file says, and as it is written
// anew. Rays start at the one and end at the other; behind that are the surroundings.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "film/develop.h"
#include "film/film_progress.h"
#include "tests/importers/mitsuba/mitsuba_oracle.h"
#include "tests/support/command.h"
#include "tests/support/long_tests.h"
#include "tests/support/paths.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::mitsuba_clip_test {
namespace {

constexpr int side = 8;

struct Case {
  const char* name;
  std::string planes;
  std::string shapes;
  const char* sensor = "perspective";
  const char* more = "";  // of the sensor
  const char* scale = "";
  const char* integrator = "path";
};

std::string grey(const char* value) {
  return fmt::format(
      "<bsdf type='twosided'><bsdf type='diffuse'><rgb name='reflectance' "
      "value='{0},{0},{0}'/></bsdf></bsdf>",
      value);
}
std::string near(const char* v) { return fmt::format("<float name='near_clip' value='{}'/>", v); }
std::string far(const char* v) { return fmt::format("<float name='far_clip' value='{}'/>", v); }
std::string shape(const char* kind, const std::string& transform, const std::string& rest) {
  return fmt::format("<shape type='{}'><transform name='to_world'>{}</transform>{}</shape>", kind, transform,
                     rest);
}

// Fog without end shows none of the surroundings there, and here some.
const std::string bulb =
    "<emitter type='point'><point name='position' x='1' y='2' z='3'/>"
    "<rgb name='intensity' value='12,12,12'/></emitter>";
const std::string surroundings = "<emitter type='constant'><rgb name='radiance' value='1,1,1'/></emitter>";
const std::string wall = shape("rectangle", "<scale value='4'/><translate z='-1'/>", grey(".5"));
const std::string ball = shape("sphere", "<scale value='1'/>", grey(".2"));
const std::string box = shape("cube", "<rotate y='1' angle='30'/>", grey(".2"));
const std::string lamp = shape("rectangle", "<scale value='.7'/><translate z='1'/>",
                               "<emitter type='area'><rgb name='radiance' value='3,3,3'/></emitter>");
const std::string glass = shape("sphere", "<scale value='1'/>",
                                "<bsdf type='dielectric'><float name='int_ior' value='1.5'/></bsdf>");
const char* const fog =
    "<medium type='homogeneous'><float name='sigma_t' value='.3'/><rgb name='albedo' "
    "value='0,0,0'/></medium>";
const std::string cloud =
    shape("cube", "",
          "<bsdf type='null'/><medium name='interior' type='homogeneous'><float name='sigma_t' value='1'/>"
          "<rgb name='albedo' value='.5,.5,.5'/></medium>");
const std::string mask =
    shape("rectangle", "<scale value='2'/><translate z='1.5'/>",
          "<bsdf type='mask'><float name='opacity' value='.5'/><bsdf type='diffuse'/></bsdf>");
constexpr const char* lens =
    "<float name='aperture_radius' value='.3'/><float name='focus_distance' value='5'/>";

// The camera is at z = 5.
std::vector<Case> cases() {
  return {
      {"NearWithinAQuadric", near("4.5"), ball + wall},
      {"NearWithinAMesh", near("4.5"), box + wall},
      {"FarWithinAQuadric", far("4.5"), ball + wall},
      {"FarBeforeAWall", far("5.5"), ball + wall},
      {"NearBehindALamp", near("4.5"), lamp + wall},
      {"ASliceOfABox", near("4.2") + far("4.9"), box + wall},
      {"Orthographic", near("4.5") + far("5.5"), ball + wall, "orthographic"},
      {"ScaledOrthographic", near("2.25") + far("3.25"), ball + wall, "orthographic", "",
       "<scale value='2'/>"},
      {"ThinLens", near("4.5") + far("5.9"), ball + wall, "thinlens", lens},
      {"NearWithinGlass", near("4.7"), glass + wall},
      {"FarWithinGlass", far("4.7"), glass + wall},
      {"NearInFog", near("3"), ball + wall, "perspective", fog, "", "volpath"},
      {"FarInFog", far("5.5"), ball + wall, "perspective", fog, "", "volpath"},
      {"NearWithinACloud", near("5"), cloud + wall, "perspective", "", "", "volpath"},
      {"FarWithinACloud", far("5"), cloud + wall, "perspective", "", "", "volpath"},
      {"BehindAMaskTheRayHasNoEnd", far("4"), mask + ball + wall},
      {"ItsOwnPlanes", "", shape("sphere", "<scale value='.02'/><translate z='5'/>", grey(".2")) + wall},
  };
}

class MitsubaClip : public testing::TestWithParam<Case> {};

TEST_P(MitsubaClip, IsCutAlike) {
  if (mitsuba_python().empty()) GTEST_SKIP() << "skipped: Mitsuba 3 is not installed";
  const Case& c = GetParam();
  const TemporaryDirectory directory;
  const std::string scene = (directory / "scene.xml").string(), again = (directory / "again.xml").string();
  const bool flat = c.sensor == std::string("orthographic");
  std::ofstream(scene) << fmt::format(
      "<scene version='3.0.0'><integrator type='{}'><integer name='max_depth' value='12'/></integrator>"
      "<sensor type='{}'>{}{}{}<transform name='to_world'>{}<lookat origin='0,0,5' target='0,0,0' "
      "up='0,1,0'/>"
      "</transform><film type='hdrfilm'><integer name='width' value='{}'/><integer name='height' value='{}'/>"
      "<rfilter type='box'/></film></sensor>{}{}</scene>",
      c.integrator, c.sensor, flat ? "" : "<float name='fov' value='40'/>", c.planes, c.more, c.scale, side,
      side, c.more == fog ? bulb : surroundings, c.shapes);
  const CommandResult ours = run(fmt::format("{} '{}' -o '{}' --spp 1024 --quiet", vitrail("render"), scene,
                                             (directory / "ours.film").string()));
  ASSERT_EQ(ours.status, 0) << ours.output;
  const CommandResult written = run(fmt::format("{} '{}' '{}' --quiet", vitrail("convert"), scene, again));
  ASSERT_EQ(written.status, 0) << written.output;
  const Picture picture = develop_colors(read_film(directory / "ours.film", nullptr));
  for (const char* variant : {"scalar_rgb", "scalar_spectral"})
    for (const std::string& file : {scene, again}) {
      // Without VITRAIL_LONG_TESTS each variant shows one of the files.
      if (!are_long() && (file == again) != (variant == std::string("scalar_spectral"))) continue;
      const CommandResult theirs = run(
          fmt::format("{} '{}/tests/conformance/mitsuba_pixels.py' '{}' '{}' --spp 1024 --variant {}",
                      mitsuba_python(), source_dir(), file, (directory / "theirs.json").string(), variant));
      ASSERT_EQ(theirs.status, 0) << theirs.output;
      const nlohmann::json expected = read_json(directory / "theirs.json");
      double sum = 0, sum_of_theirs = 0;
      for (std::size_t p = 0; p < side * side; ++p) {
        const double green = static_cast<double>(picture.rgb.values[3 * p + 1]), their_green = expected[p][1];
        sum += green, sum_of_theirs += their_green;
        EXPECT_NEAR(green, their_green, 0.06) << variant << " pixel " << p << " of " << file;
      }
      EXPECT_NEAR(sum, sum_of_theirs, 0.01 * sum_of_theirs) << variant << " " << file;
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, MitsubaClip, ::testing::ValuesIn(cases()),
                         [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace vitrail::test::mitsuba_clip_test
