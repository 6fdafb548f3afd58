// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/local.h"

#include <algorithm>
#include <cmath>

#include "scene/geometry/portable_math.h"

namespace vitrail {

Vector3d sample_cosine_hemisphere(float u, float v) {
  const double a = 2 * static_cast<double>(u) - 1, b = 2 * static_cast<double>(v) - 1;
  if (a == 0 && b == 0) return {0, 0, 1};
  const bool wide = std::abs(a) > std::abs(b);
  const double radius = wide ? a : b, phi = pi / 4 * ((wide ? b : a) / radius);
  const double along = radius * cos_small(phi), across = radius * sin_small(phi);
  const double z = std::sqrt(1 - radius * radius);
  return wide ? Vector3d{along, across, z} : Vector3d{across, along, z};
}

double attainable(double p) {
  if (!(p > 0)) return 0;
  return p < 1 ? std::clamp(std::ceil(p * 0x1p24), 1.0, 0x1p24 - 1) * 0x1p-24 : 1;
}

double fresnel_dielectric(double cosine, double eta) {
  if (eta == 1) return 0;  // also at grazing incidence, where both cosines vanish
  const double sin2_transmitted = (1 - cosine * cosine) / (eta * eta);
  if (sin2_transmitted >= 1) return 1;
  const double transmitted = safe_sqrt(1 - sin2_transmitted);  // > 0, so the sums below are
  const double s = (cosine - eta * transmitted) / (cosine + eta * transmitted);
  const double p = (eta * cosine - transmitted) / (eta * cosine + transmitted);
  return (s * s + p * p) / 2;
}

bool refract(Vector3d out, Vector3d normal, double eta, Vector3d& refracted) {
  const double cosine = dot(out, normal);
  const double sin2_transmitted = std::max(0.0, 1 - cosine * cosine) / (eta * eta);
  if (sin2_transmitted >= 1) return false;
  const double transmitted = safe_sqrt(1 - sin2_transmitted);
  refracted = normalize(out * (-1 / eta) + normal * (cosine / eta - transmitted));
  return true;
}

}  // namespace vitrail
