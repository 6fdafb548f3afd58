// SPDX-License-Identifier: Apache-2.0
#include "cli/help/describe.h"

#include <algorithm>
#include <iterator>
#include <sstream>

#include "cli/help/headings.h"

namespace vitrail {

namespace {

constexpr const char* general_heading = "Help";
constexpr const char* other_heading = "Other options";

bool takes_many(const CLI::Option& option) {
  return option.get_items_expected_max() > option.get_type_size_max();
}

// "INT:INT in [1 - 4096]" → "INT": CLI11 adds what its checks require.
std::string type_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  return type.substr(0, type.find(':'));
}

// "TEXT:{bar,lines,none}" → bar, lines, none.
std::vector<std::string> choices_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t first = type.find(":{");
  if (first == std::string::npos || !type.ends_with('}')) return {};
  std::vector<std::string> choices;
  std::istringstream list(type.substr(first + 2, type.size() - first - 3));
  for (std::string choice; std::getline(list, choice, ',');) choices.push_back(choice);
  return choices;
}

std::string joined(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : "|") + word;
  return line;
}

std::string usual_value(const std::string& type) {
  if (type == "INT" || type == "UINT") return "N";
  if (type == "FLOAT") return "X";
  return "WORD";
}

bool is_file(const std::string& value) {
  return value == "FILE" || value == "FOLDER" || value == "IMAGE" || value == "REFERENCE" ||
         value == "FILM" || value == "SCENE" || value == "BUNDLE" || value == "SCENE|BUNDLE";
}

CommandOption described(const CLI::Option& option, const std::string& value) {
  CommandOption told;
  told.is_argument = option.get_positional();
  for (const std::string& name : option.get_snames()) told.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) told.names.push_back("--" + name);
  if (told.is_argument) told.names.push_back(option.get_name(true));
  told.text = option.get_description();
  if (option.get_items_expected_max() == 0) return told;
  told.choices = choices_of(option);
  told.value = !value.empty()          ? value
               : !told.choices.empty() ? joined(told.choices)
                                       : usual_value(type_of(option));
  told.initial = option.get_default_str();
  told.takes_file = is_file(told.value);
  told.may_repeat = takes_many(option);
  return told;
}

const CLI::Option* find(const CLI::App& app, const std::string& name) {
  for (const CLI::Option* option : app.get_options())
    if (option->check_lname(name) || option->get_name(true) == name) return option;
  return nullptr;
}

bool is_hidden(const CLI::Option& option) { return option.get_group().empty(); }

bool is_general(const CLI::App& app, const CLI::Option* option) {
  return option == app.get_help_ptr() || option == app.get_help_all_ptr() || option == app.get_version_ptr();
}

}  // namespace

Command describe(const CLI::App& app) {
  Command command;
  command.name = app.get_name();
  std::vector<const CLI::Option*> told;
  const auto add = [&](CommandGroup& group, const CLI::Option* option, const std::string& value) {
    if (is_hidden(*option) || std::ranges::find(told, option) != told.end()) return;
    group.options.push_back(described(*option, value));
    told.push_back(option);
  };
  for (const Heading& heading : headings(command.verb())) {
    CommandGroup group{std::string(heading.title), {}};
    std::istringstream words{std::string(heading.options)};
    for (std::string word; words >> word;) {
      const std::size_t equals = word.find('=');
      const CLI::Option* option = find(app, word.substr(0, equals));
      if (option) add(group, option, equals == std::string::npos ? "" : word.substr(equals + 1));
    }
    if (!group.options.empty()) command.groups.push_back(group);
  }
  CommandGroup others{other_heading, {}}, general{general_heading, {}};
  for (const CLI::Option* option : app.get_options())
    add(is_general(app, option) ? general : others, option, "");
  for (const CommandGroup& group : {others, general})
    if (!group.options.empty()) command.groups.push_back(group);
  const std::vector<CommandOption> all = command.all();
  std::istringstream everyday{std::string(everyday_options(command.verb()))};
  for (std::string word; everyday >> word;)
    std::ranges::copy_if(all, std::back_inserter(command.everyday), [&](const CommandOption& o) {
      return std::ranges::find(o.names, o.is_argument ? word : "--" + word) != o.names.end();
    });
  if (const Verb* verb = find_verb(command.verb()))
    command.summary = verb->summary, command.examples = verb->examples;
  return command;
}

void let_the_last_count(CLI::App& app) {
  for (CLI::Option* option : app.get_options())
    if (!option->get_positional() && option->get_items_expected_max() == 1)
      option->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
}

}  // namespace vitrail
