// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tbb/info.h>

#include <algorithm>

#include "scene/system/machine_limits.h"

namespace vitrail {

// Returns how many threads an arena asks TBB for. It has none beyond one a processor,
// and warns who asks for more.
inline int arena_threads(int asked) { return std::min(threads_for(asked), tbb::info::default_concurrency()); }

}  // namespace vitrail
