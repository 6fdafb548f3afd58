// SPDX-License-Identifier: Apache-2.0
#include "glazing/color_fidelity_tables.h"

#include "glazing/color_fidelity_tables_text.h"
#include "scene/system/number_tables.h"

namespace vitrail {

const std::array<std::array<float, 99>, 81>& cie_224_samples_5nm() {
  static const auto samples = [] {
    const auto tables = number_tables<float>(color_fidelity_tables_text, "glazing/color_fidelity_tables.txt");
    std::array<std::array<float, 99>, 81> read;
    fill_from(tables, "samples", 99, read);
    return read;
  }();
  return samples;
}

}  // namespace vitrail
