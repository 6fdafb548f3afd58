// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "importers/pbrt/write/writer.h"
#include "scene/records/uv_uses.h"

namespace vitrail::pbrt {

// Writes the curves of a shape to a new file, as pbrt's Bézier ones of type "cylinder", with these
// parameters. Returns the file's path relative to the scene's. `uvs` says whether their (u,v) show.
std::string write_curves(Writer& writer, const Shape& shape, bool uvs, Parameters& parameters);

}  // namespace vitrail::pbrt
