// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "tracer/bsdf/local.h"
#include "tracer/bsdf/plastic.h"
#include "tracer/portable_math.h"

namespace vitrail {

namespace {

// Of light at that cosine, what part facets reflect (at once, back above the surface) and what part they let
// through: the means over visible normals of F·G₁(reflected) and (1 − F)·G₁(refracted).
struct Shares {
  double reflected = 0, transmitted = 0;
};

Shares shares(const Microfacets& mf, double cosine, double eta) {
  const Vector3d out{safe_sqrt(1 - cosine * cosine), 0, cosine};
  const bool ggx = mf.distribution == Roughness::Distribution::ggx;
  // Both halves on either side of the plane of incidence are the same.
  const int halves = ggx ? 8 : 16, others = ggx ? 64 : 40;
  Shares sum;
  for (int i = 0; i < halves; ++i)
    for (int j = 0; j < others; ++j) {
      const float half = (static_cast<float>(i) + 0.5f) / (2 * static_cast<float>(halves));
      const float other = (static_cast<float>(j) + 0.5f) / static_cast<float>(others);
      const Vector3d m = sample_visible_normal(mf, out, ggx ? Point2f{half, other} : Point2f{other, half});
      const double f = fresnel_dielectric(std::clamp(dot(out, m), 0.0, 1.0), eta);
      const Vector3d reflected = mirror(out, m);
      Vector3d refracted;
      if (reflected.z > 0) sum.reflected += f * reflected.z / visible_area(mf, reflected);
      if (refract(out, m, eta, refracted) && refracted.z < 0)
        sum.transmitted += (1 - f) * -refracted.z / visible_area(mf, -refracted);
    }
  return {sum.reflected / (halves * others), sum.transmitted / (halves * others)};
}

}  // namespace

RoughPlasticTables make_rough_plastic_tables(double alpha, double eta, Roughness::Distribution distribution) {
  const Microfacets mf = make_microfacets(alpha, alpha, distribution, Masking::separable);
  constexpr int count = RoughPlasticTables::count;
  RoughPlasticTables tables;
  double internal = 0;
  for (int i = 0; i < count; ++i) {
    const double cosine = std::max(1e-6, static_cast<double>(i) / (count - 1));
    tables.external_transmittance[static_cast<std::size_t>(i)] =
        static_cast<float>(shares(mf, cosine, eta).transmitted);
    internal += shares(mf, cosine, 1 / eta).reflected * cosine;
  }
  tables.internal_reflectance = 2 * internal / count;  // a plain mean over the cosines, as Mitsuba takes it
  return tables;
}

}  // namespace vitrail
