// SPDX-License-Identifier: Apache-2.0
// docs/reference/inspect.md lists each key of `inspect --json`, and its type.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <regex>

#include "tests/support/partitioned_box.h"
#include "tests/support/paths.h"

namespace vitrail::test::inspect_json_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
using Types = std::map<std::string, std::string>;

// By heading: rows of "| `key` `key` | type | what |".
std::map<std::string, Types> documented() {
  std::ifstream in(project_file("docs/reference/inspect.md"));
  std::map<std::string, Types> sections;
  std::string heading;
  static const std::regex row(R"(\| ((?:`[^`]+` ?)+)\| ([a-z ]+) \|.*)"), key(R"(`([^`]+)`)");
  for (std::string line; std::getline(in, line);) {
    std::smatch match;
    if (line.starts_with("## ")) heading = line.substr(3);
    if (!std::regex_match(line, match, row)) continue;
    const std::string keys = match[1];
    for (std::sregex_iterator k(keys.begin(), keys.end(), key), end; k != end; ++k)
      sections[heading][(*k)[1]] = match[2];
  }
  return sections;
}

bool is_of(const nlohmann::json& value, const std::string& type) {
  if (type == "string") return value.is_string();
  if (type == "number") return value.is_number();
  if (type == "boolean") return value.is_boolean();
  if (type == "list") return value.is_array();
  if (type == "numbers")
    return value.is_array() && std::ranges::all_of(value, [](const auto& v) { return v.is_number(); });
  if (type.ends_with(" or null")) return value.is_null() || is_of(value, type.substr(0, type.size() - 8));
  return false;
}

void expect_documented(const nlohmann::json& value, const std::string& key, const Types& types) {
  static const std::regex named("^(needs|requires)\\.[a-z_]+\\.");
  const auto found = types.find(std::regex_replace(key, named, "$1.NAME."));
  if (found != types.end()) {
    EXPECT_TRUE(is_of(value, found->second)) << key << " is no " << found->second << ": " << value;
  } else if (value.is_object()) {
    for (const auto& [name, part] : value.items())
      expect_documented(part, key.empty() ? name : key + "." + name, types);
  } else if (value.is_array() && (value.empty() || value[0].is_object())) {
    for (const auto& part : value) expect_documented(part, key + "[]", types);
  } else {
    ADD_FAILURE() << key << " is not documented";
  }
}

class InspectJson : public PartitionedBox {
 protected:
  InspectJson() : PartitionedBox(2) {}
  const std::string scene_ = project_file("examples/cornell-box/cornell-box.pbrt");
  nlohmann::json json(const std::string& file) const {
    const CommandResult done = run(fmt::format("{} '{}' --json --missing=replace", vitrail("inspect"), file));
    EXPECT_EQ(done.status, 0) << done.output;
    return nlohmann::json::parse(done.output);
  }
};

TEST_F(InspectJson, KeepsItsDocument) {
  const auto sections = documented();
  ASSERT_EQ(sections.size(), 2u);
  ASSERT_EQ(run(fmt::format("{} '{}' -o '{}' --crop 0,8,0,8 --spp 2", vitrail("render"), path("box.vit"),
                            path("a.film")))
                .status,
            0);
  for (const std::string& file : {scene_, path("box.vit")})
    expect_documented(json(file), "", sections.at("Scenes and bundles"));
  expect_documented(json(path("a.film")), "", sections.at("Films and checkpoints"));
}

// Lists that the Cornell box leaves empty.
TEST_F(InspectJson, KeepsItsDocumentWhereThereIsMore) {
  std::ofstream(directory_ / "more.pbrt")
      << "Integrator \"volpath\" \"integer maxdepth\" 1000000\nMakeNamedMedium \"m\" \"string type\" "
         "\"homogeneous\"\nWorldBegin\nLightSource \"point\"\n"
         "Texture \"t\" \"spectrum\" \"checkerboard\"\nTexture \"i\" \"spectrum\" \"imagemap\" \"string "
         "filename\" \"none.png\"\nMaterial \"diffuse\" \"texture reflectance\" \"t\"\nShape \"sphere\"\n"
         "Material \"dielectric\"\nShape \"trianglemesh\" \"point3 P\" [2 0 0 3 0 0 2 1 0]\n";
  const nlohmann::json more = json(path("more.pbrt"));
  expect_documented(more, "", documented().at("Scenes and bundles"));
  EXPECT_FALSE(more["textures"].empty() || more["media"].empty() || more["open_glass"].empty()) << more;
}

TEST_F(InspectJson, AQuadricThatShinesHasAnAreaAndAPower) {
  std::ofstream(directory_ / "lamp.pbrt")
      << "Integrator \"volpath\" \"integer maxdepth\" 1000000\nWorldBegin\n"
         "AttributeBegin\nAreaLightSource \"diffuse\"\nScale 2 2 2\nShape \"sphere\"\nAttributeEnd\n";
  const nlohmann::json lamp = json(path("lamp.pbrt"))["lights"][0];
  EXPECT_NEAR(lamp["area"].get<double>(), 16 * 3.14159265, 1e-3);
  EXPECT_GT(lamp["power"], 0);
  EXPECT_EQ(lamp["number"], 1);
  EXPECT_THAT(lamp["shape"], HasSubstr("lamp.pbrt:6:"));
  EXPECT_TRUE(lamp["material"].is_null());
}

// A point light has neither.
TEST_F(InspectJson, ALampHasAShapeAndAMaterial) {
  std::ofstream(directory_ / "lamps.pbrt")
      << "WorldBegin\nLightSource \"point\"\nMakeNamedMaterial \"bulb\" \"string type\" \"diffuse\"\n"
         "NamedMaterial \"bulb\"\nAttributeBegin\nAreaLightSource \"diffuse\"\nShape "
         "\"sphere\"\nAttributeEnd\n";
  const nlohmann::json lights = json(path("lamps.pbrt"))["lights"];
  ASSERT_EQ(lights.size(), 2u);
  EXPECT_EQ(lights[0]["material"], "bulb");
  EXPECT_THAT(lights[0]["shape"], HasSubstr("lamps.pbrt:7:"));
  EXPECT_TRUE(lights[1]["shape"].is_null() && lights[1]["material"].is_null());
}

// A folder of a short name is within many a path.
TEST_F(InspectJson, PathsLoseTheFolderOfTheSceneAlone) {
  const TemporaryDirectory directory;
  const std::filesystem::path folder = directory / "s";
  std::filesystem::create_directories(folder / "mas" / "x");
  std::ofstream(folder / "a.obj")
      << "mtllib a.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n";
  std::ofstream(folder / "a.mtl") << "newmtl m\nmap_Kd mas/x/gone.png\n";
  const std::string text =
      run(fmt::format("cd '{}' && {} s/a.obj", directory.path().string(), vitrail("inspect"))).output;
  EXPECT_THAT(text, HasSubstr("mas/x/gone.png"));
}

TEST_F(InspectJson, TheTextBeginsWithASummary) {
  const std::string text = run(fmt::format("{} '{}'", vitrail("inspect"), scene_)).output;
  EXPECT_THAT(text, StartsWith("size: "));
  EXPECT_THAT(text, HasSubstr("\na render takes: about "));
  EXPECT_THAT(text, HasSubstr("\nexact: "));
  EXPECT_THAT(text, Not(HasSubstr("1048576")));
  const std::string folder = std::filesystem::path(scene_).parent_path().string();
  EXPECT_EQ(text.find(folder), text.rfind(folder)) << "more than the name of the file has it";
}

}  // namespace
}  // namespace vitrail::test::inspect_json_test
