// SPDX-License-Identifier: Apache-2.0
// This file finds Open Image Denoise on this machine.
#pragma once

#include <filesystem>
#include <vector>

#include "denoise/oidn_functions.h"

namespace vitrail::oidn {

// Returns the files of the library that the PyPI package pyoidn keeps in Python environments. They
// are, in this order, those of $VIRTUAL_ENV, of $CONDA_PREFIX, of the first python3 on the $PATH,
// the user's own, and the system's.
std::vector<std::filesystem::path> python_libraries();

// Loads the library once, from $VITRAIL_OIDN (the file, or its
// folder). Where that is not set, it asks the loader first, then
// takes python_libraries(). Throws MachineError with what to install.
const Functions& functions();

}  // namespace vitrail::oidn
