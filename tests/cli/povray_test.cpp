// SPDX-License-Identifier: Apache-2.0
// POV-Ray scenes as a user reads and renders them: where included files are found, and what bounds a scene
// that is a program.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/command.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test {
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

}  // namespace
}  // namespace vitrail::test
