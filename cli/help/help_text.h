// SPDX-License-Identifier: Apache-2.0
// This file writes what --help and --help-all print.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "cli/help/command.h"

namespace vitrail {

// Returns all options, in lines of at most `width` columns, broken between words.
std::string help_text(const Command& command, std::size_t width);

// Returns what nearly everyone needs, and how to see the rest; the same as the above where all is short.
std::string short_help_text(const Command& command, std::size_t width);

// Returns commands with what they do, one below the other.
std::string example_text(std::span<const Example> examples, std::size_t width);

// Returns `label`, then `text` from `column` on, on the next line where the label reaches it.
std::string entry_text(std::string_view label, std::string_view text, std::size_t column, std::size_t width);

// Returns the columns of the terminal on standard output, else of COLUMNS, else 80; between 40 and 120.
std::size_t help_width();

}  // namespace vitrail
