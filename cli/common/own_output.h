// SPDX-License-Identifier: Apache-2.0
// What stands under an output's name already.
#pragma once

#include <filesystem>

namespace vitrail {

// Throws Error where `file` exists, holds something that no program of the suite made (`is_own`), and may not
// be replaced (`force`).
void require_own(const std::filesystem::path& file, bool (*is_own)(const std::filesystem::path&), bool force);

}  // namespace vitrail
