// SPDX-License-Identifier: Apache-2.0
#include "tracer/photons/progressive.h"

#include <algorithm>
#include <cmath>

namespace vitrail {

double radius_of(const PhotonKey& photons, std::uint32_t iteration) {
  double squared = photons.first_radius * photons.first_radius;
  for (std::uint32_t i = 1; i <= iteration; ++i)
    squared *= (static_cast<double>(i) + photons.alpha) / (static_cast<double>(i) + 1);
  return std::sqrt(squared);
}

std::uint64_t default_photons(const FilmSettings& film) {
  return std::max<std::uint64_t>(
      1 << 16, static_cast<std::uint64_t>(film.width) * static_cast<std::uint64_t>(film.height));
}

double default_radius(const Manifest& m, std::uint64_t photons) {
  const Bounds3f core = core_of(m);
  if (core.empty()) return 1;
  const double extent = length(cast<double>(core.upper) - cast<double>(core.lower));
  return extent > 0 ? extent * std::sqrt(10 / (3.141592653589793 * static_cast<double>(photons))) : 1;
}

}  // namespace vitrail
