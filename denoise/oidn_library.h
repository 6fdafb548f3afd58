// SPDX-License-Identifier: Apache-2.0
// Where Open Image Denoise is on this machine.
#pragma once

#include <filesystem>
#include <vector>

#include "denoise/oidn_functions.h"

namespace vitrail::oidn {

// Where the PyPI package pyoidn keeps the library in Python environments: that of $VIRTUAL_ENV, of
// $CONDA_PREFIX, of the first python3 on the $PATH, the user's own, and the system's. What there is, in this
// order.
std::vector<std::filesystem::path> python_libraries();

// Loads the library once, from $VITRAIL_OIDN (the file, or the folder that it is in), and where that is not
// set from where the loader looks for libraries, then from python_libraries(). Throws MachineError with what
// to install.
const Functions& functions();

}  // namespace vitrail::oidn
