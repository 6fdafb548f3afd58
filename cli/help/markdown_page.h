// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cli/help/command.h"

namespace vitrail {

// The options of a verb as a page of docs/reference/options: a table a heading, in the order of the help.
std::string markdown_page(const Command& command);

}  // namespace vitrail
