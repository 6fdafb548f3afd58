// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "measure/measure.h"

namespace vitrail {

// Writes measure.json, and index.html: a page that needs no network and no other file.
void write_report(const MeasureOptions& options, const Measurement& measurement);

}  // namespace vitrail
