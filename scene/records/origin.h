// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace vitrail {

// It says where in the input a record comes from; `file` is an index into Scene::files. Line 0 means nowhere
// in particular. Records that differ in nothing else are equal.
struct Origin {
  std::uint32_t file = 0, line = 0, column = 0;
  bool operator==(const Origin&) const { return true; }
};

}  // namespace vitrail
