// SPDX-License-Identifier: Apache-2.0
#include "importers/assimp/read/fbx_facts.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <optional>

namespace vitrail::assimp {

namespace {

// In binary files a value is a letter and its bytes: 'L' of an integer of 8, 'I' of one of 4, 'S' of a text
// behind its length.
template <class T>
std::optional<T> value_at(std::string_view bytes, std::size_t at, char letter) {
  if (at >= bytes.size() || sizeof(T) >= bytes.size() - at || bytes[at] != letter) return {};
  T value{};
  std::memcpy(&value, bytes.data() + at + 1, sizeof value);
  return value;
}

std::string integer_of(std::int64_t id) { return {reinterpret_cast<const char*>(&id), sizeof id}; }

// The text up to its kind: "cam" of "cam\0\1Model" in binary files, of "Model::cam" in text.
std::string binary_name(std::string_view bytes, std::int64_t id) {
  const std::string head = "L" + integer_of(id) + "S";
  for (std::size_t at = bytes.find(head); at != std::string_view::npos; at = bytes.find(head, at + 1)) {
    const auto length = value_at<std::uint32_t>(bytes, at + 9, 'S');
    if (!length || *length > bytes.size() - at - 14) continue;
    const std::string_view text = bytes.substr(at + 14, *length);
    const std::size_t end = text.find(std::string_view("\0\1Model", 7));
    if (end != std::string_view::npos) return std::string(text.substr(0, end));
  }
  return {};
}

std::string text_name(std::string_view bytes, std::string_view id) {
  const std::string head = "Model: " + std::string(id) + ", \"Model::";
  const std::size_t at = bytes.find(head);
  if (at == std::string_view::npos) return {};
  const std::string_view rest = bytes.substr(at + head.size());
  return std::string(rest.substr(0, rest.find('"')));
}

std::string_view line_around(std::string_view bytes, std::size_t at) {
  const std::size_t begin = bytes.rfind('\n', at) + 1;
  return bytes.substr(begin, bytes.find('\n', at) - begin);
}

// Calls f(place) wherever the word stands.
template <class F>
void each(std::string_view bytes, std::string_view word, F&& f) {
  for (std::size_t at = bytes.find(word); at != std::string_view::npos; at = bytes.find(word, at + 1)) f(at);
}

// C: "OP",12,31, "LookAtProperty": 31 looks at 12.
void add_target_of_text(std::string_view bytes, std::size_t at, FbxFacts& facts) {
  const std::string_view line = line_around(bytes, at);
  const std::size_t first = line.find("\"OP\""), comma = line.find(',', first);
  if (first == std::string_view::npos || comma == std::string_view::npos) return;
  const std::size_t second = line.find(',', comma + 1);
  if (second == std::string_view::npos) return;
  const std::size_t third = line.find(',', second + 1);
  if (third == std::string_view::npos) return;
  const auto trimmed = [&](std::size_t from, std::size_t to) {
    while (from < to && line[from] == ' ') ++from;
    while (to > from && line[to - 1] == ' ') --to;
    return line.substr(from, to - from);
  };
  facts.targets.emplace(text_name(bytes, trimmed(second + 1, third)),
                        text_name(bytes, trimmed(comma + 1, second)));
}

void add_target_of_binary(std::string_view bytes, std::size_t at, FbxFacts& facts) {
  constexpr std::size_t text_head = 5, integer = 9;
  if (at < text_head + 2 * integer) return;
  const auto target = value_at<std::int64_t>(bytes, at - text_head - 2 * integer, 'L'),
             looker = value_at<std::int64_t>(bytes, at - text_head - integer, 'L');
  if (target && looker) facts.targets.emplace(binary_name(bytes, *looker), binary_name(bytes, *target));
}

// The last number of the property, 0 without one.
int choice_in_text(std::string_view line) {
  const std::size_t comma = line.rfind(',');
  int value = 0;
  if (comma == std::string_view::npos) return 0;
  std::string_view number = line.substr(comma + 1);
  while (number.starts_with(' ')) number.remove_prefix(1);
  std::from_chars(number.data(), number.data() + number.size(), value);
  return value;
}

int choice_in_binary(std::string_view bytes, std::size_t at) {
  constexpr std::size_t reach = 64;  // texts of the property's type, then its value
  for (std::size_t i = at; i < std::min(at + reach, bytes.size()); ++i) {
    const auto length = value_at<std::uint32_t>(bytes, i, 'S');
    if (length && *length < reach) {
      i += 4 + *length;
      continue;
    }
    if (const auto value = value_at<std::int32_t>(bytes, i, 'I')) return *value;
  }
  return 0;
}

}  // namespace

FbxFacts fbx_facts(std::string_view bytes) {
  constexpr std::string_view look_at = "LookAtProperty", projection = "CameraProjectionType",
                             aperture = "ApertureMode";
  const bool is_binary = bytes.starts_with("Kaydara FBX Binary");
  FbxFacts facts;
  int left = 1000;  // each looks for two names in all of the file
  each(bytes, look_at, [&](std::size_t at) {
    if (left-- <= 0) return;
    is_binary ? add_target_of_binary(bytes, at, facts) : add_target_of_text(bytes, at, facts);
  });
  facts.targets.erase("");
  const auto choice = [&](std::size_t at, std::string_view name) {
    return is_binary ? choice_in_binary(bytes, at + name.size()) : choice_in_text(line_around(bytes, at));
  };
  constexpr int orthographic = 1, vertical = 2;
  each(bytes, projection,
       [&](std::size_t at) { facts.has_orthographic_camera |= choice(at, projection) == orthographic; });
  // First the value of those that state none, then their own.
  each(bytes, aperture,
       [&](std::size_t at) { facts.has_vertical_angles = choice(at, aperture) == vertical; });
  return facts;
}

}  // namespace vitrail::assimp
