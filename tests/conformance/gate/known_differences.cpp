// SPDX-License-Identifier: Apache-2.0
#include "tests/conformance/gate/known_differences.h"

#include <array>

namespace vitrail::test {

namespace {

// Scenes whose name has all of `words`, which are separated by " & ".
struct Known {
  std::string_view words, reason;
};
constexpr std::array known{
    Known{"bump on a blend", "bumps of wrappers are not yet their leaves'"},
    Known{"normal map on a blend", "bumps of wrappers are not yet their leaves'"},
    Known{"bumpmap on a blend", "bumps of wrappers are not yet their leaves'"},
    Known{"bump on a mask", "bumps of wrappers are not yet their leaves'"},
    Known{"bumpmap on a mask", "bumps of wrappers are not yet their leaves'"},
    Known{"blend with nothing", "coverage is not yet the shape's"},
    Known{"blend with null", "coverage is not yet the shape's"},
    Known{"blend of a mask", "coverage is not yet the shape's"},
    Known{"mask in a blend", "coverage is not yet the shape's"},
    Known{"mask of a mask", "coverage is not yet the shape's"},
    Known{"null area", "coverage is not yet the shape's"},
    Known{"nothing / & object shines", "coverage is not yet the shape's"},
    Known{"nothing / & blend", "coverage is not yet the shape's"},
    Known{"null / & blend", "coverage is not yet the shape's"},
    Known{"null / & object shines", "coverage is not yet the shape's"},
    Known{"colour image", "which channel a number is does not yet stand in the record"},
    Known{"colour bitmap", "which channel a number is does not yet stand in the record"},
    Known{"image area", "images of area lights are not yet turned"},
    Known{"without uv", "the uv of a mesh is not yet explicit"},
    Known{"Mitsuba projector", "Mitsuba's flat white is read as D65, which is said"},
};

bool has_all(const std::string& name, std::string_view words) {
  while (!words.empty()) {
    const std::size_t end = words.find(" & ");
    if (name.find(words.substr(0, end)) == std::string::npos) return false;
    words = end == std::string_view::npos ? "" : words.substr(end + 3);
  }
  return true;
}

}  // namespace

std::string_view known_difference(const std::string& name) {
  for (const Known& k : known)
    if (has_all(name, k.words)) return k.reason;
  return "";
}

}  // namespace vitrail::test
