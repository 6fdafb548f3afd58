// SPDX-License-Identifier: Apache-2.0
#include "cli/help/command.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace vitrail {

std::string CommandOption::joined_names() const {
  if (is_argument) return value + (may_repeat ? "..." : "");
  const std::string joined = fmt::format("{}", fmt::join(names, ", "));
  return value.empty() ? joined : joined + " " + value;
}

std::string CommandOption::full_text() const {
  return initial.empty() ? text : fmt::format("{} [default: {}]", text, initial);
}

std::string Command::usage() const {
  if (verb().empty()) return name + " VERB ...";
  std::string line = name + " [OPTION]...";
  for (const CommandOption& option : all())
    if (option.is_argument) line += " " + option.joined_names();
  return line;
}

std::string Command::program() const {
  std::string joined = name;
  std::ranges::replace(joined, ' ', '-');
  return joined;
}

std::string Command::verb() const {
  const std::size_t space = name.find(' ');
  return space == std::string::npos ? "" : name.substr(space + 1);
}

std::vector<CommandOption> Command::all() const {
  std::vector<CommandOption> options;
  for (const CommandGroup& group : groups) std::ranges::copy(group.options, std::back_inserter(options));
  return options;
}

}  // namespace vitrail
