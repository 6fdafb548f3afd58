// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "scene/system/diagnostics.h"

namespace vitrail {

// A scene may include any file that the program may read, and who wrote the scene sees what is said of it.
// So of a file outside of the scene's folder no text is repeated: the same error with its place, and without
// its excerpt and what it quotes.
Error without_foreign_text(const Error& error, const std::filesystem::path& scene_file);

}  // namespace vitrail
