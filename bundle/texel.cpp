// SPDX-License-Identifier: Apache-2.0
#include "bundle/texel.h"

#include <algorithm>

namespace vitrail {

SigmoidNodes nodes_of(const SigmoidSpectrum& sigmoid) {
  constexpr std::array<double, 3> lambda_nm{lambda_min_nm, (lambda_min_nm + lambda_max_nm) / 2,
                                            lambda_max_nm};
  SigmoidNodes nodes;
  for (std::size_t i = 0; i < 3; ++i) {
    const double l = lambda_nm[i];
    const double x = (static_cast<double>(sigmoid.c0) * l + static_cast<double>(sigmoid.c1)) * l +
                     static_cast<double>(sigmoid.c2);
    nodes[i] =
        static_cast<float>(std::clamp(x, -static_cast<double>(real21_max), static_cast<double>(real21_max)));
  }
  return nodes;
}

}  // namespace vitrail
