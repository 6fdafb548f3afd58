// SPDX-License-Identifier: Apache-2.0
// A report page says what became of a scene, as a page to read.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/convert/conversion_report.h"

namespace vitrail {

// Writes one file of HTML without scripts: the counts, the checks, then every kind of loss with all of its
// places, then every item. Throws MachineError.
void write_report_page(const std::filesystem::path& file, const std::filesystem::path& in,
                       const std::filesystem::path& out, const ConversionChecks& checks,
                       const Diagnostics& diagnostics, const std::vector<ConversionItem>& items);

}  // namespace vitrail
