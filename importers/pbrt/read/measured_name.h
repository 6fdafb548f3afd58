// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "importers/pbrt/read/textures.h"

namespace vitrail::pbrt {

// Returns whether a measured medium is known by the name, which is a value of `parameters`; reports it where
// none is.
bool is_measured(const std::string& name, const ParameterSet& parameters, const Scope& scope);

}  // namespace vitrail::pbrt
