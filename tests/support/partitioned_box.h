// SPDX-License-Identifier: Apache-2.0
// For tests of programs: a folder with the Cornell box as a bundle, box.vit.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/support/command.h"
#include "tests/support/paths.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test {

class PartitionedBox : public ::testing::Test {
 protected:
  explicit PartitionedBox(int domains) : domains_(domains) {}
  void SetUp() override {
    const CommandResult made =
        run(fmt::format("{} '{}/examples/cornell-box/cornell-box.pbrt' -o '{}' --domains {} --quiet",
                        vitrail("partition"), source_dir(), path("box.vit"), domains_));
    ASSERT_EQ(made.status, 0) << made.output;
  }
  std::string path(const std::string& name) const { return (directory_ / name).string(); }

  TemporaryDirectory directory_;

 private:
  int domains_;
};

}  // namespace vitrail::test
