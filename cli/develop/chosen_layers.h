// SPDX-License-Identifier: Apache-2.0
// ChosenLayers are what an .exr has beside its colours, by `develop --layers`.
#pragma once

#include <string>

#include "film/develop.h"

namespace vitrail {

struct ChosenLayers {
  bool all = false;  // that the film has
  bool variance = false, spectrum = false, groups = false;
  FilmLayers layers;
};

// Reads "all", or names with commas between them: those of render --aov, `variance`, `spectrum`
// and `groups`. Throws UsageError.
ChosenLayers parse_chosen_layers(const std::string& names);

// Leaves other layers out. Throws Error where the picture lacks a named one; `file` is what it is made of.
void keep_layers(Picture& picture, const ChosenLayers& chosen, const std::string& file);

}  // namespace vitrail
