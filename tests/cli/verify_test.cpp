// SPDX-License-Identifier: Apache-2.0
// What a user sees of a bundle that a disk or a copy has damaged.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/command.h"
#include "tests/support/paths.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::verify_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class VerifyProgram : public ::testing::Test {
 protected:
  void SetUp() override {
    const CommandResult made =
        run(fmt::format("{} '{}/examples/cornell-box/cornell-box.pbrt' -o '{}' --domains 4 --quiet",
                        vitrail("partition"), source_dir(), bundle.string()));
    ASSERT_EQ(made.status, 0) << made.output;
  }
  CommandResult verify(const std::string& options = "") const {
    return run(fmt::format("{} '{}' {}", vitrail("verify"), bundle.string(), options));
  }
  void damage(const std::string& name) const {
    std::fstream file(bundle / name, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(-70, std::ios::end);
    file.put('\x5a').put('\x17').put('\x33');
  }
  TemporaryDirectory directory;
  std::filesystem::path bundle = directory / "box.vit";
};

TEST_F(VerifyProgram, WholeBundle) {
  const CommandResult result = verify();
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_THAT(result.output, HasSubstr("box.vit: whole; 8 files"));
  EXPECT_EQ(verify("--quiet --threads 1").output, "");
  std::ofstream(bundle / "notes.txt") << "made on Monday";
  EXPECT_EQ(verify().status, 0);
  EXPECT_THAT(verify().output, HasSubstr("notes.txt: warning"));
}

TEST_F(VerifyProgram, DamagedBundle) {
  damage("domains/000001.dom");
  damage("domains/000003.dom");
  damage("manifest.json");
  const CommandResult result = verify();
  EXPECT_EQ(result.status, 3) << result.output;
  for (const char* text :
       {"\ndomains/000003.dom: ", "domains/000001.dom: ", "\nmanifest.json: ", "3 problems in 3 places"})
    EXPECT_THAT(result.output, HasSubstr(text));
  const CommandResult json = verify("--json --quiet");
  EXPECT_EQ(json.status, 3);
  const auto report = nlohmann::json::parse(json.output);
  EXPECT_EQ(report["whole"], false);
  EXPECT_EQ(report["problems"].size(), 3u);
  EXPECT_EQ(report["files"], 8);
  EXPECT_GT(report["bytes_per_s"], 0);
}

TEST_F(VerifyProgram, InspectSaysTheSame) {
  const auto inspect = [&](const std::filesystem::path& file) {
    return run(fmt::format("{} '{}'", vitrail("inspect"), file.string()));
  };
  EXPECT_EQ(inspect(bundle).status, 0);
  EXPECT_THAT(inspect(bundle).output, HasSubstr("ghost free: yes"));
  const CommandResult domain = inspect(bundle / "domains/000001.dom");
  EXPECT_EQ(domain.status, 0) << domain.output;
  for (const char* text : {"version: 5", "optional features: pieces", "clusters", "depth: ", "lower: "})
    EXPECT_THAT(domain.output, HasSubstr(text));
  damage("domains/000001.dom");
  EXPECT_EQ(inspect(bundle / "domains/000001.dom").status, 3);
  const CommandResult damaged = inspect(bundle);
  EXPECT_EQ(damaged.status, 3);
  EXPECT_THAT(damaged.output, HasSubstr("domains/000001.dom: "));
  EXPECT_THAT(damaged.output, Not(HasSubstr("all correct")));
}

TEST_F(VerifyProgram, NotABundle) {
  const CommandResult result =
      run(fmt::format("{} '{}'", vitrail("verify"), (directory / "none.vit").string()));
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(result.output, HasSubstr("none.vit"));
  EXPECT_EQ(run(vitrail("verify")).status, 2);
}

}  // namespace
}  // namespace vitrail::test::verify_test
