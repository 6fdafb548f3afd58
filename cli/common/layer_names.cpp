// SPDX-License-Identifier: Apache-2.0
#include "cli/common/layer_names.h"

#include <fmt/format.h>

#include <sstream>

#include "scene/system/diagnostics.h"

namespace vitrail {

FilmLayers parse_layers(const std::string& names) {
  FilmLayers layers;
  if (names == "none") return layers;
  std::istringstream list(names);
  for (std::string name; std::getline(list, name, ',');)
    if (!add_named(layers, name))
      throw UsageError(fmt::format("--aov: \"{}\" is none of {},normal", name, names_of({all_layers})));
  return layers;
}

}  // namespace vitrail
