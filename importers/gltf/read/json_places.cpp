// SPDX-License-Identifier: Apache-2.0
#include "importers/gltf/read/json_places.h"

#include <fmt/format.h>

#include <vector>

#include "scene/records/nesting_limits.h"

namespace vitrail::gltf {

namespace {

// An object or array that is open.
struct Level {
  bool is_array = false;
  std::string path;  // "" for what is not looked for
  std::string key;   // the last one of an object
  int index = 0;     // of an array's element
};

constexpr std::size_t deepest_path = 4;  // root, extensions, KHR_lights_punctual, lights

}  // namespace

JsonPlaces::JsonPlaces(std::string_view json, std::string file) : json_(json), file_(std::move(file)) {
  std::vector<Level> open;
  std::vector<std::pair<std::string, int>>
      element_of_level;  // beside `open`: the element that it is, or {"", 0}
  int line = 1;
  std::size_t line_begin = 0;
  bool is_value = true;  // the next string is one, no key
  for (std::size_t i = 0; i < json.size(); ++i) {
    switch (json[i]) {
      case '\n':
        ++line, line_begin = i + 1;
        break;
      case '"': {
        const std::size_t begin = i + 1;
        for (++i; i < json.size() && json[i] != '"'; ++i)
          if (json[i] == '\\') ++i;
        if (!is_value && !open.empty() && i <= json.size() && open.size() <= deepest_path)
          open.back().key = json.substr(begin, i - begin);
        break;
      }
      case ':':
        is_value = true;
        break;
      case ',':
        if (open.empty()) break;
        is_value = open.back().is_array;
        ++open.back().index;
        break;
      case '{':
      case '[': {
        const int column = static_cast<int>(i - line_begin) + 1;
        if (open.size() >= most_nested)
          throw Error(fmt::format("more than {} objects and arrays within one another", most_nested),
                      {file_, line, column});
        Level level{json[i] == '[', "", "", 0};
        std::pair<std::string, int> element;
        if (!open.empty() && open.size() <= deepest_path) {
          const Level& outer = open.back();
          if (!outer.is_array && (open.size() == 1 || !outer.path.empty()))
            level.path = (outer.path.empty() ? "" : outer.path + "/") + outer.key;
          if (outer.is_array && !outer.path.empty()) {
            element = {outer.path, outer.index};
            elements_[element] = {i, json.size(), line, column};
          }
        }
        is_value = level.is_array;
        open.push_back(std::move(level));
        element_of_level.push_back(std::move(element));
        break;
      }
      case '}':
      case ']':
        if (open.empty()) break;
        if (!element_of_level.back().first.empty()) elements_[element_of_level.back()].end = i + 1;
        open.pop_back(), element_of_level.pop_back();
        is_value = false;
        break;
      default:
        break;
    }
  }
}

SourceLocation JsonPlaces::at(const std::string& array, int index) const {
  const auto found = elements_.find({array, index});
  if (found == elements_.end()) return {file_};
  return {file_, found->second.line, found->second.column};
}

std::pair<std::uint64_t, std::uint64_t> JsonPlaces::base64_of(const std::string& array, int index) const {
  const auto found = elements_.find({array, index});
  if (found == elements_.end()) return {0, 0};
  const Element& e = found->second;
  const std::string_view text = json_.substr(e.begin, e.end - e.begin);
  constexpr std::string_view mark = ";base64,";
  const std::size_t uri = text.find("\"data:"),
                    at = text.find(mark, uri == std::string_view::npos ? text.size() : uri);
  if (at == std::string_view::npos) return {0, 0};
  const std::size_t begin = at + mark.size(), end = text.find_first_of("\"=", begin);
  if (end == std::string_view::npos) return {0, 0};
  return {e.begin + begin, end - begin};
}

}  // namespace vitrail::gltf
