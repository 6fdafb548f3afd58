// SPDX-License-Identifier: Apache-2.0
// Who watches standard error, and in what.
#pragma once

namespace vitrail {

// Whether somebody does: it is a terminal, or that of the mpirun that started this process is.
bool on_terminal();

// Columns of that terminal; where it does not say, $COLUMNS, else 80.
int terminal_columns();

// Whether words for that terminal may be coloured: not where NO_COLOR is set to anything (no-color.org), or
// TERM is "dumb".
bool has_color();

}  // namespace vitrail
