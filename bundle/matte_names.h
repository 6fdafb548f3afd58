// SPDX-License-Identifier: Apache-2.0
// What the masks of a picture are called: by the name that the scene's file gives, else by kind and number,
// from 1. Things of one name share a mask.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "bundle/manifest.h"

namespace vitrail {

// BUNDLE/shapes.json: "chair", "shape-3", by the manifest's surfaces. Of bundles that tell shapes apart
// (tells_shapes); others have no such file.
std::filesystem::path shape_names_path(const std::filesystem::path& bundle);
// Throws MachineError.
void write_shape_names(const std::filesystem::path& bundle, std::span<const std::string> names);
// Throws Error where the file is damaged, or is of other surfaces.
std::vector<std::string> read_shape_names(const std::filesystem::path& bundle, const Manifest& manifest);

// "oak", "material-2", by the manifest's materials; numbers as those of the layer `material_index`.
std::vector<std::string> material_names(const Manifest& manifest);

}  // namespace vitrail
