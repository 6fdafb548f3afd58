// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cli/help/command.h"

namespace vitrail {

// Returns a page of section 1 in the macros of man(7), UTF-8. The same version gives the same bytes.
std::string man_page(const Command& command, const std::string& version);

}  // namespace vitrail
