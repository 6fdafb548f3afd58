// SPDX-License-Identifier: Apache-2.0
// The grammar refuses what pbrt-v4 refuses, and what is written of the corpus passes it.
#include <gmock/gmock.h>

#include <map>

#include "importers/export.h"
#include "importers/import.h"
#include "tests/conformance/corpus_render.h"
#include "tests/conformance/gate/gate_report.h"
#include "tests/conformance/gate/pbrt_grammar.h"
#include "tests/support/command.h"
#include "tests/support/long_tests.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::pbrt_grammar_test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::string> complaints(const std::string& world) {
  return pbrt_complaints("Film \"rgb\"\nWorldBegin\n" + world, ".");
}

TEST(PbrtGrammar, TakesWhatPbrtTakes) {
  for (const char* world :
       {"", "Shape \"trianglemesh\" \"integer indices\" [0 1 2] \"point3 P\" [0 0 0 1 0 0 0 1 0] # comment",
        "MakeNamedMaterial \"a\" \"string type\" \"dielectric\" \"float eta\" 1.5 \"bool remaproughness\" "
        "false "
        "NamedMaterial \"a\"",
        "Texture \"t\" \"spectrum\" \"checkerboard\" \"rgb tex1\" [.1 .2 1] MakeNamedMaterial \"a\" \"string "
        "type\" "
        "\"diffuse\" \"texture reflectance\" \"t\"",
        "AttributeBegin Translate 1 -2e3 .3 LightSource \"point\" \"blackbody I\" 5000 AttributeEnd",
        "ObjectBegin \"o\" ObjectEnd ObjectInstance \"o\""})
    EXPECT_THAT(complaints(world), IsEmpty()) << world;
}

TEST(PbrtGrammar, RefusesWhatPbrtRefuses) {
  const std::string a = "MakeNamedMaterial \"a\" \"string type\" \"diffuse\" ",
                    nothing = "MakeNamedMaterial \"n\" \"string type\" \"interface\" ",
                    mix = "MakeNamedMaterial \"m\" \"string type\" \"mix\" \"string materials\" ";
  const std::pair<std::string, const char*> cases[]{
      {a + a, "defined twice"},
      {a + "\"float sigma\" 3", "not a parameter"},
      {a + "\"float reflectance\" .5", "cannot be of type float"},
      {a + "\"rgb reflectance\" [2 0 0]", "albedo above 1"},
      {a + "\"texture reflectance\" \"t\"", "no texture of colours"},
      {a + mix + "[\"a\" \"a\"] \"float displacement\" 1", "not a parameter"},
      {a + nothing + mix + "[\"a\" \"n\"]", "mix with an interface"},
      {mix + "[\"a\" \"a\"]" + a, "not defined before"},
      {"MakeNamedMaterial \"a\" \"string type\" \"thindielectric\" \"float roughness\" 0", "not a parameter"},
      {"MakeNamedMaterial \"a\" \"string type\" \"hair\" \"float displacement\" 0", "not a parameter"},
      {"MakeNamedMaterial \"a\" \"string type\" \"subsurface\" \"spectrum eta\" \"glass-BK7\"", "cannot be"},
      {"MakeNamedMaterial \"a\" \"string type\" \"dielectric\" \"bool remaproughness\" \"false\"", "neither"},
      {"Texture \"t\" \"float\" \"windy\" \"integer octaves\" 3", "not a parameter"},
      {"Texture \"t\" \"spectrum\" \"fbm\"", "no spectrum Texture"},
      {"Texture \"t\" \"float\" \"marble\"", "no float Texture"},
      {"Texture \"t\" \"spectrum\" \"mix\" \"rgb tex1\" [3 2 1]", "albedo above 1"},
      {"Texture \"f\" \"float\" \"fbm\" Texture \"t\" \"float\" \"bilerp\" \"texture v00\" \"f\"",
       "cannot be a texture"},
      {"Texture \"t\" \"float\" \"imagemap\" \"string wrap\" \"mirror\"", "is no wrap"},
      {"LightSource \"point\" \"rgb I\" [1 -1 0]", "negative"},
      {"LightSource \"point\" \"spectrum I\" [400 1 400 2]", "do not increase"},
      {"LightSource \"point\" \"float scale\" inf", "finite"},
      {"LightSource \"projection\"", "without an image"},
      {"AreaLightSource \"diffuse\" \"rgb L\" [1 1 1] ObjectBegin \"o\" Shape \"plymesh\" ObjectEnd",
       "in objects"},
      {nothing + "NamedMaterial \"n\" AreaLightSource \"diffuse\" Shape \"plymesh\"", "on interfaces"},
      {"NamedMaterial \"b\"", "no named material"},
      {"AttributeBegin", "does not end"},
      {"AttributeBegin ObjectEnd", "nest"},
      {"Camera \"perspective\"", "inside of the world"},
      {"MakeNamedMedium \"m\" \"string type\" \"cloud\" \"float scale\" 1", "not a parameter"},
      {"MakeNamedMedium \"m\" \"string type\" \"uniformgrid\" \"float density\" [1 2]", "for 1 cells"},
      {"Shape \"trianglemesh\" \"float uv\" [0 0]", "cannot be of type float"},
      {"WorldEnd", "not a directive"},
      {"Transform [1 2 3]", "finite numbers"}};
  for (const auto& [world, complaint] : cases)
    EXPECT_THAT(complaints(world), Contains(HasSubstr(complaint))) << world;
}

TEST(PbrtGrammar, TakesTheCorpus) {
  if (corpus().empty()) GTEST_SKIP() << "skipped: there is no corpus";
  const TemporaryDirectory folder;
  GateReport report("pbrt, corpus");
  std::map<std::string, int> scenes;  // of a format, of which every second one without VITRAIL_LONG_TESTS
  for (const CorpusScene& scene : corpus_scenes()) {
    if (scene.format == "povray-3.7" || scene.format == "nori-xml+obj") continue;
    if (scenes[scene.format]++ % 2 == 1 && !are_long()) continue;
    try {
      export_scene(import_scene(corpus() / scene.path).scene, folder / "scene.pbrt");
    } catch (const Error&) {
      continue;  // a file that is to be refused
    }
    std::string wrong;
    for (const std::string& complaint : pbrt_complaints(folder / "scene.pbrt")) wrong += complaint + "; ";
    report.check(scene.path, wrong);
  }
}

}  // namespace
}  // namespace vitrail::test::pbrt_grammar_test
