// SPDX-License-Identifier: Apache-2.0
// These files have no names: they hold data that has no room in memory, or keep room on a disk. They are of
// this process alone, and go with it however it ends.
#pragma once

#include <filesystem>

namespace vitrail {

// Returns $TMPDIR, else /var/tmp, which is on a disk where /tmp may be in memory.
std::filesystem::path scratch_directory();

// Both return the descriptor of an empty file, in the scratch directory or in `folder`; −1 where there can be
// none, and errno says why. On a file system without such files it has a name for a moment.
int open_scratch_file();
int open_nameless_file(const std::filesystem::path& folder);

}  // namespace vitrail
