// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tbb/task_arena.h>

namespace vitrail {

// Returns whether this thread runs a task of ours (scene/system/memory_guard.h).
inline bool runs_a_task() { return tbb::this_task_arena::current_thread_index() >= 0; }

}  // namespace vitrail
