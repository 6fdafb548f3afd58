// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace vitrail::test {

// What a command writes to a terminal of so many columns, control characters and all.
std::string run_on_terminal(const std::string& command, unsigned short columns);

// Without colours: escape sequences that end in m.
std::string without_colors(const std::string& text);

}  // namespace vitrail::test
