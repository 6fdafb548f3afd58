// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace vitrail {

// Returns whether a file says that this suite made it, in any version: pictures by their "Software", tables
// of sensors by their first line. It reads bytes, so that no image library has to be loaded. Other files are
// somebody else's, or a program worked on them since and put its own name there.
bool is_own_picture(const std::filesystem::path& file);

}  // namespace vitrail
