// SPDX-License-Identifier: Apache-2.0
// `render --set`: glass in another state, without partitioning again.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/glazing/glazing_files.h"
#include "tests/support/command.h"

namespace vitrail::test::set_glazing_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string unit_text = R"({"layers": [{"states": [{"state": 0, "pane": "pane.dat"},
  {"state": 1, "tinted": {"visible_transmittance": 0.1, "solar_transmittance": 0.08}}]}]})";
const std::string sunny_text = R"({"name": "sunny", "layers": [
  {"states": [{"state": 0, "pane": "pane.dat"},
   {"state": 1, "tinted": {"visible_transmittance": 0.1, "solar_transmittance": 0.08}}],
   "photochromic": {"k_d_m2_per_j": 2e-4, "k_f_per_s": 1e-3, "activation_kj_per_mol": 60, "uv_w_per_m2": 0}},
  {"gap_mm": 12}, {"pane": "windows.idf", "product": "Warm"}]})";

// A lamp seen through two panes of glass, each beside the other.
std::string scene_text(const std::string& window, const std::string& roof) {
  return fmt::format(R"(LookAt 0 0 3  0 0 0  0 1 0
Camera "perspective" "float fov" 40
Sampler "independent" "integer pixelsamples" 4
Film "rgb" "integer xresolution" 16 "integer yresolution" 16 "string filename" "a.exr"
WorldBegin
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [1 1 1]
  Shape "trianglemesh" "point3 P" [-2 -2 -1 2 -2 -1 2 2 -1 -2 2 -1] "integer indices" [0 1 2 0 2 3]
AttributeEnd
MakeNamedMaterial "window" "string type" "thindielectric" "string glazing" "unit.json" {}
NamedMaterial "window"
Shape "trianglemesh" "point3 P" [-1 -1 0 0 -1 0 0 1 0 -1 1 0] "integer indices" [0 1 2 0 2 3]
Material "thindielectric" "string glazing" "sunny.json" {}
Shape "trianglemesh" "point3 P" [0 -1 0 1 -1 0 1 1 0 0 1 0] "integer indices" [0 1 2 0 2 3]
)",
                     window, roof);
}

