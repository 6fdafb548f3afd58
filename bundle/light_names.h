// SPDX-License-Identifier: Apache-2.0
// These functions name the lights of a bundle for people: by the name that the scene's file gives, else by
// kind and number.
#pragma once

#include <string>
#include <vector>

#include "bundle/manifest.h"

namespace vitrail {

// It holds the names by the indices of the manifest's records. Several lights may have one name. A name has
// no control character, blank, comma or equals sign, and at most 64 bytes.
struct LightNames {
  std::vector<std::string> area_lights, lights;
  std::vector<std::string> media;  // that shine; "" of others
};

// Returns the names, such as "lamp" or "area-3". Numbers are those that `inspect` lists lights by: area
// lights first, from 1. Media are numbered as in the manifest, "medium-2".
LightNames light_names(const Manifest& manifest);

// Returns names by kind and number alone, whatever names the file gives.
LightNames numbered_light_names(const Manifest& manifest);

// Returns a name as names of lights are shown and typed: "Desk_lamp" for "Desk lamp".
std::string typed_name(std::string name);

}  // namespace vitrail
