// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

namespace vitrail {

// It holds relative values each 5 nm from `first_nm` on.
struct IlluminantTable {
  std::string_view name;  // "stdillum-F1"
  double first_nm;
  std::span<const float> values;
};

std::span<const IlluminantTable> illuminant_tables();

}  // namespace vitrail
