// SPDX-License-Identifier: Apache-2.0
// It finds ranks of this host that the system holds: a SIGSTOP, a debugger, a terminal.
#pragma once

#include <vector>

namespace vitrail {

// Returns their numbers, ascending: of the processes that the launcher has started here beside this one. It
// asks /proc alone, so it knows them while MPI waits, too.
std::vector<int> stopped_ranks_of_host();

}  // namespace vitrail
