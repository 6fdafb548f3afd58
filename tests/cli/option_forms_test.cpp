// SPDX-License-Identifier: Apache-2.0
// Every option of every verb, in each form in which people type it. The inputs do not exist, so that a verb
// ends when it has understood its words. A sixth of the options; with VITRAIL_LONG_TESTS all.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <regex>
#include <sstream>

#include "cli/help/verbs.h"
#include "tests/support/command.h"
#include "tests/support/long_tests.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::option_forms_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

struct TypedOption {
  std::string short_name, name, value;
};

class OptionForms : public ::testing::TestWithParam<std::string> {
 protected:
  CommandResult type(const std::string& words) const {
    static const std::map<std::string, std::string> inputs{
        {"compare", "a.exr b.exr"}, {"convert", "a.pbrt b.xml"}, {"sky", "nowhere"}, {"spectrum", ""}};
    const auto found = inputs.find(GetParam());
    return run(fmt::format("cd '{}' && timeout 60 {} {} {}", directory_.path().string(), vitrail(GetParam()),
                           found == inputs.end() ? "nowhere.vit" : found->second, words));
  }
  // The words of both do the same.
  void require_same(const std::string& one, const std::string& other) const {
    const CommandResult a = type(one), b = type(other);
    EXPECT_EQ(a.status, b.status) << one << " and " << other;
    EXPECT_EQ(a.output, b.output) << one << " and " << other;
  }
  void require_refused(const std::string& words, const std::string& what) const {
    const CommandResult refused = type(words);
    EXPECT_EQ(refused.status, 2) << words << ": " << refused.output;
    EXPECT_THAT(refused.output, StartsWith("vitrail: " + what)) << words;
  }
  // As the help lists them, those with values.
  std::vector<TypedOption> options() const {
    std::istringstream help(run(fmt::format("COLUMNS=120 {} --help-all", vitrail(GetParam()))).output);
    const std::regex form(R"(  (?:(-[a-zA-Z]), )?(--[a-z0-9-]+)(?:, --[a-z0-9-]+)* ([^ ]+)(?:  .*)?)");
    std::vector<TypedOption> found;
    std::smatch label;
    for (std::string line; std::getline(help, line);)
      if (std::regex_match(line, label, form)) found.push_back({label[1], label[2], label[3]});
    return found;
  }

  const TemporaryDirectory directory_;
};

// What an option with such a value takes.
std::string example_of(const std::string& value) {
  static const std::map<std::string, std::string> examples{
      {"N", "3"}, {"X", ".5"}, {"SECONDS", "90"}, {"SIZE", "512M"}, {"PIXELS", "20"}, {"R,G,B", ".5,.5,.5"}};
  if (const auto known = examples.find(value); known != examples.end()) return known->second;
  if (value.find("0,X1") != std::string::npos) return "0,8,0,8";
  if (value.starts_with("X,Y,Z")) return "0,1,-3,0,0,0";
  return value.find_first_of("abcdefghijklmnopqrstuvwxyz") != std::string::npos
             ? value.substr(0, value.find('|'))
             : "word";
}

bool is_list(const std::string& value) {
  return value.find("0,X1") != std::string::npos || value.starts_with("X,Y,Z") || value == "R,G,B";
}

TEST_P(OptionForms, AreUnderstood) {
  const std::vector<TypedOption> all = options();
  ASSERT_FALSE(all.empty());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto& [short_name, name, value] = all[i];
    const std::string example = example_of(value);
    if (is_list(value)) {
      const std::string apart = std::regex_replace(example, std::regex(","), " "),
                        both = std::regex_replace(example, std::regex(","), ", ");
      require_same(name + " " + apart, name + "=" + example);
      require_same(name + " " + both, name + " " + example);
      require_same(name + "=" + apart, name + "=" + example);
    }
    if (!short_name.empty()) {
      require_same(short_name + " " + example, name + "=" + example);
      require_same(short_name + "=" + example, name + "=" + example);
      require_same(short_name + example, name + "=" + example);
    }
    if (!are_long() && i % 6 > 0) continue;
    require_same(name + " " + example, name + "=" + example);
    require_refused(name, name + " needs a value: ");
    require_refused(name + "=", name + " needs a value: ");
    if (value != "N" && value != "X" && value != "SECONDS" && value != "PIXELS") continue;
    require_refused(name + " 4.5q", name + " takes a");
    require_same(name + " -2", name + "=-2");
  }
  require_same("-- ", "");
}

INSTANTIATE_TEST_SUITE_P(Verbs, OptionForms, ::testing::ValuesIn([] {
                           std::vector<std::string> names;
                           for (const Verb& verb : verbs()) names.emplace_back(verb.name);
                           return names;
                         }()),
                         [](const auto& verb) { return verb.param; });

// A number in the place of another, and a time in every unit.
TEST(OptionValues, SayWhatTheyTake) {
  const auto said = [](const std::string& words) { return run(vitrail(words)).output; };
  EXPECT_THAT(said("render nowhere.vit --spp 4.5"), HasSubstr("--spp takes a whole number, not 4.5 (see"));
  EXPECT_THAT(said("render nowhere.vit --fov wide"), HasSubstr("--fov takes a number, not wide (see"));
  for (const char* time : {"90", "90s", "1.5m", "1h30m", "2d", "1h0m10s"})
    EXPECT_THAT(said(fmt::format("render nowhere.vit --time {}", time)), HasSubstr("no such")) << time;
  for (const char* time : {"m", "1x", "1h30", "-1m", "0s", "''"})
    EXPECT_THAT(said(fmt::format("render nowhere.vit --time {}", time)), HasSubstr("--time")) << time;
  EXPECT_THAT(said("render nowhere.vit --time 1x"), HasSubstr("or a time such as 90s, 15m, 1h30m or 2d"));
  EXPECT_THAT(said("render nowhere.vit -o="), HasSubstr("--output needs a value: FILE"));
  EXPECT_THAT(said("render nowhere.vit --launcher -o=a"), Not(HasSubstr("--output")));
  EXPECT_THAT(said("render"), HasSubstr("SCENE|BUNDLE is missing"));
  EXPECT_THAT(said("render a.pbrt -- b.pbrt"), HasSubstr("'b.pbrt' is one argument too many"));
}

}  // namespace
}  // namespace vitrail::test::option_forms_test
