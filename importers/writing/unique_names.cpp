// SPDX-License-Identifier: Apache-2.0
#include "importers/writing/unique_names.h"

#include <fmt/format.h>

namespace vitrail {

std::string UniqueNames::take(const std::string& wanted) {
  const auto [known, is_new] = next_.try_emplace(wanted, 2);
  if (is_new) return wanted;
  std::size_t& number = known->second;  // stays where it is while names are added
  for (;;) {
    std::string name = fmt::format("{}_{}", wanted, number++);
    if (next_.try_emplace(name, 2).second) return name;
  }
}

}  // namespace vitrail
