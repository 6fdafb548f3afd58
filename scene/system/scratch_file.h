// SPDX-License-Identifier: Apache-2.0
// Files for what has no room in memory, of this process alone.
#pragma once

#include <filesystem>

namespace vitrail {

// $TMPDIR, else /var/tmp, which is on a disk where /tmp may be in memory.
std::filesystem::path scratch_directory();

// The descriptor of an empty file in the scratch directory. The file has no name, so it goes with the process
// however that ends. −1 where there can be none; errno says why.
int open_scratch_file();

}  // namespace vitrail
