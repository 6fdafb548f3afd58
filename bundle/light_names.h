// SPDX-License-Identifier: Apache-2.0
// What people call the lights of a bundle: by the name that the scene's file gives, else by kind and number.
#pragma once

#include <string>
#include <vector>

#include "bundle/manifest.h"

namespace vitrail {

// By the indices of the manifest's records. Several lights may have one name. A name has no control
// character, blank, comma or equals sign, and at most 64 bytes.
struct LightNames {
  std::vector<std::string> area_lights, lights;
  std::vector<std::string> media;  // that shine; "" of others
};

// "lamp", "area-3": numbers are those that `inspect` lists lights by, area lights first, from 1; of media,
// "medium-2", those of the manifest.
LightNames light_names(const Manifest& manifest);

// By kind and number alone, whatever names the file gives.
LightNames numbered_light_names(const Manifest& manifest);

// "Desk_lamp" of "Desk lamp": as names of lights are shown and typed.
std::string typed_name(std::string name);

}  // namespace vitrail
