// SPDX-License-Identifier: Apache-2.0
// What people call the lights, the materials and the shapes of a bundle.
#include <gmock/gmock.h>

#include "bundle/light_names.h"
#include "bundle/matte_names.h"
#include "scene/system/diagnostics.h"
#include "tests/bundle/sample_bundle.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::names_test {
namespace {

using testing::ElementsAre;

// Two area lights, four others, and media of which the second and the third shine.
Manifest shining_manifest() {
  Manifest m = test::sample_manifest();
  m.media.emplace_back();
  m.media[1].emission = ConstantSpectrum{1};
  m.media[2].temperature = Grid{"", "", 1, 1, 1, 1, {900}};
  return m;
}

TEST(LightNames, CountFromTheAreaLightsOn) {
  const LightNames names = light_names(shining_manifest());
  EXPECT_THAT(names.area_lights, ElementsAre("area-1", "area-2"));
  EXPECT_THAT(names.lights, ElementsAre("point-3", "distant-4", "infinite-5", "spot-6"));
  EXPECT_THAT(names.media, ElementsAre("", "medium-2", "medium-3"));
}

TEST(LightNames, AreTheFilesOwnWhereItGivesThem) {
  Manifest m = shining_manifest();
  m.area_lights[1].name = "Desk lamp";
  m.lights[2].name = "a,b=c";
  m.lights[3].name = std::string(70, 'x');
  const LightNames given = light_names(m), numbered = numbered_light_names(m);
  EXPECT_THAT(given.area_lights, ElementsAre("area-1", "Desk_lamp"));
  EXPECT_THAT(given.lights, ElementsAre("point-3", "distant-4", "a_b_c", std::string(64, 'x')));
  EXPECT_THAT(numbered.area_lights, ElementsAre("area-1", "area-2"));
  EXPECT_THAT(numbered.lights, ElementsAre("point-3", "distant-4", "infinite-5", "spot-6"));
}

TEST(MatteNames, OfMaterialsCountFromOne) {
  Manifest m = test::sample_manifest();
  m.materials[1].name = "oak";
  EXPECT_THAT(material_names(m), ElementsAre("material-1", "oak", "material-3"));
}

TEST(MatteNames, OfShapesComeBackForTheirOwnSurfaces) {
  const test::TemporaryDirectory directory;
  Manifest m = test::sample_manifest();
  write_shape_names(directory.path(), std::vector<std::string>{"chair", "shape-2", "a \"b\""});
  EXPECT_THAT(read_shape_names(directory.path(), m), ElementsAre("chair", "shape-2", "a \"b\""));
  m.surfaces.pop_back();
  EXPECT_THROW(read_shape_names(directory.path(), m), Error);
}

}  // namespace
}  // namespace vitrail::names_test
