// SPDX-License-Identifier: Apache-2.0
// What a scene needs of a renderer, from its records.
#pragma once

#include "bundle/manifest.h"

namespace vitrail {

// `has_normals`: some mesh has shading normals. The manifest's records are final.
Requirements requirements_of(const Manifest& manifest, bool has_normals);

// A dielectric without roughness.
bool is_smooth_glass(const Material& material);

// Everything: for measuring what the analysis saves.
Requirements all_requirements();

}  // namespace vitrail
