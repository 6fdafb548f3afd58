// SPDX-License-Identifier: Apache-2.0
// This guard puts what a rank of a job throws in words that say which rank speaks.
#pragma once

#include <functional>

#include "farm/transport/transport.h"

namespace vitrail {

// Returns the job's exit status. An exception says which rank speaks, where there are several.
int guarded(const Transport& transport, const std::function<int()>& job);

}  // namespace vitrail
