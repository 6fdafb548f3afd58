// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "scene/system/diagnostics.h"

namespace vitrail {

// A scene may include any file that the program may read, and the author of the scene may see the messages.
// So the text of a file outside of the scene's folder is not repeated: the error keeps its place and loses
// its excerpt and its quotations.
Error without_foreign_text(const Error& error, const std::filesystem::path& scene_file);

}  // namespace vitrail
