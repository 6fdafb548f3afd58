// SPDX-License-Identifier: Apache-2.0
// These functions write a data sheet as a page to read and as JSON.
#pragma once

#include <string>
#include <vector>

#include "glazing/data_sheet.h"

namespace vitrail {

// Returns one file of HTML without scripts: panes, figures of each state beside the others, plots, tables by
// angle and by pane, and the meaning of each abbreviation.
std::string sheet_page(const DataSheet& sheet, const std::vector<std::string>& notes);

// Returns the same numbers: temperatures in °C, parts of 1, W/(m²K).
std::string sheet_json(const DataSheet& sheet, const std::vector<std::string>& notes);
}  // namespace vitrail
