// SPDX-License-Identifier: Apache-2.0
// docs/reference/statistics.md has each key of --stats, and no other.
#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "tests/docs/pages.h"
#include "tests/support/command.h"
#include "tests/support/paths.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::statistics_test {
namespace {

// Below the heading "## HEADING", the first cell of each row.
std::set<std::string> documented(const std::string& heading) {
  static const std::regex key("`([a-z_]+)`");
  std::set<std::string> keys;
  bool is_below = false;
  for (const PageLine& line : lines_of(project_file("docs/reference/statistics.md"))) {
    if (line.text.starts_with("## ")) is_below = line.text == "## " + heading;
    if (!is_below || !line.text.starts_with("| `")) continue;
    const std::string cell = line.text.substr(0, line.text.find('|', 1));
    for (std::sregex_iterator it(cell.begin(), cell.end(), key), end; it != end; ++it) keys.insert((*it)[1]);
  }
  return keys;
}

std::set<std::string> keys_of(const nlohmann::json& stats) {
  std::set<std::string> keys;
  for (const auto& [key, value] : stats.items()) keys.insert(key);
  return keys;
}

TEST(Statistics, OfPartitionAndRenderAreDocumented) {
  const TemporaryDirectory folder;
  const std::string scene = project_file("examples/cornell-box/cornell-box.pbrt");
  const std::string bundle = (folder / "box.vit").string(), p = (folder / "p.json").string(),
                    r = (folder / "r.json").string();
  ASSERT_EQ(run(vitrail("partition " + scene + " -o " + bundle + " --stats " + p)).status, 0);
  ASSERT_EQ(run(vitrail("render " + bundle + " -o " + (folder / "box.film").string() +
                        " --width 16 --target-error 10 --stats " + r))
                .status,
            0);
  EXPECT_EQ(documented("vitrail partition"), keys_of(read_json(p)));
  EXPECT_EQ(documented("vitrail render"), keys_of(read_json(r)));
}

}  // namespace
}  // namespace vitrail::test::statistics_test
