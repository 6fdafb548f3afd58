// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "measure/measure.h"

namespace vitrail {

// Throws Error where the folder has an index.html that is not of a measurement.
void require_own_page(const std::filesystem::path& folder);

// Writes measure.json, and index.html: a page that needs no network and no other file.
void write_report(const MeasureOptions& options, const Measurement& measurement);

}  // namespace vitrail
