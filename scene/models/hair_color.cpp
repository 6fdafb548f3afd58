// SPDX-License-Identifier: Apache-2.0
#include "scene/models/hair_color.h"

#include "scene/spectra/rgb_to_spectrum.h"

namespace vitrail {

Spectrum melanin_absorption(double eumelanin, double pheomelanin) {
  return unbounded_from_rgb({eumelanin * 0.419 + pheomelanin * 0.187, eumelanin * 0.697 + pheomelanin * 0.4,
                             eumelanin * 1.37 + pheomelanin * 1.05});
}

double hair_color_scale(double beta_n) {
  const double b = beta_n, b2 = b * b;
  return 5.969 - 0.215 * b + 2.532 * b2 - 10.73 * b2 * b + 5.574 * b2 * b2 + 0.245 * b2 * b2 * b;
}

}  // namespace vitrail
