// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "scene/records/scene.h"

namespace vitrail {

// Writes glTF 2.0 with all that belongs to it in one file: a .glb, or a .gltf with its buffer in base64.
// Lights are in candela, lux and cd/m² as the picture shows them (gltf/units.h). Throws MachineError, and
// Error beyond 4 GiB.
Diagnostics write_gltf(const Scene& scene, const std::filesystem::path& out);

}  // namespace vitrail
