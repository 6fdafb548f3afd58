// SPDX-License-Identifier: Apache-2.0
// CGAL adds -frounding-math to what links it: nothing else may be compiled with it.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/paths.h"

namespace vitrail::compile_flags_test {
namespace {

TEST(CompileFlags, RoundingMathStaysWhereCgalIs) {
  const std::filesystem::path root = test::source_dir();
  std::ifstream in(std::filesystem::path(test::bin_dir()).parent_path() / "compile_commands.json");
  int with_it = 0, without = 0;
  for (const auto& entry : nlohmann::json::parse(in)) {
    const std::string file =
        std::filesystem::path(entry.at("file").get<std::string>()).lexically_relative(root).string();
    const bool may = file.starts_with("partitioner/meshes/") || file.starts_with("importers/solids/") ||
                     file.find("tests/") != std::string::npos;
    const bool does = entry.at("command").get<std::string>().find("-frounding-math") != std::string::npos;
    EXPECT_TRUE(may || !does) << file;
    (does ? with_it : without) += 1;
  }
  EXPECT_GT(with_it, 5);
  EXPECT_GT(without, 100);
}

}  // namespace
}  // namespace vitrail::compile_flags_test
