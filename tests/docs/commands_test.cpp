// SPDX-License-Identifier: Apache-2.0
// The documentation's commands are the programs': every option that it names is there, and the pages of
// options are what the programs say of themselves.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "cli/help/verbs.h"
#include "tests/docs/pages.h"
#include "tests/support/command.h"
#include "tests/support/paths.h"

namespace vitrail::test::commands_test {
namespace {

namespace fs = std::filesystem;

std::string markdown_of(std::string_view verb) {
  const CommandResult page = run(vitrail(fmt::format("{} --describe markdown", verb)));
  EXPECT_EQ(page.status, 0) << verb << ": " << page.output;
  return page.output;
}

class OptionPage : public ::testing::TestWithParam<std::string> {};

TEST_P(OptionPage, IsWhatTheProgramSays) {
  const fs::path file = fmt::format("{}/docs/reference/options/{}.md", source_dir(), GetParam());
  const std::string made = markdown_of(GetParam());
  if (std::getenv("VITRAIL_WRITE_DOCS")) std::ofstream(file) << made;
  std::ifstream in(file);
  const std::string kept((std::istreambuf_iterator<char>(in)), {});
  EXPECT_EQ(kept, made) << "If that is meant: VITRAIL_WRITE_DOCS=1 test_docs";
}

std::vector<std::string> verb_names() {
  std::vector<std::string> names;
  for (const Verb& verb : verbs()) names.emplace_back(verb.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(OfEachVerb, OptionPage, ::testing::ValuesIn(verb_names()),
                         [](const auto& test) { return test.param; });

// "-o" and "--output" of each verb.
std::map<std::string, std::set<std::string>> options_by_verb() {
  static const std::regex name(R"(`(--?[a-z][a-z-]*)[ `])", std::regex::icase);
  std::map<std::string, std::set<std::string>> options;
  for (const std::string& verb : verb_names()) {
    const std::string page = markdown_of(verb);
    for (std::sregex_iterator it(page.begin(), page.end(), name), end; it != end; ++it)
      options[verb].insert((*it)[1]);
  }
  return options;
}

// Code lines, one that ends in \ with the next, without their comments and quoted words.
std::vector<PageLine> commands_of(const fs::path& page) {
  static const std::regex quoted("'[^']*'");
  std::vector<PageLine> commands;
  bool goes_on = false;
  for (PageLine line : lines_of(page)) {
    if (!line.is_code) continue;
    line.text = std::regex_replace(line.text.substr(0, line.text.find(" #")), quoted, "TEXT");
    const bool ends_open = line.text.ends_with("\\");
    if (ends_open) line.text.pop_back();
    if (goes_on && !commands.empty())
      commands.back().text += " " + line.text;
    else
      commands.push_back(line);
    goes_on = ends_open;
  }
  return commands;
}

TEST(Commands, NameOptionsThatAreThere) {
  static const std::regex call(R"((?:^|[ (])vitrail ([a-z]+) ([^|;]*))"),
      option(R"((?:^| )(--?[a-z][a-z-]*))");
  const auto options = options_by_verb();
  int count = 0;
  for (const fs::path& page : pages())
    for (const PageLine& line : commands_of(page)) {
      std::smatch found;
      if (!std::regex_search(line.text, found, call) || !options.contains(found[1])) continue;
      const std::string words = found[2];
      for (std::sregex_iterator it(words.begin(), words.end(), option), end; it != end; ++it, ++count)
        EXPECT_TRUE(options.at(found[1]).contains((*it)[1]))
            << name_of(page) << ":" << line.number << ": vitrail " << found[1] << " has no " << (*it)[1];
    }
  EXPECT_GT(count, 300);
}

}  // namespace
}  // namespace vitrail::test::commands_test
