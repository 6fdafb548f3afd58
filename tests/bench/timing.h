// SPDX-License-Identifier: Apache-2.0
// Processor time, so that whoever else is on the machine matters less.
#pragma once

#include <time.h>

#include <algorithm>
#include <vector>

namespace vitrail::test {

// Of this thread.
inline double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

inline double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

}  // namespace vitrail::test
