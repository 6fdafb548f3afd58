// SPDX-License-Identifier: Apache-2.0
#include "cli/help/help_text.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

namespace vitrail {

namespace {

constexpr std::size_t text_column = 26;

// Characters of well-formed UTF-8; each takes a column in our texts.
std::size_t columns_of(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

// A word that is longer than a line stays whole.
std::vector<std::string> wrapped(std::string_view text, std::size_t width) {
  std::vector<std::string> lines(1);
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string_view word = text.substr(at, end - at);
    at = end + 1;
    if (word.empty()) continue;
    if (!lines.back().empty() && columns_of(lines.back()) + 1 + columns_of(word) > width)
      lines.emplace_back();
    if (!lines.back().empty()) lines.back() += ' ';
    lines.back() += word;
  }
  return lines;
}

}  // namespace

std::string entry_text(std::string_view label, std::string_view text, std::size_t column, std::size_t width) {
  std::string entry = "  ";
  entry += label;
  std::size_t reached = columns_of(entry);
  for (const std::string& line : wrapped(text, width - column)) {
    if (reached + 2 > column) entry += '\n', reached = 0;
    entry += std::string(column - reached, ' ') + line;
    reached = width;
  }
  return entry + '\n';
}

std::string example_text(std::span<const Example> examples, std::size_t width) {
  std::string text;
  for (const Example& example : examples)
    text += "  " + std::string(example.command) + "\n" + entry_text("", example.effect, 6, width);
  return text;
}

namespace {

std::string group_text(const std::string& heading, std::span<const CommandOption> options,
                       std::size_t width) {
  std::string text = '\n' + heading + ":\n";
  for (const CommandOption& option : options)
    text += entry_text(option.joined_names(), option.full_text(), text_column, width);
  return text;
}

std::string head_text(const Command& command, std::size_t width) {
  std::string text;
  for (const std::string& line : wrapped(command.name + ": " + command.summary, width)) text += line + '\n';
  text += '\n';
  std::string indent;
  for (const std::string& line : wrapped("usage: " + command.usage(), width - 2)) {
    text += indent + line + '\n';
    indent = "  ";
  }
  if (!command.examples.empty()) text += "\nExamples:\n" + example_text(command.examples, width);
  return text;
}

}  // namespace

std::string help_text(const Command& command, std::size_t width) {
  std::string text = head_text(command, width);
  for (const CommandGroup& group : command.groups) text += group_text(group.heading, group.options, width);
  return text;
}

std::string short_help_text(const Command& command, std::size_t width) {
  if (command.everyday.empty()) return help_text(command, width);
  return head_text(command, width) + group_text("What nearly everyone needs", command.everyday, width) +
         fmt::format("\nAll {} options: {} --help-all\n", command.all().size(), command.name);
}

std::size_t help_width() {
  constexpr std::size_t usual = 80, least = 40, most = 120;
  std::size_t width = 0;
  winsize size{};
  if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0) width = size.ws_col;
  const char* stated = std::getenv("COLUMNS");
  if (width == 0 && stated) width = std::strtoul(stated, nullptr, 10);
  return std::clamp(width == 0 ? usual : width, least, most);
}

}  // namespace vitrail
