// SPDX-License-Identifier: Apache-2.0
// POV-Ray scenes as a user reads and renders them: where included files are found, and what bounds a scene
// that is a program.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "tests/support/command.h"
#include "tests/support/paths.h"
#include "tests/support/ranks.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::povray_test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

const std::string view = "camera { location -5*z look_at 0 }\nlight_source { <2,4,-6> 1 }\n";

class Povray : public ::testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) const {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << text;
  }
  CommandResult run_verb(const std::string& verb, const std::string& words) const {
    return run(fmt::format("cd '{}' && timeout 60 {} {}", folder_.path().string(), vitrail(verb), words));
  }
  void expect_refused(const std::string& words, const std::string& what) const {
    const CommandResult result = run_verb("inspect", words);
    EXPECT_EQ(result.status, 3) << words << '\n' << result.output;
    EXPECT_THAT(result.output, HasSubstr(what));
  }
  // Refused with `tight`, a limit, and read with `wide`.
  void expect_limit(const std::string& tight, const std::string& wide) const {
    const std::string option = tight.substr(0, tight.find('='));
    expect_refused("a.pov " + tight, option + " raises that");
    const CommandResult read = run_verb("inspect", "a.pov --quiet " + wide);
    EXPECT_EQ(read.status, 0) << read.output;
  }
  TemporaryDirectory folder_;
};

TEST_F(Povray, FoldersOfIncludeAreSearchedAfterTheScenes) {
  write("a.pov", view + "#include \"parts/ball.inc\"\n#include \"own.inc\"\n");
  write("own.inc", "sphere { x, 0.5 }\n");
  write("first/own.inc", "#error \"the scene's own folder comes first\"\n");
  write("first/other.inc", "\n");
  write("second/parts/ball.inc", "sphere { 0, 1 }\n");
  expect_refused("a.pov --include first", "--include");
  const CommandResult both = run_verb("inspect", "a.pov --include first --include second --quiet");
  EXPECT_EQ(both.status, 0) << both.output;
  write("first/parts/ball.inc", "#error \"the first that is given\"\n");
  expect_refused("a.pov --include first --include second", "the first that is given");
}

// `render` hands what it was given to the partitioner.
TEST_F(Povray, RenderSearchesTheSameFolders) {
  write("a.pov", view + "#include \"ball.inc\"\n");
  write("parts/ball.inc", "sphere { 0, 1 pigment { color rgb 1 } }\n");
  const std::string words = "a.pov --width 8 --height 8 --spp 1 --quiet -o a.png";
  EXPECT_EQ(run_verb("render", words).status, 3);
  const CommandResult found = run_verb("render", words + " --include parts --no-cache");
  EXPECT_EQ(found.status, 0) << found.output;
  const CommandResult partitioned = run_verb("partition", "a.pov -o a.vit --quiet --include parts");
  ASSERT_EQ(partitioned.status, 0) << partitioned.output;
  const CommandResult late = run_verb("render", "a.vit --include parts -o b.png");
  EXPECT_EQ(late.status, 2);
  EXPECT_THAT(late.output, HasSubstr("give --include=parts to partition"));
}

TEST_F(Povray, ALoopThatDoesNotEnd) {
  write("a.pov", view + "#while (1) #declare I = 1; #end\n");
  expect_refused("a.pov --token-limit 100000", "more than 100000 tokens are read; does a loop end?");
  write("a.pov", view + "#for (I, 1, 1000) #declare J = I; #end\nsphere { 0, 1 }\n");
  expect_limit("--token-limit=5000", "--token-limit=10000");
}

TEST_F(Povray, AMacroThatCallsItself) {
  write("a.pov", view + "#macro Down(N) #if (N > 0) Down(N - 1) #end #end Down(500)\nsphere { 0, 1 }\n");
  expect_limit("--call-limit=100", "--call-limit=1000");
}

TEST_F(Povray, BracketsWithinEachOther) {
  write("a.pov", view + fmt::format("sphere {{ 0, {}1{} }}\n", std::string(300, '('), std::string(300, ')')));
  expect_limit("--nesting-limit=200", "--nesting-limit=400");
  EXPECT_EQ(run_verb("inspect", "a.pov --nesting-limit 100000").status, 2);
  // As deep as is allowed, on the usual stack.
  std::string unions, ends;
  for (int i = 0; i < 990; ++i) unions += "union { sphere { 0, 1 } ", ends += "}";
  write("a.pov", view + unions + ends + "\n");
  expect_limit("--nesting-limit=900", "--nesting-limit=1000");
}