std::string read_bytes(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class SetGlazing : public ::testing::Test {
 protected:
  SetGlazing() {
    write_text(directory / "pane.dat", optics_text);
    write_text(directory / "windows.idf", idf_text);
    write_text(directory / "unit.json", unit_text);
    write_text(directory / "sunny.json", sunny_text);
    partition("clear", "", "");
  }
  std::string path(const std::string& name) const { return (directory / name).string(); }
  void partition(const std::string& name, const std::string& window, const std::string& roof) const {
    write_text(directory / (name + ".pbrt"), scene_text(window, roof));
    const CommandResult made = run(fmt::format("{} '{}' -o '{}' --domains 3 --quiet", vitrail("partition"),
                                               path(name + ".pbrt"), path(name + ".vit")));
    ASSERT_EQ(made.status, 0) << made.output;
  }
  CommandResult render(const std::string& bundle, const std::string& film, const std::string& options = "",
                       int ranks = 1) const {
    return run(fmt::format("{} '{}' -o '{}' --stats '{}' -t 1 --quiet {}",
                           ranks > 1 ? mpi_vitrail("render", ranks) : vitrail("render"), path(bundle),
                           path(film), path("stats.json"), options));
  }
  // Of the film, which is not there yet.
  std::string hash(const std::string& bundle, const std::string& options, int ranks = 1) const {
    std::filesystem::remove(directory / "h.film");
    const CommandResult result = render(bundle, "h.film", options, ranks);
    EXPECT_EQ(result.status, 0) << result.output;
    return read_json(directory / "stats.json").at("film_hash");
  }

  TemporaryDirectory directory;
};

TEST_F(SetGlazing, IsThePictureOfABundleMadeInThatState) {
  partition("dark", "\"float state\" 0.6", "\"float temperature\" 40");
  const std::string wanted = hash("dark.vit", ""),
                    options = "--set window.state=0.6 --set sunny.temperature=40";
  EXPECT_EQ(hash("clear.vit", options), wanted);
  EXPECT_EQ(hash("clear.vit", options, 2), wanted);
  EXPECT_EQ(hash("clear.pbrt", options), wanted) << "of a scene, too";
  EXPECT_NE(hash("clear.vit", ""), wanted);
  const std::string direct = hash("clear.vit", options + " --integrator direct --threshold 0.01");
  EXPECT_EQ(hash("clear.vit", options + " --integrator direct --threshold 0.01", 2), direct);
  EXPECT_EQ(render("clear.vit", "t.film", "--threshold 0.01").status, 2) << "nothing that a path has";
  EXPECT_NE(hash("clear.vit", "--set window.state=0.6"), wanted);
}

TEST_F(SetGlazing, LightAndWarmthOfPhotochromicGlass) {
  // k_d·E = 1e-3 = k_f at 20 °C: half, in the end; after no time nothing.
  EXPECT_EQ(hash("clear.vit", "--set sunny.uv=5"), hash("clear.vit", "--set sunny.state=0.5"));
  EXPECT_EQ(hash("clear.vit", "--set sunny.uv=5 --set sunny.seconds=0"), hash("clear.vit", ""));
  EXPECT_NE(hash("clear.vit", "--set sunny.uv=5 --set sunny.seconds=600"), hash("clear.vit", ""));
}

TEST_F(SetGlazing, AnotherStateIsAnotherPicture) {
  ASSERT_EQ(render("clear.vit", "a.film", "--set window.state=0.6").status, 0);
  const CommandResult other = render("clear.vit", "a.film", "--spp 8 --set window.state=0.7");
  EXPECT_EQ(other.status, 3);
  EXPECT_THAT(other.output, HasSubstr("window.state=0.6, this command has window.state=0.7"));
  EXPECT_EQ(render("clear.vit", "a.film", "--spp 8").status, 3);
  EXPECT_EQ(render("clear.vit", "a.film", "--spp 8 --set window.state=0.6").status, 0);
  const CommandResult shown = run(fmt::format("{} '{}'", vitrail("inspect"), path("a.film")));
  EXPECT_THAT(shown.output, HasSubstr("window.state=0.6"));
  ASSERT_EQ(run(fmt::format("{} '{}' -o '{}'", vitrail("develop"), path("a.film"), path("a.exr"))).status, 0);
  EXPECT_THAT(read_bytes(directory / "a.exr"), HasSubstr("window.state=0.6"));
  // The state that it has is no other one.
  ASSERT_EQ(render("clear.vit", "b.film").status, 0);
  EXPECT_EQ(render("clear.vit", "b.film", "--spp 8 --set window.state=0").status, 0);
}

TEST_F(SetGlazing, InspectListsPanesThatDoNotSwitch) {
  write_text(directory / "still.pbrt",
             scene_text("", "") +
                 "MakeNamedMaterial \"still\" \"string type\" \"thindielectric\" "
                 "\"string glazing\" \"pane.dat\"\nNamedMaterial \"still\"\nShape \"disk\"\n");
  const CommandResult told = run(fmt::format("{} '{}' --json", vitrail("inspect"), path("still.pbrt")));
  ASSERT_EQ(told.status, 0) << told.output;
  const nlohmann::json panes = nlohmann::json::parse(told.output).at("glazing");
  ASSERT_EQ(panes.size(), 3u);
  EXPECT_EQ(panes[0]["name"], "window");
  EXPECT_EQ(panes[0]["can_be_set"], "state");
  EXPECT_EQ(panes[1]["system"], "sunny");
  EXPECT_EQ(panes[2]["name"], "still");
  EXPECT_EQ(panes[2]["set"], "");
  EXPECT_EQ(panes[2]["can_be_set"], "");
}

TEST_F(SetGlazing, SaysWhatCanBeSet) {
  const auto refused = [&](const std::string& options) {
    const CommandResult result = render("clear.vit", "r.film", options);
    EXPECT_EQ(result.status, 2) << options;
    return result.output;
  };
  EXPECT_THAT(refused("--set door.state=0.5"),
              AllOf(HasSubstr("window (state)"), HasSubstr("sunny (state, temperature, uv, seconds)")));
  EXPECT_THAT(refused("--set window.temperature=30"), HasSubstr("window (state)"));
  EXPECT_THAT(refused("--set window.state=1.5"), HasSubstr("[0, 1]"));
  EXPECT_THAT(refused("--set window.state=dark"), HasSubstr("number"));
  EXPECT_THAT(refused("--set window.state=nan"), HasSubstr("number"));
  EXPECT_THAT(refused("--set window=0.5"), HasSubstr("NAME.QUANTITY=VALUE"));
  EXPECT_THAT(refused("--set window.tint=0.5"), HasSubstr("can be set"));
  EXPECT_THAT(refused("--set sunny.temperature=-300"), HasSubstr("-273.15"));
  EXPECT_THAT(refused("--set window.state=0 --set window.state=1"), HasSubstr("set twice"));
  for (const char* computed : {"uv=5", "seconds=60", "temperature=40"}) {
    EXPECT_THAT(refused(fmt::format("--set sunny.state=0.5 --set sunny.{}", computed)),
                HasSubstr("given, or computed"));
    EXPECT_THAT(refused(fmt::format("--set sunny.{} --set sunny.state=0.5", computed)),
                HasSubstr("given, or computed"));
  }
  const CommandResult shown = run(fmt::format("{} '{}'", vitrail("inspect"), path("clear.vit")));
  EXPECT_THAT(shown.output, AllOf(HasSubstr("window"), HasSubstr("state 0, temperature 20 °C"),
                                  HasSubstr("state, temperature, uv, seconds")));
  EXPECT_EQ(run(fmt::format("{} '{}'", vitrail("verify"), path("clear.vit"))).status, 0);
}

TEST_F(SetGlazing, RefusesWhatIsDamaged) {
  std::filesystem::copy_file(directory / "clear.vit" / "glazing.json", directory / "glazing.json");
  const auto status = [&](const std::string& options) {
    return render("clear.vit", "d.film", options).status;
  };
  std::string text = read_bytes(directory / "glazing.json");
  text[text.size() / 2] = text[text.size() / 2] == '1' ? '2' : '1';
  write_text(directory / "clear.vit" / "glazing.json", text);
  EXPECT_EQ(status("--set window.state=1"), 3);
  EXPECT_EQ(run(fmt::format("{} '{}'", vitrail("verify"), path("clear.vit"))).status, 3);
  EXPECT_EQ(status(""), 0) << "who sets nothing does not need it";
  // Of another scene.
  partition("other", "\"float state\" 0.3", "");
  std::filesystem::copy_file(directory / "glazing.json", directory / "other.vit" / "glazing.json",
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_EQ(render("other.vit", "o.film", "--set window.state=1").status, 3);
}

TEST_F(SetGlazing, NoticesThatItIsLost) {
  std::filesystem::remove(directory / "clear.vit" / "glazing.json");
  const CommandResult verified = run(fmt::format("{} '{}'", vitrail("verify"), path("clear.vit")));
  EXPECT_EQ(verified.status, 3);
  EXPECT_THAT(verified.output, AllOf(HasSubstr("glazing.json"), HasSubstr("1 problem")));
  const CommandResult rendered = render("clear.vit", "d.film", "--set window.state=1");
  EXPECT_EQ(rendered.status, 3);
  EXPECT_THAT(rendered.output, HasSubstr("lost"));
  EXPECT_EQ(render("clear.vit", "d.film").status, 0) << "who sets nothing does not need it";
}

TEST_F(SetGlazing, ASceneWithoutSaysSo) {
  write_text(directory / "plain.pbrt",
             "WorldBegin\nLightSource \"infinite\" \"rgb L\" [1 1 1]\n"
             "Shape \"sphere\" \"float radius\" 1\n");
  ASSERT_EQ(
      run(fmt::format("{} '{}' -o '{}' --quiet", vitrail("partition"), path("plain.pbrt"), path("plain.vit")))
          .status,
      0);
  EXPECT_FALSE(std::filesystem::exists(directory / "plain.vit" / "glazing.json"));
  const CommandResult result = render("plain.vit", "p.film", "--set window.state=0.5");
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.output, HasSubstr("has no switchable glazing"));
}

}  // namespace
}  // namespace vitrail::test::set_glazing_test
