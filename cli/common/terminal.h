// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace vitrail {

// Whether somebody watches standard error: it is a terminal, or that of the mpirun that started this process
// is.
bool on_terminal();

}  // namespace vitrail
