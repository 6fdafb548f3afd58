// SPDX-License-Identifier: Apache-2.0
#include "tracer/media/fade.h"

#include <algorithm>

#include "scene/geometry/portable_math.h"

namespace vitrail {

SampledSpectrum left_by(const InteriorFade& fade, double distance, const SampledWavelengths& wavelengths) {
  constexpr float exponential = 1000;
  const double ratio = distance / static_cast<double>(fade.distance);
  const double raised = portable_pow(ratio, static_cast<double>(fade.power));
  SampledSpectrum left;
  for (std::size_t i = 0; i < hero_count; ++i) {
    const double color =
        std::clamp(evaluate(fade.color, static_cast<double>(wavelengths.lambda_nm[i])), 0.0, 1.0);
    left.v[i] = static_cast<float>(fade.power >= exponential ? portable_exp(-(1 - color) * ratio)
                                                             : color + (1 - color) / (1 + raised));
  }
  return left;
}

}  // namespace vitrail
