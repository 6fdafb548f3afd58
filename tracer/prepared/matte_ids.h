// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "bundle/manifest.h"

namespace vitrail {

// They are what films keep of things (film/mattes.h), by the indices of the manifest's records; empty where
// the film does not keep it.
struct MatteIds {
  std::vector<std::uint32_t> surfaces, materials;
};

// Throws Error where the bundle's list of shapes is damaged.
MatteIds matte_ids(const Manifest& manifest, const std::filesystem::path& bundle);

}  // namespace vitrail
