// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "cli/common/sizes.h"
#include "cli/inspect/inspect.h"

namespace vitrail {

namespace {

std::string words(std::string key) {
  std::replace(key.begin(), key.end(), '_', ' ');
  return key;
}

bool is_table(const Report& j) { return j.is_array() && !j.empty() && j[0].is_object(); }

// Paths in the scene's folder are shorter without it.
struct Words {
  std::string folder;  // with its last slash; empty: none
  std::string shortened(std::string text) const {
    const auto begins_a_path = [&](std::size_t at) {
      return at == 0 || std::string_view(" \"'(=:,").find(text[at - 1]) != std::string_view::npos;
    };
    if (!folder.empty())
      for (std::size_t at = 0; (at = text.find(folder, at)) != std::string::npos;)
        begins_a_path(at) ? void(text.erase(at, folder.size())) : void(++at);
    return text;
  }
  std::string of(const std::string& key, const Report& j) const;
};

std::string Words::of(const std::string& key, const Report& j) const {
  if (j == "") return "none";
  if (j.is_string()) return shortened(j.get<std::string>());
  if (j.is_boolean()) return j.get<bool>() ? "yes" : "no";
  if (j.is_number_integer() && (key == "bytes" || key.ends_with("_bytes")))
    return format_bytes(j.get<std::uint64_t>());
  if (j.is_number_float()) return fmt::format("{:.6g}", j.get<double>());
  if (j.is_null()) return key == "max_depth" ? "no limit" : "-";
  if (j.is_object() && j.contains("needed"))
    return j["needed"].get<bool>() ? "yes: " + j["why"].get<std::string>() : "no";
  if (!j.is_array()) return j.dump();
  const char* between = key == "pixels" || key == "extent" ? " × " : " ";
  std::string all;
  for (const Report& item : j) all += (all.empty() ? "" : between) + of("", item);
  return j.empty() ? "none" : all;
}

// Displayed length of UTF-8: continuation bytes take no room.
std::size_t width_of(const std::string& s) {
  return static_cast<std::size_t>(
      std::count_if(s.begin(), s.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

// Records with the keys of the first one, as columns.
std::string table(const Report& rows, const std::string& indent, const Words& in_words) {
  std::vector<std::vector<std::string>> cells(1);
  for (const auto& [key, value] : rows[0].items()) cells[0].push_back(words(key));
  for (const Report& row : rows) {
    auto& line = cells.emplace_back();
    for (const auto& [key, value] : row.items()) line.push_back(in_words.of(key, value));
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

std::string nested(const Report& report, const std::string& indent, const Words& in_words) {
  std::string text;
  const std::string deeper(indent.size() + 2, ' ');
  for (const auto& [key, value] : report.items()) {
    if (key == "summary") continue;  // comes first
    text += fmt::format("{}{}:", indent, words(key));
    if (value.is_object() && !value.contains("needed")) {
      text += fmt::format("\n{}", nested(value, deeper, in_words));
    } else if (is_table(value)) {
      text += fmt::format("\n{}", table(value, deeper, in_words));
    } else {
      text += fmt::format(" {}\n", in_words.of(key, value));
    }
  }
  return text;
}

}  // namespace

std::string to_text(const Report& report, const std::filesystem::path& folder) {
  std::string text;
  if (const auto summary = report.find("summary"); summary != report.end())
    text = summary_text(*summary) + "\n";
  return text + nested(report, "", {folder.empty() ? "" : folder.string() + "/"});
}

}  // namespace vitrail
