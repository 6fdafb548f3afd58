// SPDX-License-Identifier: Apache-2.0
// Which scene files the writers made: each says so.
#pragma once

#include <filesystem>

namespace vitrail {

// It stands in the first lines; in glTF, whose order is that of names, it is the generator.
inline constexpr const char* scene_signature = "written by Vitrail";

// Returns whether the file has it.
bool is_own_scene(const std::filesystem::path& file);

}  // namespace vitrail
