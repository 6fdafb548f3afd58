// SPDX-License-Identifier: Apache-2.0
#include "cli/common/own_output.h"

#include "scene/system/diagnostics.h"

namespace vitrail {

void require_own(const std::filesystem::path& file, bool (*is_own)(const std::filesystem::path&),
                 bool force) {
  std::error_code unknown;
  if (force || file.empty() || !std::filesystem::is_regular_file(file, unknown) ||
      std::filesystem::is_empty(file, unknown) || is_own(file))
    return;
  throw Error(
      "this file exists, and does not say that vitrail made it; --force replaces it, and another name keeps "
      "it",
      {file.string()});
}

}  // namespace vitrail
