// SPDX-License-Identifier: Apache-2.0
#include "cli/help/markdown_page.h"

#include <fmt/format.h>

namespace vitrail {

namespace {

// A cell of a table: a bar would end it, and browsers read what stands between < and >.
std::string cell(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '|' || c == '<' || c == '*' || c == '_') out += '\\';
    out += c;
  }
  return out;
}

std::string choices_of(const CommandOption& option) {
  if (option.choices.empty()) return "";
  std::string text;
  for (const std::string& choice : option.choices) text += (text.empty() ? "One of `" : ", `") + choice + "`";
  return text + ". ";
}

std::string row(const CommandOption& option) {
  // The value lists the choices where they are few; a bar in code would still end the cell.
  const std::string value = option.choices.empty() ? option.value : "";
  std::string names;
  if (option.is_argument)
    names = fmt::format("*{}*", cell(option.joined_names()));
  else
    for (const std::string& name : option.names)
      names += (names.empty() ? "`" : ", `") + name + (value.empty() ? "" : " " + value) + "`";
  std::string what = choices_of(option) + cell(option.text);
  if (!option.initial.empty()) what += fmt::format(" (default: `{}`)", option.initial);
  return fmt::format("| {} | {} |\n", names, what);
}

}  // namespace

std::string markdown_page(const Command& command) {
  std::string page = fmt::format("# {}\n\n{}.\n\n    {}\n", command.name, command.summary, command.usage());
  for (const CommandGroup& group : command.groups) {
    page += fmt::format("\n## {}\n\n| option | what it does |\n|---|---|\n", group.heading);
    for (const CommandOption& option : group.options) page += row(option);
  }
  if (command.examples.empty()) return page;
  page += "\n## Examples\n";
  for (const Example& example : command.examples)
    page += fmt::format("\n`{}`  \n{}\n", example.command, example.effect);
  return page;
}

}  // namespace vitrail
