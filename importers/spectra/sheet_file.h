// SPDX-License-Identifier: Apache-2.0
// These functions read tables of measured glass: docs/why/measured-glass.md describes them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scene/records/measured_sheet.h"

namespace vitrail {

struct MeasuredSheetFile {
  MeasuredSheet sheet;
  std::vector<std::string> repairs;  // what was wrong and how it is read: for diagnostics
};

// Returns whether the file's first words are the header of such a table; false where there is no file.
bool is_measured_sheet(const std::filesystem::path& file);

// Throws Error with the line.
MeasuredSheetFile read_measured_sheet(const std::filesystem::path& file);

}  // namespace vitrail
