// SPDX-License-Identifier: Apache-2.0
// Each scene file of the writers says that it is theirs, so that they know it again.
#pragma once

#include <filesystem>

namespace vitrail {

// It stands in the first lines; in glTF, whose order is that of names, it is the generator.
inline constexpr const char* scene_signature = "written by Vitrail";

// Returns whether the file has it.
bool is_own_scene(const std::filesystem::path& file);

}  // namespace vitrail
