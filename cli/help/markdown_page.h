// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cli/help/command.h"

namespace vitrail {

// Returns the options of a verb as a page of docs/reference/options: a table a heading, in the help's order.
std::string markdown_page(const Command& command);

}  // namespace vitrail
