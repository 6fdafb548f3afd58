// SPDX-License-Identifier: Apache-2.0
// Which scene files the writers made: each says so.
#pragma once

#include <filesystem>

namespace vitrail {

// In the first lines; of glTF, whose order is that of names, the generator.
inline constexpr const char* scene_signature = "written by Vitrail";

bool is_own_scene(const std::filesystem::path& file);

}  // namespace vitrail
