// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "farm/transport/transport.h"

namespace vitrail {

// Returns the list that `rank` has, on rank 0; on the others nothing. All ranks call it, for one rank after
// the other, so that memory holds one list. It travels as the sum with the others' zeros.
std::vector<std::int64_t> list_to_root(Transport& transport, int rank, std::vector<std::int64_t> mine);

}  // namespace vitrail
