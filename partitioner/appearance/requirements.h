// SPDX-License-Identifier: Apache-2.0
// Requirements are what a scene needs of a renderer, by its records.
#pragma once

#include "bundle/manifest.h"

namespace vitrail {

// `has_normals` means that some mesh has shading normals. The manifest's records are final.
Requirements requirements_of(const Manifest& manifest, bool has_normals);

// Returns whether it is a dielectric without roughness.
bool is_smooth_glass(const Material& material);

// Returns everything, to measure what the analysis saves.
Requirements all_requirements();

}  // namespace vitrail
