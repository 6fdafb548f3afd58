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
    // Where u × v is against the normal, Mitsuba's bumpmap turns normals inside out: measured, to be
    // reported.
    Known{"mirrored & bump", "bumps where u and v are mirrored are not yet said to be otherwise in Mitsuba"},
    // Found by the whole, causes not known yet.
    Known{"shadowed normal map", "not explained"},
    Known{"principled glass / blend with n", "not explained: lights without extent are brighter here"},
    Known{"thin principled / mask of a bump", "not explained"},
    Known{"mirror / bump / & ball", "not explained"},
    Known{"principled / blend with nothing & ball", "not explained"},
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
