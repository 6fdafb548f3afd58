// SPDX-License-Identifier: Apache-2.0
// JsonPlaces knows where the records of a glTF file stand in its JSON, which the parser does not keep.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "scene/system/diagnostics.h"

namespace vitrail::gltf {

class JsonPlaces {
 public:
  // Finds the elements of all arrays that lie at most two objects deep, as "nodes" and
  // "extensions/KHR_lights_punctual/lights" do: `array` is such a path. Throws Error with its place for JSON
  // that is nested deeper than `most_nested`. Other mistakes are left to the parser.
  JsonPlaces(std::string_view json, std::string file);

  // Returns line and column from 1, of the JSON; the file alone where there is no such element.
  SourceLocation at(const std::string& array, int index) const;

  // Returns where the base64 of that element's data URI is: its offset in the JSON and its length; {0, 0}
  // where it has none.
  std::pair<std::uint64_t, std::uint64_t> base64_of(const std::string& array, int index) const;

 private:
  struct Element {
    std::size_t begin = 0, end = 0;
    int line = 0, column = 0;
  };

  std::string_view json_;
  std::string file_;
  std::map<std::pair<std::string, int>, Element> elements_;
};

}  // namespace vitrail::gltf
