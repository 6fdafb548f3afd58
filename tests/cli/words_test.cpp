// SPDX-License-Identifier: Apache-2.0
// What users are told where something is not as they meant it: once, with the right names, and with what is
// here.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/partitioned_box.h"

namespace vitrail::test::words_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class Words : public PartitionedBox {
 protected:
  Words() : PartitionedBox(1) {}
  CommandResult say(const std::string& verb, const std::string& words) const {
    return run(fmt::format("cd '{}' && {} {}", directory_.path().string(), vitrail(verb), words));
  }
};

TEST_F(Words, FilmsOfOneSeedAreBothNamed) {
  ASSERT_EQ(say("render", "box.vit -o a.film --crop 0,8,0,8 --spp 2").status, 0);
  std::filesystem::copy_file(directory_ / "a.film", directory_ / "b.film");
  const CommandResult refused = say("develop", "a.film b.film -o c.png");
  EXPECT_EQ(refused.status, 3);
  EXPECT_THAT(refused.output, HasSubstr("it has seed 0, as "));
  EXPECT_THAT(refused.output, AllOf(HasSubstr("a.film"), HasSubstr("b.film")));
}

TEST_F(Words, AReasonIsSaidOnce) {
  std::ofstream(directory_ / "bad.pbrt") << "WorldBegin\nShape \"sphere\n";
  const CommandResult refused = say("render", "bad.pbrt -o a.png");
  EXPECT_EQ(refused.status, 3);
  EXPECT_THAT(refused.output, AllOf(HasSubstr("bad.pbrt:2:"), Not(HasSubstr("vitrail-partition"))));
}

TEST_F(Words, WhatALibraryThrowsIsWithoutItsNumbers) {
  std::ofstream(directory_ / "p.json") << R"({"domains": []})";
  const CommandResult refused = say("plan", "box.vit --profile p.json");
  EXPECT_EQ(refused.status, 3) << refused.output;
  EXPECT_THAT(refused.output, Not(HasSubstr("json.exception")));
}

TEST_F(Words, OptionsOfOthersNameOurs) {
  EXPECT_THAT(say("render", "box.vit -s 1").output, HasSubstr("here it is --camera N"));
  EXPECT_THAT(say("render", "box.vit --write-partial-images").output, HasSubstr("render --preview PICTURE"));
}

TEST_F(Words, TooLittleMemoryComesWithWhatIsEnough) {
  constexpr int n = 400;
  {
    std::ofstream obj(directory_ / "grid.obj");
    for (int i = 0; i < n * n; ++i) obj << fmt::format("v {} {} {}\n", i % n, i / n, (i % n) * (i / n) % 7);
    for (int i = 0; i < n * (n - 1); ++i)
      if (i % n < n - 1) obj << fmt::format("f {} {} {} {}\n", i + 1, i + 2, i + n + 2, i + n + 1);
  }
  for (const char* little : {"24M", "32M", "40M"}) {
    const CommandResult refused =
        say("partition", fmt::format("grid.obj -o c.vit --quiet --memory {}", little));
    ASSERT_EQ(refused.status, 4) << refused.output;
    const std::size_t at = refused.output.find("try --memory ");
    ASSERT_NE(at, std::string::npos) << refused.output;
    const std::string words = refused.output.substr(at + 4, refused.output.find('M', at + 13) + 1 - at - 4);
    EXPECT_EQ(say("partition", "grid.obj -o c.vit --quiet " + words).status, 0)
        << words << " was told to be enough";
  }
}

}  // namespace
}  // namespace vitrail::test::words_test
