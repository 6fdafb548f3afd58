// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "importers/pbrt/read/context.h"
#include "importers/pbrt/read/parameters.h"

namespace vitrail::pbrt {

// pbrt-v4 takes images of all directions by its equal-area map of the sphere to a square and refuses others,
// as this does with Error; v3 takes them by longitude and latitude, of any size. A file that cannot be read
// is refused where its pixels are wanted.
void expect_map_of_sphere(const std::string& filename, const Parameter& parameter, const Context& context);

}  // namespace vitrail::pbrt
