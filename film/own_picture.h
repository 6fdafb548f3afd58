// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace vitrail {

// Whether a file says that this suite made it, in any version: pictures by their "Software", tables of
// sensors by their first line. By its bytes, so that no image library has to be loaded. False: somebody
// else's, or worked on since by a program that put its own name there.
bool is_own_picture(const std::filesystem::path& file);

}  // namespace vitrail
