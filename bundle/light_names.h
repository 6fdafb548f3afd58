// SPDX-License-Identifier: Apache-2.0
// What people call the lights of a bundle: kind and number.
#pragma once

#include <string>
#include <vector>

#include "bundle/manifest.h"

namespace vitrail {

// By the indices of the manifest's records.
struct LightNames {
  std::vector<std::string> area_lights, lights;
  std::vector<std::string> media;  // that shine; "" of others
};

// "area-3", "sky-4": numbers are those that `inspect` lists lights by, area lights first, from 1; of media,
// "medium-2", those of the manifest.
LightNames light_names(const Manifest& manifest);

}  // namespace vitrail
