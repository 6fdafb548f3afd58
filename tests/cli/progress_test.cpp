// SPDX-License-Identifier: Apache-2.0
// What a user sees while a program works: on terminals of several widths, and in a log.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "scene/system/progress_line.h"
#include "tests/support/command.h"
#include "tests/support/paths.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/terminal.h"

namespace vitrail::test::progress_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

std::size_t columns_in(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count_if(text, [](char c) { return (c & 0xc0) != 0x80; }));
}

const ProgressNews news{0.437, "render", 12, {"7 of 16 samples a pixel", "2.10 Mray/s", "3 to 5 krays wait"}};

TEST(ProgressLine, FitsItsTerminal) {
  for (int columns = 1; columns <= 220; ++columns)
    EXPECT_LE(columns_in(without_colors(line_of(news, columns, columns % 2 == 0))),
              static_cast<std::size_t>(std::max(columns - 1, 5)))
        << columns;
  EXPECT_EQ(line_of(news, 45, false), "render   44 %  12 s left  [######          ]");
  EXPECT_EQ(line_of(news, 80, false),
            "render   44 %  12 s left  [#############                   ]  2.10 Mray/s");
  EXPECT_THAT(line_of(news, 200, false),
              HasSubstr("]  7 of 16 samples a pixel  2.10 Mray/s  3 to 5 krays wait"));
}

TEST(ProgressLine, ShowsNamesOfScenesAsTheyMayBe) {
  EXPECT_THAT(line_of({0.5, "\033[2Jevil", -1, {}}, 80, false), StartsWith("\\u001b[2Jevil"));
}

// Lines of a terminal are written over, so between two returns there is never more than fits.
void expect_one_line(const std::string& output, std::size_t columns) {
  std::size_t begin = 0;
  for (std::size_t end; (end = output.find_first_of("\r\n", begin)) != std::string::npos; begin = end + 1) {
    std::string part = without_colors(output.substr(begin, end - begin));
    if (part.starts_with("\033[K")) part = part.substr(3);
    if (part.find('%') != std::string::npos && part.find('[') != std::string::npos) {
      EXPECT_LT(columns_in(part), columns) << part;
      EXPECT_EQ(output[end], '\r') << "it is written over";
    }
  }
}

TEST(Progress, OnTerminalsOfThreeWidths) {
  const TemporaryDirectory directory;
  for (const unsigned short columns : std::array<unsigned short, 3>{45, 80, 200}) {
    const std::string output =
        run_on_terminal(fmt::format("{} '{}/examples/cornell-box/cornell-box.pbrt' -o '{}' --spp 20000 "
                                    "--crop 0,64,0,64 --threads 1 --time 1",
                                    vitrail("render"), source_dir(), (directory / "x.png").string()),
                        columns);
    EXPECT_THAT(output,
                AllOf(HasSubstr("render "), HasSubstr(" % "), HasSubstr("\033[32m"), HasSubstr("x.png: ")));
    expect_one_line(output, columns);
  }
}

TEST(Progress, WithoutColorsWhereTheyAreNotWanted) {
  const TemporaryDirectory directory;
  const std::string output =
      run_on_terminal(fmt::format("NO_COLOR=1 {} '{}/examples/cornell-box/cornell-box.pbrt' -o '{}' --crop "
                                  "0,64,0,64 --threads 1 --time .5",
                                  vitrail("render"), source_dir(), (directory / "x.png").string()),
                      80);
  EXPECT_THAT(output, AllOf(HasSubstr("render "), Not(HasSubstr("\033[32m"))));
}

TEST(Progress, TheReportOfPartitionBeginsALine) {
  const TemporaryDirectory directory;
  const std::string output =
      run_on_terminal(fmt::format("{} '{}/examples/cornell-box/cornell-box.pbrt' -o '{}' --domains 4",
                                  vitrail("partition"), source_dir(), (directory / "x.vit").string()),
                      80);
  const std::size_t report = output.find("x.vit: ");
  ASSERT_NE(report, std::string::npos) << output;
  const std::string line = output.substr(0, report).substr(output.substr(0, report).find_last_of("\r\n") + 1);
  EXPECT_EQ(line.find('%'), std::string::npos) << line;
}

TEST(Progress, TheLastEventSaysThatTheRenderWasStopped) {
  const TemporaryDirectory directory;
  const CommandResult stopped =
      run(fmt::format("timeout --preserve-status -s INT 3 {} '{}/examples/cornell-box/cornell-box.pbrt' -o "
                      "'{}' --threads 1 --spp 20000 "
                      "--progress json --quiet 2>&1 | tail -n 2",
                      vitrail("render"), source_dir(), (directory / "x.png").string()));
  EXPECT_THAT(stopped.output, AllOf(HasSubstr("\"event\":\"end\""), HasSubstr("\"ending\":\"interrupted\"")));
  EXPECT_THAT(stopped.output,
              AllOf(HasSubstr("x.png.partial holds the samples so far"), HasSubstr("x.png shows it")));
}

TEST(Progress, ALogHasALineSoon) {
  const TemporaryDirectory directory;
  const CommandResult done =
      run(fmt::format("{} '{}/examples/cornell-box/cornell-box.pbrt' -o '{}' --spp 65536 --crop 0,64,0,64 "
                      "--threads 1 --time 4",
                      vitrail("render"), source_dir(), (directory / "x.png").string()));
  EXPECT_EQ(done.status, 0) << done.output;
  EXPECT_THAT(done.output,
              AllOf(HasSubstr("vitrail: rendering "), HasSubstr("vitrail: render "), HasSubstr(" left, ")));
  EXPECT_THAT(done.output, ::testing::ContainsRegex(" left, [0-9]+ of 65536 samples a pixel"));
  EXPECT_THAT(done.output, Not(HasSubstr("\033")));
}

}  // namespace
}  // namespace vitrail::test::progress_test
