// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "tracer/bsdf/microfacet.h"

namespace vitrail::laws {

// Widths from 10⁻³ to 1, isotropic and not, of both distributions and both kinds of masking.
inline std::vector<Microfacets> rough_cases() {
  std::vector<Microfacets> result;
  Masking masking = Masking::correlated;
  for (const auto distribution : {Roughness::Distribution::ggx, Roughness::Distribution::beckmann})
    for (const auto& [u, v] : {std::pair{1e-3, 1e-3},
                               {1e-2, 1e-2},
                               {0.1, 0.1},
                               {0.4, 0.4},
                               {1.0, 1.0},
                               {1e-3, 0.05},
                               {0.5, 0.02},
                               {0.2, 1.0}}) {
      result.push_back(make_microfacets(u, v, distribution, masking));
      masking = masking == Masking::correlated ? Masking::separable : Masking::correlated;
    }
  return result;
}

inline std::string name_of(const Microfacets& mf) {
  return fmt::format("{} {} α = {}, {}", mf.distribution == Roughness::Distribution::ggx ? "GGX" : "Beckmann",
                     mf.masking == Masking::correlated ? "correlated" : "separable", mf.alpha_u, mf.alpha_v);
}

}  // namespace vitrail::laws
