// SPDX-License-Identifier: Apache-2.0
#include "tracer/media/phase.h"

#include <algorithm>

#include "scene/geometry/portable_math.h"
#include "tracer/bsdf/local.h"
#include "tracer/media/phase_lanes.h"

namespace vitrail {

double phase(double g, Vector3d out, Vector3d in) {
  return lanes::phase(g, lanes::fill<double>(out), lanes::fill<double>(in));
}

Vector3d sample_phase(double g, Vector3d out, float u, float v) {
  const double x = static_cast<double>(u);
  double cosine;
  if (std::abs(g) < 1e-3) {
    // The inversion divides by g; to first order in g it is this.
    const double isotropic = 2 * x - 1;
    cosine = isotropic + 1.5 * g * (1 - isotropic * isotropic);
  } else {
    const double s = (1 - g * g) / (1 - g + 2 * g * x);
    cosine = (1 + g * g - s * s) / (2 * g);
  }
  cosine = std::clamp(cosine, -1.0, 1.0);
  const double sine = safe_sqrt(1 - cosine * cosine), turn = 2 * static_cast<double>(v);
  return Frame(-out).to_world({sine * sin_pi(turn + 0.5), sine * sin_pi(turn), cosine});
}

}  // namespace vitrail
