// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <unordered_map>

namespace vitrail {

// It gives each name once, in about the same time however many are equal.
class UniqueNames {
 public:
  // Returns the wanted name where it is free, else the first of wanted_2, wanted_3 … that is.
  std::string take(const std::string& wanted);

 private:
  std::unordered_map<std::string, std::size_t> next_;  // number to try, of each name that is taken
};

}  // namespace vitrail
