// SPDX-License-Identifier: Apache-2.0
// It says what this rank does at the moment, in the words of messages: "tracing rays". Ranks go through a job
// in step, so a rank that does not answer does the same.
#pragma once

#include <atomic>

namespace vitrail {

inline std::atomic<const char*> doing_now = "starting";

inline void now_doing(const char* what) { doing_now.store(what, std::memory_order_relaxed); }
inline const char* doing() { return doing_now.load(std::memory_order_relaxed); }

}  // namespace vitrail
