// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace vitrail {

// The bytes of numbers as the machine has them, one behind the other.
template <class... T>
std::string bytes(T... values) {
  std::string result;
  ((result += std::string(reinterpret_cast<const char*>(&values), sizeof values)), ...);
  return result;
}

}  // namespace vitrail
