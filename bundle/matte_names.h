// SPDX-License-Identifier: Apache-2.0
// These functions name the masks of a picture: by the name that the scene's file gives, else by kind and
// number, from 1. Things of one name share a mask.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "bundle/manifest.h"

namespace vitrail {

// Returns BUNDLE/shapes.json, which has names like "chair" and "shape-3", by the manifest's surfaces. Only
// bundles that tell shapes apart (tells_shapes) have this file.
std::filesystem::path shape_names_path(const std::filesystem::path& bundle);
// Throws MachineError.
void write_shape_names(const std::filesystem::path& bundle, std::span<const std::string> names);
// Throws Error where the file is damaged, or belongs to other surfaces.
std::vector<std::string> read_shape_names(const std::filesystem::path& bundle, const Manifest& manifest);

// Returns names like "oak" and "material-2", by the manifest's materials. Numbers are those of the layer
// `material_index`.
std::vector<std::string> material_names(const Manifest& manifest);

}  // namespace vitrail
