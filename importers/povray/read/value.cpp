// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/read/value.h"

namespace vitrail::pov {

const char* kind_of(const Value& value) {
  if (const auto* numbers = std::get_if<Numbers>(&value))
    return numbers->is_color ? "a colour" : numbers->terms == 1 ? "a number" : "a vector";
  constexpr const char* names[] = {
      "nothing",     "a number",   "a string",         "an array",        "a macro",  "a function",
      "a spline",    "an object",  "a pigment",        "a normal",        "a finish", "a texture",
      "an interior", "a material", "a camera",         "a sky_sphere",    "a fog",    "a media",
      "a map",       "a file",     "a transformation", "what is left out"};
  static_assert(std::size(names) == std::variant_size_v<Value>);
  return names[value.index()];
}

}  // namespace vitrail::pov
