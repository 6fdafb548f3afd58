// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "tracer/bsdf/local.h"
#include "tracer/bsdf/plastic.h"
#include "tracer/portable_math.h"

namespace vitrail {

namespace {

// ∫ f·cosθ_in d in of facets with the dielectric's reflectance, out at that cosine: the mean over visible
// normals of F·G₁(in). Both halves on either side of the plane of incidence are the same.
double facet_albedo(const Microfacets& mf, double cosine, double eta) {
  const Vector3d out{safe_sqrt(1 - cosine * cosine), 0, cosine};
  const bool ggx = mf.distribution == Roughness::Distribution::ggx;
  constexpr int halves = 12, others = 32;
  double sum = 0;
  for (int i = 0; i < halves; ++i)
    for (int j = 0; j < others; ++j) {
      const float half = (static_cast<float>(i) + 0.5f) / (2 * halves);
      const float other = (static_cast<float>(j) + 0.5f) / others;
      const Vector3d m = sample_visible_normal(mf, out, ggx ? Point2f{half, other} : Point2f{other, half});
      const Vector3d in = mirror(out, m);
      if (in.z > 0)
        sum += fresnel_dielectric(std::clamp(dot(out, m), 0.0, 1.0), eta) * in.z / visible_area(mf, in);
    }
  return sum / (halves * others);
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
        static_cast<float>(1 - facet_albedo(mf, cosine, eta));
    internal += facet_albedo(mf, cosine, 1 / eta) * cosine;
  }
  tables.internal_reflectance = 2 * internal / count;  // a plain mean over the cosines, as Mitsuba takes it
  return tables;
}

}  // namespace vitrail
