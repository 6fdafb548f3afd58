// SPDX-License-Identifier: Apache-2.0
// hide_emitters and alpha, pixel by pixel against Mitsuba 3: what stands before a hidden lamp, and what shows
// it all the same.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "film/alpha.h"
#include "film/film_progress.h"
#include "tests/importers/mitsuba/mitsuba_oracle.h"
#include "tests/support/command.h"
#include "tests/support/paths.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::mitsuba_hidden_test {
namespace {

constexpr int side = 8;

struct Case {
  const char* name;
  const char* integrator;
  std::string shapes;
};

std::string rectangle(const std::string& transform, const std::string& rest) {
  return fmt::format("<shape type='rectangle'><transform name='to_world'>{}</transform>{}</shape>", transform,
                     rest);
}

const std::string wall = rectangle("<scale value='4'/><translate z='-1'/>",
                                   "<bsdf type='diffuse'><rgb name='reflectance' value='.5,.5,.5'/></bsdf>");
const std::string grey_lamp =
    "<bsdf type='diffuse'><rgb name='reflectance' value='.2,.2,.2'/></bsdf>"
    "<emitter type='area'><rgb name='radiance' value='3,3,3'/></emitter>";
// One shines to the camera, one to the wall.
const std::string lamps =
    rectangle("<scale value='.6'/>", grey_lamp) +
    rectangle("<scale value='.6'/><rotate y='1' angle='180'/><translate z='-.01'/>", grey_lamp);
const std::string surroundings = "<emitter type='constant'><rgb name='radiance' value='.4,.4,.4'/></emitter>";
std::string pane(const std::string& bsdf) {
  return rectangle("<scale value='1.2'/><translate z='2'/>", bsdf);
}

std::vector<Case> cases() {
  return {
      {"ALampBeforeAWall", "path", lamps + wall},
      {"Surroundings", "path",
       rectangle("<scale value='.8'/>",
                 "<bsdf type='diffuse'><rgb name='reflectance' value='.5,.5,.5'/></bsdf>") +
           surroundings},
      {"AMirrorThatShowsALamp", "path",
       rectangle("<scale value='1'/><rotate y='1' angle='20'/>",
                 "<bsdf type='conductor'><string name='material' value='none'/></bsdf>") +
           rectangle("<scale value='2'/><rotate y='1' angle='180'/><translate x='2' z='5'/>", grey_lamp) +
           surroundings},
      // path shows lamps where anything is before them, a hole or a sheet; volpath hides what is seen
      // straight.
      {"AThinSheetBeforeALamp", "volpath",
       pane("<bsdf type='thindielectric'/>") + lamps + wall + surroundings},
      {"AMaskBeforeALamp", "volpath",
       pane("<bsdf type='mask'><float name='opacity' value='.5'/><bsdf type='diffuse'/></bsdf>") + lamps +
           wall},
      {"AMaskBeforeSurroundings", "volpath",
       pane("<bsdf type='mask'><float name='opacity' value='.5'/><bsdf type='diffuse'/></bsdf>") +
           surroundings},
      {"ABlendWithNothingBeforeSurroundings", "volpath",
       pane(
           "<bsdf type='blendbsdf'><float name='weight' value='.4'/><bsdf type='null'/><bsdf type='diffuse'/>"
           "</bsdf>") +
           surroundings},
      {"AThinSheetBeforeSurroundings", "path", pane("<bsdf type='thindielectric'/>") + surroundings},
      {"ABallOfGlassBeforeALamp", "path",
       "<shape type='sphere'><float name='radius' value='.8'/><point name='center' x='0' y='0' z='1.5'/>"
       "<bsdf type='dielectric'/></shape>" +
           lamps + wall},
      {"FogBeforeALamp", "volpath",
       "<shape type='cube'><transform name='to_world'><scale value='.8'/><translate z='1'/></transform>"
       "<bsdf type='null'/><medium name='interior' type='homogeneous'><float name='sigma_t' value='1'/>"
       "<rgb name='albedo' value='.6,.6,.6'/></medium></shape>" +
           rectangle("<scale value='.6'/><translate z='-.5'/>", grey_lamp) + wall},
  };
}

class MitsubaHidden : public testing::TestWithParam<Case> {};

TEST_P(MitsubaHidden, IsHiddenAlike) {
  if (mitsuba_python().empty()) GTEST_SKIP() << "skipped: Mitsuba 3 is not installed";
  const TemporaryDirectory directory;
  const std::string scene = (directory / "scene.xml").string();
  std::ofstream(scene) << fmt::format(
      "<scene version='3.0.0'><integrator type='{}'><integer name='max_depth' value='12'/>"
      "<boolean name='hide_emitters' value='true'/></integrator>"
      "<sensor type='perspective'><float name='fov' value='40'/>"
      "<transform name='to_world'><lookat origin='0,0,5' target='0,0,0' up='0,1,0'/></transform>"
      "<film type='hdrfilm'><integer name='width' value='{}'/><integer name='height' value='{}'/>"
      "<string name='pixel_format' value='rgba'/><rfilter type='box'/></film></sensor>{}</scene>",
      GetParam().integrator, side, side, GetParam().shapes);
  const CommandResult ours = run(fmt::format("{} '{}' -o '{}' --alpha --spp 1024 --quiet", vitrail("render"),
                                             scene, (directory / "ours.film").string()));
  ASSERT_EQ(ours.status, 0) << ours.output;
  const Picture picture = develop_colors(read_film(directory / "ours.film", nullptr));
  ASSERT_TRUE(alpha_of(picture));
  for (const char* variant : {"scalar_rgb", "scalar_spectral"}) {
    const CommandResult theirs = run(
        fmt::format("{} '{}/tests/conformance/mitsuba_pixels.py' '{}' '{}' --spp 1024 --variant {}",
                    mitsuba_python(), source_dir(), scene, (directory / "theirs.json").string(), variant));
    ASSERT_EQ(theirs.status, 0) << theirs.output;
    const nlohmann::json expected = read_json(directory / "theirs.json");
    double sum = 0, sum_of_theirs = 0;
    for (std::size_t p = 0; p < side * side; ++p) {
      const double green = static_cast<double>(picture.rgb.values[3 * p + 1]),
                   alpha = static_cast<double>(alpha_of(picture)->values[p]);
      const double their_green = expected[p][1], their_alpha = expected[p][3];
      sum += green, sum_of_theirs += their_green;
      // Of 1024 samples, of which half see a lamp of radiance 3.
      EXPECT_NEAR(green, their_green, 0.25 + 0.05 * their_green) << variant << " pixel " << p;
      EXPECT_NEAR(alpha, their_alpha, 0.09) << variant << " pixel " << p;
    }
    EXPECT_NEAR(sum, sum_of_theirs, 0.03 * sum_of_theirs) << variant;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, MitsubaHidden, ::testing::ValuesIn(cases()),
                         [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace vitrail::test::mitsuba_hidden_test
