// SPDX-License-Identifier: Apache-2.0
#include "tests/support/paths.h"

namespace vitrail::test {

std::string source_dir() { return VITRAIL_SOURCE_DIR; }
std::string project_file(const std::string& inside) { return source_dir() + "/" + inside; }
std::string bin_dir() { return VITRAIL_BIN_DIR; }

}  // namespace vitrail::test
