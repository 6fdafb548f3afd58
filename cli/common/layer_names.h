// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "scene/records/film_layers.h"

namespace vitrail {

inline constexpr const char* layers_help =
    "keep these layers of the first surface that each sample sees, separated by commas: albedo, position, "
    "geo_normal, sh_normal (or normal), uv, depth, shape_index, material_index, prim_index, alpha, motion, "
    "cryptomatte (crypto_object and crypto_material); none; default: as the scene says";

// Returns the layers that `--aov` names. Throws UsageError for unknown ones.
FilmLayers parse_layers(const std::string& names);

}  // namespace vitrail
