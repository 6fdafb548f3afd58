// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/microfacet.h"

#include "scene/geometry/portable_math.h"
#include "tracer/bsdf/quick_math.h"

namespace vitrail {

namespace {

using Distribution = Roughness::Distribution;

constexpr double sqrt_pi = 1.77245385090551602730;

// Beckmann's σ from v.z = z and the length s of v's horizontal part stretched by α (Walter et al. 2007,
// Eq. 26's exact form; Heitz 2014, Eq. 66).
double beckmann_area(double z, double s) {
  if (std::abs(z) >= 6 * s) return std::max(z, 0.0);  // 1 − erf 6 < 3e-17
  const double a = std::abs(z) / s;                   // |z| < 6·s, so s > 0
  const double gauss = quick_exp(-a * a), erf = quick_erf(a, gauss);
  return (z * (1 + (z < 0 ? -erf : erf)) + s / sqrt_pi * gauss) / 2;
}

double stretched_length(const Microfacets& mf, Vector3d v) {
  const double x = mf.alpha_u * v.x, y = mf.alpha_v * v.y;
  return std::sqrt(x * x + y * y);
}

Vector3d sample_ggx(const Microfacets& mf, Vector3d v, Point2f u) {
  const Vector3d w = normalize(Vector3d{mf.alpha_u * v.x, mf.alpha_v * v.y, v.z});
  const auto [cosine, sine] = quick_circle(static_cast<double>(u.x));
  const double z = (1 - static_cast<double>(u.y)) * (1 + w.z) - w.z;
  const double s = safe_sqrt(1 - z * z);
  // Its z is (1 − u.y)·(1 + w.z) > 0.
  const Vector3d h = w + Vector3d{s * cosine, s * sine, z};
  return normalize(Vector3d{mf.alpha_u * h.x, mf.alpha_v * h.y, h.z});
}

// Slope towards the viewer at polar angle θ on a surface of unit width: its density is in proportion to
// max(0, cosθ + x·sinθ)·exp(−x²). Solved for t = erf(−x), in which the cumulative distribution
// cosθ·(1 + t)/2 + sinθ·exp(−x²)/(2√π) is concave, by Halley's method kept within a bracket.
double sample_beckmann_slope(double cosine, double sine, double u) {
  const double cotangent = cosine < 6 * sine ? cosine / sine : 6;
  const double gauss = quick_exp(-cotangent * cotangent), limit = quick_erf(cotangent, gauss);
  const double share = std::max(u, 1e-9);
  const double target = share * (cosine * (1 + limit) + sine / sqrt_pi * gauss) / 2;
  const double grazing = std::sqrt(-quick_log(share));  // −x where sinθ = 1
  double low = -1, high = limit, t = limit - (1 + limit) * quick_erf(grazing, share);
  constexpr int most_steps = 12;  // two are usual
  bool close = false;
  for (int step = 0; step < most_steps && !close; ++step) {
    const double x = inverse_erf(t), bell = quick_exp(-x * x);
    const double error = (cosine * (1 + t) + sine / sqrt_pi * bell) / 2 - target;
    (error > 0 ? high : low) = t;
    close = std::abs(error) < 1e-3 * target;  // and 1e-5 a step later
    const double slope = (cosine - x * sine) / 2, curvature = -sine * sqrt_pi / (4 * bell);
    const double denominator = 2 * slope * slope - error * curvature;
    const double next = denominator > 0 ? t - 2 * error * slope / denominator : low;
    t = close ? std::clamp(next, low, high) : next > low && next < high ? next : (low + high) / 2;
  }
  return -inverse_erf(t);
}

Vector3d sample_beckmann(const Microfacets& mf, Vector3d v, Point2f u) {
  const Vector3d w = normalize(Vector3d{mf.alpha_u * v.x, mf.alpha_v * v.y, v.z});
  const double sine = std::sqrt(w.x * w.x + w.y * w.y);
  const double along = sample_beckmann_slope(w.z, sine, static_cast<double>(u.x));
  const double across = inverse_erf(2 * std::clamp(static_cast<double>(u.y), 1e-9, 1 - 1e-9) - 1);
  const double c = sine > 0 ? w.x / sine : 1, s = sine > 0 ? w.y / sine : 0;
  return normalize(
      Vector3d{mf.alpha_u * (c * along - s * across), mf.alpha_v * (s * along + c * across), 1.0});
}

}  // namespace

Microfacets make_microfacets(double alpha_u, double alpha_v, Distribution distribution, Masking masking) {
  const bool smooth = !(alpha_u > 0) && !(alpha_v > 0);
  const auto width = [&](double alpha) {
    return smooth ? 0 : alpha > least_alpha ? std::min(alpha, 1e4) : least_alpha;
  };
  return {width(alpha_u), width(alpha_v), distribution, masking};
}

double normal_density(const Microfacets& mf, Vector3d m) {
  if (!(m.z > 0)) return 0;
  const double x = m.x / mf.alpha_u, y = m.y / mf.alpha_v;
  const double area = pi * mf.alpha_u * mf.alpha_v;
  if (mf.distribution == Distribution::ggx) {
    const double q = x * x + y * y + m.z * m.z;  // > 0
    return 1 / (area * q * q);
  }
  const double z2 = m.z * m.z, r2 = x * x + y * y;
  return r2 < 700 * z2 ? quick_exp(-r2 / z2) / (area * z2 * z2) : 0;
}

double visible_area(const Microfacets& mf, Vector3d v) {
  const double s = stretched_length(mf, v);
  return mf.distribution == Distribution::ggx ? (v.z + std::sqrt(v.z * v.z + s * s)) / 2
                                              : beckmann_area(v.z, s);
}

double masking(const Microfacets& mf, Vector3d v, Vector3d m) {
  if (!(dot(v, m) * v.z > 0)) return 0;
  const Vector3d above = v.z < 0 ? -v : v;
  return above.z / visible_area(mf, above);
}

double shadowing_over_cosines(const Microfacets& mf, Vector3d a, double area_a, Vector3d b) {
  if (b.z < 0) b = -b;
  const double area_b = visible_area(mf, b);
  if (mf.masking == Masking::separable) return 1 / (area_a * area_b);
  const double product = area_a * b.z + area_b * a.z - a.z * b.z;  // ≥ a.z·b.z, as σ(v) ≥ v.z
  return product > 0 ? 1 / product : 0;
}

Vector3d sample_visible_normal(const Microfacets& mf, Vector3d v, Point2f u) {
  return mf.distribution == Distribution::ggx ? sample_ggx(mf, v, u) : sample_beckmann(mf, v, u);
}

double visible_normal_pdf(const Microfacets& mf, Vector3d v, Vector3d m) {
  return std::max(0.0, dot(v, m)) * normal_density(mf, m) / visible_area(mf, v);
}

double inverse_erf(double y) {
  const double w = -quick_log(std::max((1 - y) * (1 + y), 1e-15));
  return y *
         (w < 5 ? polynomial(w - 2.5, 1.50140941, 0.246640727, -0.00417768164, -0.00125372503, 0.00021858087,
                             -4.39150654e-06, -3.5233877e-06, 3.43273939e-07, 2.81022636e-08)
                : polynomial(std::sqrt(w) - 3, 2.83297682, 1.00167406, 0.00943887047, -0.0076224613,
                             0.00573950773, -0.00367342844, 0.00134934322, 0.000100950558, -0.000200214257));
}

}  // namespace vitrail
