// SPDX-License-Identifier: Apache-2.0
#include "scene/spectra/metal_tables.h"

#include "scene/spectra/metal_tables_text.h"

namespace vitrail {

const std::vector<NumberTable<float>>& metal_tables() {
  static const auto tables = number_tables<float>(metal_tables_text, "scene/spectra/metal_tables.txt");
  return tables;
}

}  // namespace vitrail
