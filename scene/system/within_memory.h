// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace vitrail {

// A Stage is what a program is at.
struct Stage {
  const char* what = "starting";
  double fraction = 0;             // of what is read of the input; 0: not known
  double start_bytes = 0;          // resident before it was read
  std::string held{};              // what the scene takes, by kind; "": not known
  std::uint64_t needed_bytes = 0;  // least budget for all that follows; 0: not known
};

// Runs `body` with no more than `budget_bytes` resident (scene/system/memory_guard.h). Where this is too
// little it throws MachineError that says what is missing, in place of what body throws. `is_own` is
// guard_memory's; this thread is own in any case.
int within_memory(
    std::uint64_t budget_bytes, const Stage& stage, const std::function<int()>& body,
    bool (*is_own)() = [] { return false; });

// Runs `body` within what the job has of this machine, beyond which the system would kill it; 0 means that it
// has all. Throws MachineError as within_memory does, which says that the job needs more.
void within_job(std::uint64_t job_bytes, const char* what, const std::function<void()>& body);

}  // namespace vitrail
