// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "scene/system/diagnostics.h"

namespace vitrail {

// Returns "; did you mean "perspective"?", or nothing where no known word is near.
inline std::string suggestion(const std::string& word, const std::vector<std::string>& known) {
  const std::string closest = closest_word(word, known);
  return closest.empty() ? "" : "; did you mean \"" + closest + "\"?";
}

}  // namespace vitrail
