// SPDX-License-Identifier: Apache-2.0
// This file asks what stands under an output's name already.
#pragma once

#include <filesystem>
#include <initializer_list>

namespace vitrail {

// Throws Error where `file` exists, holds something that no program of the suite made (`is_own`), and may not
// be replaced (`force`).
void require_own(const std::filesystem::path& file, bool (*is_own)(const std::filesystem::path&), bool force);

// Returns whether a text says in its first 4 KiB that the suite made it, as statistics, reports, plots and
// pages do ("vitrail"), or begins as its tables of wavelengths do.
bool is_own_text(const std::filesystem::path& file);
// Throws Error where one of the texts is not the suite's own. Names may be empty.
void require_own_texts(std::initializer_list<std::filesystem::path> files, bool force);

}  // namespace vitrail
