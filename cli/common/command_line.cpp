// SPDX-License-Identifier: Apache-2.0
#include "cli/common/command_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>

#include "cli/common/unknown_options.h"
#include "cli/help/describe.h"

namespace vitrail {

namespace {

bool has_name(const CommandOption& option, std::string_view name) {
  return std::ranges::find(option.names, name) != option.names.end();
}

// "X0,X1,Y0,Y1", but not "NAME=WEIGHT,…".
bool takes_numbers(const CommandOption& option) {
  return option.value.find(',') != std::string::npos &&
         std::ranges::all_of(option.value, [](unsigned char c) { return std::isalnum(c) || c == ','; });
}

// "-3", "4," or "1,2": what may be a part of such a list.
bool is_part_of_numbers(const std::string& word) {
  return word.find_first_of("0123456789") != std::string::npos &&
         word.find_first_not_of("0123456789.,+-eE") == std::string::npos && !word.starts_with("--");
}

const CommandOption* find(const std::vector<CommandOption>& options, std::string_view name) {
  const auto found = std::ranges::find_if(options, [&](const auto& o) { return has_name(o, name); });
  return found == options.end() ? nullptr : &*found;
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

std::string about_value(const CLI::Option& option, const CommandOption* told) {
  const std::string name = option.get_name();
  const std::string text = option.results().empty() ? "" : option.results().back();
  const std::string is_wanted = wanted(option, text);
  if (is_wanted.empty()) return {};
  const bool is_time = told && told->value == "SECONDS";
  return fmt::format("{} takes {}{}, not {}", name, is_wanted,
                     is_time ? " of seconds, or a time such as 90s, 15m, 1h30m or 2d" : "", text);
}

}  // namespace

std::vector<std::string> as_parsed(const CLI::App& app, const std::vector<std::string>& typed) {
  const std::vector<CommandOption> options = describe(app).all();
  std::vector<std::string> words;
  for (std::size_t i = 0; i < typed.size(); ++i) {
    const std::string& word = typed[i];
    const bool is_short = word.size() > 3 && word[0] == '-' && word[1] != '-' && word[2] == '=';
    if (const CommandOption* option = is_short ? find(options, word.substr(0, 2)) : nullptr;
        option && !option->value.empty()) {
      words.insert(words.end(), {word.substr(0, 2), word.substr(3)});
      continue;
    }
    words.push_back(word);
    const std::size_t equals = word.find('=');
    const CommandOption* option = word == "--" ? nullptr : find(options, word.substr(0, equals));
    if (!option || option->is_argument || !takes_numbers(*option)) continue;
    std::string list = equals == std::string::npos ? "" : word.substr(equals + 1);
    while (i + 1 < typed.size() && is_part_of_numbers(typed[i + 1]))
      list += (list.empty() || list.ends_with(',') ? "" : ",") + typed[++i];
    if (equals != std::string::npos) words.back() = word.substr(0, equals + 1) + list;
    if (equals == std::string::npos && !list.empty()) words.back() += "=" + list;
  }
  return words;
}

std::string about(const CLI::App& app, const CLI::ParseError& error) {
  const std::string message = error.what();
  if (dynamic_cast<const CLI::ExtrasError*>(&error)) return about_unexpected(app);
  const std::vector<CommandOption> options = describe(app).all();
  if (dynamic_cast<const CLI::RequiredError*>(&error)) {
    const std::string name = message.substr(0, message.find(' '));
    const CommandOption* told = find(options, name);
    return fmt::format("{} is missing", told && !told->value.empty() ? told->value : name);
  }
  const CLI::Option* option = option_of(app, message);
  if (!option) return message;
  const CommandOption* told = find(options, option->get_name());
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error))
    return fmt::format("{} needs a value{}", option->get_name(), told ? ": " + told->value : "");
  const std::string value = about_value(*option, told);
  return value.empty() ? message : value;
}

}  // namespace vitrail