TEST_F(Povray, ATextThatGrows) {
  write("a.pov", view +
                     "#fopen F \"a.txt\" write\n#for (I, 1, 1000) #write (F, \"sixteen letters \") #end\n"
                     "#fclose F\nsphere { 0, 1 }\n");
  expect_limit("--write-limit=8K", "--write-limit=16K");
  EXPECT_FALSE(fs::exists(folder_ / "a.txt"));
}

class PovrayExamples : public Povray, public ::testing::WithParamInterface<const char*> {};

// Each is read, and nothing of it is dropped.
TEST_P(PovrayExamples, AreReadWhole) {
  const CommandResult read = run_verb(
      "inspect", fmt::format("'{}/examples/povray/{}.pov' --json > report.json", source_dir(), GetParam()));
  ASSERT_EQ(read.status, 0) << read.output;
  const nlohmann::json report = read_json(folder_ / "report.json");
  EXPECT_GT(report["triangles"], 0);
  for (const auto& note : report["not_exact"]) EXPECT_EQ(note["fidelity"], "approximated") << note;
}

INSTANTIATE_TEST_SUITE_P(, PovrayExamples, ::testing::Values("room", "carved", "patterns"),
                         [](const auto& one) { return std::string(one.param); });

// The lamp of the room is a ball around a light: the floor below it is lit.
TEST_F(Povray, TheLampOfTheRoomShines) {
  const auto mean = [&](const std::string& scene) {
    const CommandResult made = run_verb(
        "render",
        fmt::format("{} --width 16 --height 12 --spp 4 --crop 0,16,9,12 --quiet -o a.film --force", scene));
    EXPECT_EQ(made.status, 0) << made.output;
    const CommandResult seen = run_verb("inspect", "a.film --json > film.json");
    EXPECT_EQ(seen.status, 0) << seen.output;
    return read_json(folder_ / "film.json")["mean_luminance"].get<double>();
  };
  const std::string room = project_file("examples/povray/room.pov");
  std::ifstream in(room);
  std::string dark{std::istreambuf_iterator<char>(in), {}};
  const std::string lamp = "color rgb <2.2, 2.0, 1.7>";
  ASSERT_NE(dark.find(lamp), std::string::npos);
  write("dark.pov", dark.replace(dark.find(lamp), lamp.size(), "color rgb 0"));
  EXPECT_GT(mean("'" + room + "'"), 3 * mean("dark.pov"));
}

// The film of one domain, too, where two ranks hold an eighth of 64.
TEST_F(Povray, TheFilmOfOneDomainInAnEighthOfTheMemory) {
  const std::string scene = project_file("examples/povray/carved.pov");
  const auto render = [&](int domains, int ranks, const std::string& more) {
    const std::string bundle = fmt::format("{}.vit", domains);
    if (!fs::exists(folder_ / bundle)) {
      EXPECT_EQ(run_verb("partition", fmt::format("'{}' -o {} --domains {} --quiet", scene, bundle, domains))
                    .status,
                0);
    }
    const CommandResult done = run(fmt::format(
        "cd '{}' && {} {} -o a.film --force --width 96 --height 72 --spp 2 --quiet --stats stats.json {}",
        folder_.path().string(), vitrail_on(ranks, "render"), bundle, more));
    EXPECT_EQ(done.status, 0) << done.output;
    return done.status == 0 ? read_json(folder_ / "stats.json") : nlohmann::json();
  };
  const nlohmann::json one = render(1, 1, ""), all = render(64, 2, "");
  ASSERT_FALSE(one.is_null() || all.is_null());
  std::uint64_t bytes = 0, largest = 0;
  for (const auto& entry : fs::directory_iterator(folder_ / "64.vit/domains"))
    bytes += entry.file_size(), largest = std::max(largest, entry.file_size());
  ASSERT_GT(bytes / 8, largest);
  const nlohmann::json little = render(64, 2, fmt::format("--domain-memory {}", bytes / 8));
  ASSERT_FALSE(little.is_null());
  EXPECT_EQ(all["film_hash"], one["film_hash"]);
  EXPECT_EQ(little["film_hash"], one["film_hash"]);
  EXPECT_GT(little["evictions"], 0) << "all domains had room";
}

}  // namespace
}  // namespace vitrail::test::povray_test
