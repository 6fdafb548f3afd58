// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "importers/pbrt/lexer.h"

namespace vitrail::pbrt {

enum class Version { v3, v4 };

// Which version's meaning a file has where the two differ, by the first word in the main file that only one of them
// knows (Film "image", WorldEnd, matte, color … against Film "rgb", ColorSpace, diffuse …); v4 where there is none.
Version detect_version(const std::filesystem::path& file);

}  // namespace vitrail::pbrt
