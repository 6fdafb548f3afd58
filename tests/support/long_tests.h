// SPDX-License-Identifier: Apache-2.0
// Tests of many cases take a share of them, or all with VITRAIL_LONG_TESTS.
#pragma once

#include <cstdlib>

namespace vitrail::test {

inline bool are_long() { return std::getenv("VITRAIL_LONG_TESTS") != nullptr; }

// How many of so many cases or samples a test takes.
template <class Number>
Number of_all(Number all, Number share) {
  return are_long() ? all : share;
}

}  // namespace vitrail::test
