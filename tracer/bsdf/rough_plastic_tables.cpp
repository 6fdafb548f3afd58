// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <vector>

#include "scene/geometry/portable_math.h"
#include "tracer/bsdf/local.h"
#include "tracer/bsdf/plastic.h"

namespace vitrail {

namespace {

// Of light at that cosine: what part facets let through from outside, and what part they reflect of light
// from inside, whose index to the other is 1/η. Means over visible normals of (1 − F)·G₂(refracted)/G₁(out)
// and F·G₂(reflected)/G₁(out).
struct Shares {
  double transmitted = 0, reflected_inside = 0;
};

// Visible normals of light along (sin θ, 0, cos θ) for a grid of numbers, by half: those on the other side of
// the plane of incidence mirror them.
class VisibleNormals {
 public:
  VisibleNormals(const Microfacets& mf, Vector3d out) : mf_(mf), out_(out) {
    if (!by_slopes()) return;
    // Beckmann's slope along the plane of incidence follows from one number, that across it from the other.
    for (int j = 0; j < others(); ++j) {
      const Vector3d m = sample_visible_normal(mf, out, {other(j), 0.5f});
      along_.push_back(m.x / m.z);
    }
    for (int i = 0; i < halves(); ++i) {
      const Vector3d m = sample_visible_normal(mf, out, {0.5f, half(i)});
      across_.push_back(m.y / m.z);
    }
  }
  int halves() const { return by_slopes() ? 16 : 8; }
  int others() const { return by_slopes() ? 40 : 64; }
  Vector3d at(int i, int j) const {
    if (!by_slopes()) return sample_visible_normal(mf_, out_, {half(i), other(j)});
    return normalize(Vector3d{along_[static_cast<std::size_t>(j)], across_[static_cast<std::size_t>(i)], 1});
  }

 private:
  bool by_slopes() const { return mf_.distribution == Roughness::Distribution::beckmann; }
  float half(int i) const { return (static_cast<float>(i) + 0.5f) / (2 * static_cast<float>(halves())); }
  float other(int j) const { return (static_cast<float>(j) + 0.5f) / static_cast<float>(others()); }

  const Microfacets& mf_;
  Vector3d out_;
  std::vector<double> along_, across_;
};

Shares shares(const Microfacets& mf, double cosine, double eta) {
  const Vector3d out{safe_sqrt(1 - cosine * cosine), 0, cosine};
  const VisibleNormals normals(mf, out);
  const double area = visible_area(mf, out);
  const auto seen = [&](Vector3d in) {
    return shadowing_over_cosines(mf, out, area, in) * area * std::abs(in.z);
  };
  Shares sum;
  for (int i = 0; i < normals.halves(); ++i)
    for (int j = 0; j < normals.others(); ++j) {
      const Vector3d m = normals.at(i, j);
      const double facing = std::clamp(dot(out, m), 0.0, 1.0);
      const Vector3d reflected = mirror(out, m);
      if (reflected.z > 0) sum.reflected_inside += fresnel_dielectric(facing, 1 / eta) * seen(reflected);
      Vector3d refracted;
      if (refract(out, m, eta, refracted) && refracted.z < 0)
        sum.transmitted += (1 - fresnel_dielectric(facing, eta)) * seen(refracted);
    }
  const double count = normals.halves() * normals.others();
  return {sum.transmitted / count, sum.reflected_inside / count};
}

}  // namespace

RoughPlasticTables make_rough_plastic_tables(double eta, const Microfacets& mf) {
  constexpr int count = RoughPlasticTables::count;
  RoughPlasticTables tables;
  double internal = 0;
  for (int i = 0; i < count; ++i) {
    const double cosine = std::max(1e-6, static_cast<double>(i) / (count - 1));
    const Shares at = shares(mf, cosine, eta);
    tables.external_transmittance[static_cast<std::size_t>(i)] = static_cast<float>(at.transmitted);
    internal += at.reflected_inside * cosine;
  }
  tables.internal_reflectance = 2 * internal / count;  // a plain mean over the cosines, as Mitsuba takes it
  return tables;
}

}  // namespace vitrail
