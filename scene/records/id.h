// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace vitrail {

// It is the index of a T in the vector of the Scene that holds all Ts.
template <class T>
struct Id {
  std::uint32_t value = 0;
  bool operator==(const Id&) const = default;
};

}  // namespace vitrail
