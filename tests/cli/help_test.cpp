// SPDX-License-Identifier: Apache-2.0
// What somebody reads and types before anything is rendered.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <regex>
#include <sstream>

#include "cli/help/verbs.h"
#include "tests/support/command.h"
#include "tests/support/paths.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::help_test {
namespace {

using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

// All options of a verb; without one, the front program's help.
std::string help_of(std::string_view verb, int columns = 80) {
  const std::string words = verb.empty() ? "help" : std::string(verb) + " --help-all";
  const CommandResult help = run(fmt::format("COLUMNS={} {}", columns, vitrail(words)));
  EXPECT_EQ(help.status, 0) << verb;
  return help.output;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::size_t columns_of(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

TEST(Help, FitsIntoTheTerminal) {
  for (const int columns : {60, 80, 100})
    for (const Verb& verb : verbs()) {
      const std::string help = help_of(verb.name, columns);
      const std::size_t options = help.find("\n\n", help.find("Examples:"));
      for (const std::string& line : lines_of(help.substr(options))) {
        // A label, or a word, that has no room in a line stays whole.
        const std::string word = line.substr(line.rfind(' ') + 1);
        const bool is_whole =
            line.starts_with("  -") || columns_of(word) + 26 > static_cast<std::size_t>(columns);
        EXPECT_TRUE(is_whole || columns_of(line) <= static_cast<std::size_t>(columns)) << line;
      }
    }
  EXPECT_LT(lines_of(help_of("render", 120)).size(), lines_of(help_of("render", 60)).size());
}

TEST(Help, HasNoNoiseOfTypes) {
  for (const Verb& verb : verbs()) {
    const std::string help = help_of(verb.name);
    EXPECT_THAT(help, Not(ContainsRegex("(INT|UINT|FLOAT|TEXT|BOOLEAN)[: ]"))) << verb.name;
    EXPECT_THAT(help, Not(HasSubstr("{false}"))) << verb.name;
  }
}

TEST(Help, StandsUnderHeadings) {
  std::vector<std::string> headings;
  for (const std::string& line : lines_of(help_of("render")))
    if (line.ends_with(':') && !line.starts_with(' ')) headings.push_back(line);
  EXPECT_THAT(headings,
              ElementsAre("Examples:", "What to render:", "How good:", "How long:", "On how many:",
                          "In how much memory:", "What to write:", "How to sample:", "Photon mapping:",
                          "How the scene is read:", "Changes to its meshes:", "Help:"));
  for (const Verb& verb : verbs())
    EXPECT_THAT(help_of(verb.name), Not(HasSubstr("Other options"))) << verb.name;
}

// It fits on two screens, has the output near its top, and says where the rest is.
TEST(Help, IsShortAndSaysWhereTheRestIs) {
  for (const Verb& verb : verbs()) {
    const std::string help = run(vitrail(std::string(verb.name) + " --help")).output;
    EXPECT_EQ(run(vitrail("help " + std::string(verb.name))).output, help);
    EXPECT_LE(lines_of(help).size(), 76u) << verb.name;
    const bool is_whole = lines_of(help_of(verb.name)).size() <= 80u;
    EXPECT_EQ(help.find(" options: vitrail " + std::string(verb.name) + " --help-all\n") == std::string::npos,
              is_whole);
  }
  const std::string help = run(vitrail("render --help")).output;
  EXPECT_LT(help.find("\n  -o, --output"), help.find("\n  --spp"));
  EXPECT_THAT(help, Not(HasSubstr("--photon-alpha")));
  EXPECT_THAT(help_of("render"), HasSubstr("--photon-alpha"));
}

// All options of the examples are those of their verb.
TEST(Help, HasExamplesThatCanBeTyped) {
  const std::regex option("(--?[a-z][a-z-]*)");
  const auto require_options = [&](const Example& example) {
    const std::string command(example.command);
    std::smatch verb;
    ASSERT_TRUE(std::regex_search(command, verb, std::regex("vitrail ([a-z]+)"))) << command;
    if (verb[1] == "help") return;
    const std::string help = help_of(verb.str(1)), rest = verb.suffix();
    const std::string options = help.substr(help.find("\n\n", help.find("Examples:")));
    for (std::sregex_iterator at(rest.begin(), rest.end(), option), end; at != end; ++at) {
      if (!at->prefix().str().ends_with(' ')) continue;
      EXPECT_THAT(options, ContainsRegex(at->str(1) + "[, \n]")) << command;
    }
  };
  for (const Verb& verb : verbs()) {
    EXPECT_EQ(verb.examples.size(), 3u) << verb.name;
    for (const Example& example : verb.examples) require_options(example);
  }
  for (const Example& example : first_steps()) require_options(example);
}

TEST(Help, SaysWhereToStart) {
  const std::string help = help_of("");
  EXPECT_THAT(help, HasSubstr("Start here:"));
  for (const Verb& verb : verbs())
    EXPECT_THAT(help, HasSubstr("\n  " + std::string(verb.name) + " ")) << verb.name;
  EXPECT_EQ(run(vitrail("-V")).output, run(vitrail("--version")).output);
  const std::string version = lines_of(run(vitrail("-V")).output).at(0);
  for (const Verb& verb : verbs())
    EXPECT_THAT(lines_of(run(vitrail(std::string(verb.name)) + " -V").output),
                ElementsAre(version, HasSubstr("licence of vitrail " + std::string(verb.name) + ": ")));
}

TEST(Options, TheLastOfOneCounts) {
  const TemporaryDirectory directory;
  const std::string scene = project_file("examples/cornell-box/cornell-box.pbrt");
  const std::string film = (directory / "a.film").string();
  const CommandResult made =
      run(fmt::format("{} '{}' -o '{}' --width 64 --spp 4 --height 9 --height 8 --spp 1 --width 8",
                      vitrail("render"), scene, film));
  ASSERT_EQ(made.status, 0) << made.output;
  const CommandResult held = run(fmt::format("{} '{}'", vitrail("inspect"), film));
  EXPECT_THAT(held.output, HasSubstr("8 × 8"));
}

class ManPage : public ::testing::TestWithParam<std::string> {};

std::string described(const std::string& verb, const std::string& writer) {
  std::string program = vitrail(verb);
  if (!verb.empty()) program.replace(program.find("' "), 2, "-").push_back('\'');
  return program + " --describe " + writer;
}

TEST_P(ManPage, IsSetWithoutWarnings) {
  if (run("command -v groff").status != 0) GTEST_SKIP() << "there is no groff";
  for (const int columns : {60, 78, 100}) {
    const CommandResult set =
        run(described(GetParam(), "man") +
            fmt::format(" | groff -Tutf8 -Kutf8 -man -ww -rLL={}n -P-c 2>&1 >/dev/null", columns));
    EXPECT_EQ(set.status, 0);
    EXPECT_EQ(set.output, "");
  }
  const std::string page = run(described(GetParam(), "man") + " | groff -Tutf8 -Kutf8 -man -P-cbou").output;
  EXPECT_THAT(page, HasSubstr("SYNOPSIS"));
  EXPECT_THAT(page, HasSubstr("EXIT STATUS"));
  EXPECT_THAT(page, HasSubstr(GetParam().empty() ? "vitrail-render(1)" : "--help"));
}

INSTANTIATE_TEST_SUITE_P(OfEachVerb, ManPage, ::testing::ValuesIn([] {
                           std::vector<std::string> names{""};
                           for (const Verb& verb : verbs()) names.emplace_back(verb.name);
                           return names;
                         }()),
                         [](const auto& one) { return one.param.empty() ? "front" : one.param; });

// What bash offers for the last of the words.
std::string offered(const std::string& words) {
  const std::string ask = fmt::format(
      "source <({}); COMP_WORDS=({}); COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1)); _vitrail; echo "
      "\"${{COMPREPLY[@]}}\"",
      vitrail("completion bash"), words);
  const TemporaryDirectory directory;
  std::ofstream(directory / "ask.sh") << ask;
  std::ofstream(directory / "room.pbrt") << "";
  const CommandResult answer = run(fmt::format("cd '{}' && bash ask.sh", directory.path().string()));
  EXPECT_EQ(answer.status, 0) << answer.output;
  return answer.output;
}

TEST(Completion, OfBash) {
  EXPECT_EQ(offered("vitrail ren"), "render\n");
  EXPECT_EQ(offered("vitrail help conv"), "convert\n");
  EXPECT_EQ(offered("vitrail render --targ"), "--target-error\n");
  EXPECT_EQ(offered("vitrail render --progress ''"), "auto bar lines json none\n");
  EXPECT_EQ(offered("vitrail render --quality = dr"), "draft\n");
  EXPECT_EQ(offered("vitrail render roo"), "room.pbrt\n");
  EXPECT_EQ(offered("vitrail render --stats roo"), "room.pbrt\n");
  EXPECT_EQ(offered("vitrail render --spp roo"), "\n");
  EXPECT_EQ(offered("vitrail develop --to"), "--tone\n");
}

TEST(Completion, OfFish) {
  if (run("command -v fish").status != 0) GTEST_SKIP() << "there is no fish";
  const auto offer = [](const char* line) {
    return run(fmt::format("{} | fish -c 'source - ; complete -C \"{}\"'", vitrail("completion fish"), line))
        .output;
  };
  EXPECT_THAT(offer("vitrail ren"), HasSubstr("render\trender a scene"));
  EXPECT_THAT(offer("vitrail help conv"), HasSubstr("convert"));
  EXPECT_THAT(offer("vitrail render --targ"), HasSubstr("--target-error\t"));
  EXPECT_THAT(offer("vitrail render --quality "), HasSubstr("draft"));
}

TEST(Completion, OfOtherShellsIsTheirLanguage) {
  for (const std::string shell : {"zsh", "fish"}) {
    const TemporaryDirectory directory;
    const std::string file = (directory / "completion").string();
    ASSERT_EQ(run(fmt::format("{} > '{}'", vitrail("completion " + shell), file)).status, 0);
    EXPECT_THAT(run("cat '" + file + "'").output, HasSubstr("target-error"));
    if (run("command -v " + shell).status != 0) continue;
    const CommandResult read = run(fmt::format("{} -n '{}'", shell, file));
    EXPECT_EQ(read.status, 0) << read.output;
    EXPECT_EQ(read.output, "");
  }
  EXPECT_EQ(run(vitrail("completion tcsh")).status, 2);
}

}  // namespace
}  // namespace vitrail::test::help_test
