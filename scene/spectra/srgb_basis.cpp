// SPDX-License-Identifier: Apache-2.0
#include "scene/spectra/srgb_basis.h"

#include <algorithm>

namespace vitrail {

std::array<double, 3> srgb_basis(double lambda_nm) {
  const double at = std::clamp((lambda_nm - 380) / 5, 0.0, 80.0);
  const auto first = std::min<std::size_t>(static_cast<std::size_t>(at), 79);
  const double part = at - static_cast<double>(first);
  std::array<double, 3> c;
  for (std::size_t i = 0; i < 3; ++i)
    c[i] = static_cast<double>(srgb_basis_table[first][i]) * (1 - part) +
           static_cast<double>(srgb_basis_table[first + 1][i]) * part;
  return c;
}

}  // namespace vitrail
