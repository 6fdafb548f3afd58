// SPDX-License-Identifier: Apache-2.0
#include "cli/common/command_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>

#include "cli/common/unknown_options.h"
#include "cli/help/describe.h"
#include "cli/help/headings.h"

namespace vitrail {

namespace {

// What the help calls the value of an option, "" where it leaves that to the type.
std::string_view value_name(const CLI::App& app, const CLI::Option& option) {
  const std::string& program = app.get_name();
  for (const Heading& heading : headings(std::string_view(program).substr(program.find(' ') + 1)))
    for (std::string_view rest = heading.options; !rest.empty();) {
      const std::string_view word = rest.substr(0, rest.find(' '));
      rest.remove_prefix(std::min(word.size() + 1, rest.size()));
      const std::size_t equals = word.find('=');
      const std::string name(word.substr(0, equals));
      if (option.check_lname(name) || (option.get_positional() && option.get_name(true) == name))
        return equals == std::string_view::npos ? std::string_view() : word.substr(equals + 1);
    }
  return {};
}

// "X0,X1,Y0,Y1", but not "NAME=WEIGHT,…".
bool takes_numbers(std::string_view value) {
  return value.find(',') != std::string::npos &&
         std::ranges::all_of(value, [](unsigned char c) { return std::isalnum(c) || c == ','; });
}

// "-3", "4," or "1,2": what may be a part of such a list.
bool is_part_of_numbers(const std::string& word) {
  return word.find_first_of("0123456789") != std::string::npos &&
         word.find_first_not_of("0123456789.,+-eE") == std::string::npos && !word.starts_with("--");
}

bool is_whole(const std::string& text) {
  long long number = 0;
  return CLI::detail::lexical_cast(text, number);
}

bool is_number(const std::string& text) {
  double number = 0;
  return CLI::detail::lexical_cast(text, number);
}

// What the type of an option's value asks for, where the text is no such thing.
std::string wanted(const CLI::Option& option, const std::string& text) {
  const std::string type = option.get_type_name();
  if ((type.starts_with("INT") || type.starts_with("UINT")) && !is_whole(text)) return "a whole number";
  return type.starts_with("FLOAT") && !is_number(text) ? "a number" : "";
}

// Of an option's own message, "--spp: …" or "Could not convert: --spp = …".
const CLI::Option* option_of(const CLI::App& app, const std::string& message) {
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : {option->get_name(), option->get_name(true)})
      if (message.starts_with(name + ":") || message.starts_with("Could not convert: " + name + " = "))
        return option;
  return nullptr;
}

std::string about_value(const CLI::Option& option, std::string_view value) {
  const std::string name = option.get_name();
  const std::string text = option.results().empty() ? "" : option.results().back();
  const std::string is_wanted = wanted(option, text);
  if (is_wanted.empty()) return {};
  const bool is_time = value == "SECONDS";
  return fmt::format("{} takes {}{}, not {}", name, is_wanted,
                     is_time ? " of seconds, or a time such as 90s, 15m, 1h30m or 2d" : "", text);
}

}  // namespace

std::vector<std::string> as_parsed(const CLI::App& app, const std::vector<std::string>& typed) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < typed.size(); ++i) {
    const std::string& word = typed[i];
    words.push_back(word);
    if (!word.starts_with('-') || word == "--") continue;
    const std::size_t equals = word.find('=');
    const CLI::Option* option = app.get_option_no_throw(word.substr(0, equals));
    if (!option || option->get_items_expected_max() == 0) continue;
    if (equals == 2 && word[1] != '-') {
      words.back() = word.substr(0, equals);
      if (word.size() > equals + 1) words.push_back(word.substr(equals + 1));
      continue;
    }
    if (i + 1 == typed.size()) continue;
    if (!is_part_of_numbers(typed[i + 1]) || !takes_numbers(value_name(app, *option))) {
      if (equals == std::string::npos && option->get_items_expected_min() == 1) words.push_back(typed[++i]);
      continue;
    }
    std::string list = equals == std::string::npos ? "" : word.substr(equals + 1);
    while (i + 1 < typed.size() && is_part_of_numbers(typed[i + 1]))
      list += (list.empty() || list.ends_with(',') ? "" : ",") + typed[++i];
    words.back() = word.substr(0, equals) + "=" + list;
  }
  return words;
}

std::string about(const CLI::App& app, const CLI::ParseError& error) {
  std::string message = error.what();
  if (dynamic_cast<const CLI::ExtrasError*>(&error)) return about_unexpected(app);
  if (dynamic_cast<const CLI::RequiredError*>(&error)) {
    const std::string name = message.substr(0, message.find(' '));
    const CLI::Option* option = app.get_option_no_throw(name);
    const std::string_view value = option ? value_name(app, *option) : "";
    return fmt::format("{} is missing", value.empty() || !option->get_positional() ? name : value);
  }
  const CLI::Option* option = option_of(app, message);
  if (!option) return message;
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error)) {
    const std::vector<CommandOption> all = describe(app).all();
    const auto told = std::ranges::find_if(all, [&](const CommandOption& o) {
      return std::ranges::find(o.names, option->get_name()) != o.names.end();
    });
    return fmt::format("{} needs a value{}", option->get_name(), told == all.end() ? "" : ": " + told->value);
  }
  const std::string value = about_value(*option, value_name(app, *option));
  return value.empty() ? message : value;
}

}  // namespace vitrail
