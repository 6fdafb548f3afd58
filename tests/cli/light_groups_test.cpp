// SPDX-License-Identifier: Apache-2.0
// `render --light-groups` and `develop --groups`, as they are typed.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/command.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::light_groups_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class LightGroupsTyped : public ::testing::Test {
 protected:
  LightGroupsTyped() {
    std::ofstream(directory_ / "a.pbrt") << R"(LookAt 0 0 4  0 0 0  0 1 0
Camera "perspective" "float fov" 40
Sampler "independent" "integer pixelsamples" 4
Film "rgb" "integer xresolution" 16 "integer yresolution" 16
WorldBegin
LightSource "point" "point3 from" [1 0 2] "rgb I" [2 3 4]
LightSource "point" "point3 from" [-1 0 2] "rgb I" [1 1 1]
LightSource "infinite" "rgb L" [.1 .2 .3]
Shape "sphere"
)";
  }
  std::string path(const std::string& name) const { return (directory_ / name).string(); }
  CommandResult render(const std::string& more) const {
    return run(
        fmt::format("{} {} -o {} --force {}", vitrail("render"), path("a.pbrt"), path("a.film"), more));
  }
  CommandResult develop(const std::string& picture, const std::string& more) const {
    return run(fmt::format("{} {} -o {} {}", vitrail("develop"), path("a.film"), path(picture), more));
  }

  TemporaryDirectory directory_;
};

TEST_F(LightGroupsTyped, AreRenderedInspectedAndWeighed) {
  const CommandResult made = render("--light-group 'points=point-*' --light-groups");
  ASSERT_EQ(made.status, 0) << made.output;
  const CommandResult told = run(fmt::format("{} --json {}", vitrail("inspect"), path("a.film")));
  EXPECT_EQ(nlohmann::json::parse(told.output).at("light_groups"), (nlohmann::json{"points", "infinite-3"}));
  ASSERT_EQ(develop("all.exr", "").status, 0);
  ASSERT_EQ(develop("same.exr", "--groups points=1").status, 0);
  ASSERT_EQ(develop("less.exr", "--groups points=.2:.3:.4,infinite-3=0").status, 0);
  const auto compare = [&](const char* a, const char* b) {
    return run(fmt::format("{} {} {} --fail-above 1e-9", vitrail("compare"), path(a), path(b))).status;
  };
  EXPECT_EQ(compare("same.exr", "all.exr"), 0);
  EXPECT_EQ(compare("less.exr", "all.exr"), 1);
}

TEST_F(LightGroupsTyped, WhatCannotBeIsRefused) {
  const auto expect_refused = [](const CommandResult& refused, int status, const std::string& words) {
    EXPECT_EQ(refused.status, status) << refused.output;
    EXPECT_THAT(refused.output, HasSubstr(words));
  };
  expect_refused(render("--light-group lamps=lamp"), 2, "there is infinite-3, point-1, point-2");
  expect_refused(render("--light-group a=point-1 --light-group b='point*'"), 2, "point-1 is in a and in b");
  expect_refused(render("--light-group a"), 2, "NAME=LIGHT");
  expect_refused(render("--light-groups --integrator photon"), 2, "--integrator path");
  ASSERT_EQ(render("").status, 0);
  expect_refused(develop("a.png", "--groups a=1"), 3, "render with --light-groups");
  ASSERT_EQ(render("--light-groups").status, 0);
  expect_refused(develop("a.png", "--groups a=1"), 3, "point-1, point-2, infinite-3");
  expect_refused(develop("a.png", "--groups point-1=x"), 2, "NAME=WEIGHT");
  expect_refused(develop("a.exr", "--groups point-1=1 --variance"), 2, "--groups");
}

}  // namespace
}  // namespace vitrail::test::light_groups_test
