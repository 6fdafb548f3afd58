// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace vitrail {

// Returns the name of a picture where the user gives none, in the current folder. It is the name that the
// Film of a pbrt scene gives, of which only the last part of a path counts; else the input's: "scene.exr". An
// extension that is not written becomes .exr.
std::filesystem::path default_output(const std::filesystem::path& input);

}  // namespace vitrail
