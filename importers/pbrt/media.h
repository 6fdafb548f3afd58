// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "importers/pbrt/textures.h"
#include "scene/scene.h"

namespace vitrail::pbrt {

// The medium of a MakeNamedMedium directive of type `kind`.
Medium make_medium(const std::string& kind, const std::string& name, ParameterSet& parameters,
                   const Transform& ctm, const Scope& scope);

}  // namespace vitrail::pbrt
