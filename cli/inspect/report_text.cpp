// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "cli/inspect/inspect.h"

namespace vitrail {

namespace {

std::string words(std::string key) {
  std::replace(key.begin(), key.end(), '_', ' ');
  return key;
}

bool is_table(const Report& j) { return j.is_array() && !j.empty() && j[0].is_object(); }

std::string scalar(const Report& j) {
  if (j.is_string()) return j.get<std::string>();
  if (j.is_boolean()) return j.get<bool>() ? "yes" : "no";
  if (j.is_number_float()) return fmt::format("{:.6g}", j.get<double>());
  if (j.is_null()) return "none";
  if (!j.is_array()) return j.dump();
  std::string all;
  for (const Report& item : j) all += fmt::format("{}{}", all.empty() ? "" : " ", scalar(item));
  return j.empty() ? "none" : all;
}

// Displayed length of UTF-8: continuation bytes take no room.
std::size_t width_of(const std::string& s) {
  return static_cast<std::size_t>(
      std::count_if(s.begin(), s.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

// Records with the keys of the first one, as columns.
std::string table(const Report& rows, const std::string& indent) {
  std::vector<std::vector<std::string>> cells(1);
  for (const auto& [key, value] : rows[0].items()) cells[0].push_back(words(key));
  for (const Report& row : rows) {
    auto& line = cells.emplace_back();
    for (const auto& [key, value] : row.items()) line.push_back(scalar(value));
  }
  std::vector<std::size_t> width(cells[0].size(), 0);
  for (const auto& line : cells)
    for (std::size_t i = 0; i < std::min(line.size(), width.size()); ++i)
      width[i] = std::max(width[i], width_of(line[i]));
  std::string text;
  for (const auto& line : cells) {
    text += indent;
    for (std::size_t i = 0; i < line.size(); ++i) {
      text += line[i];
      if (i + 1 < line.size() && i < width.size()) text.append(width[i] - width_of(line[i]) + 2, ' ');
    }
    text += "\n";
  }
  return text;
}

std::string nested(const Report& report, const std::string& indent) {
  std::string text;
  const std::string deeper(indent.size() + 2, ' ');
  for (const auto& [key, value] : report.items()) {
    text += fmt::format("{}{}:", indent, words(key));
    if (value.is_object()) {
      text += fmt::format("\n{}", nested(value, deeper));
    } else if (is_table(value)) {
      text += fmt::format("\n{}", table(value, deeper));
    } else {
      text += fmt::format(" {}\n", scalar(value));
    }
  }
  return text;
}

}  // namespace

std::string to_text(const Report& report) { return nested(report, ""); }

}  // namespace vitrail
