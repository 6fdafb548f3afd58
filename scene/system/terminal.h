// SPDX-License-Identifier: Apache-2.0
// These functions tell whether standard error goes to a terminal, and what that terminal can show.
#pragma once

namespace vitrail {

// Returns whether standard error is a terminal, or that of the mpirun that started this process is one.
bool on_terminal();

// Returns the columns of that terminal; where it does not say, $COLUMNS, else 80.
int terminal_columns();

// Returns whether words for that terminal may be coloured. They may not where NO_COLOR is not empty
// (no-color.org), or TERM is "dumb".
bool has_color();

}  // namespace vitrail
