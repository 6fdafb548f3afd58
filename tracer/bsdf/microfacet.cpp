// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/microfacet.h"

#include "tracer/portable_math.h"

namespace vitrail {

namespace {

using Distribution = Roughness::Distribution;

constexpr double sqrt_pi = 1.77245385090551602730;

// Beckmann's σ from v.z = z and the length s of v's horizontal part stretched by α (Walter et al. 2007,
// Eq. 26's exact form; Heitz 2014, Eq. 66).
double beckmann_area(double z, double s) {
  if (std::abs(z) >= 6 * s) return std::max(z, 0.0);  // 1 − erf 6 < 3e-17
  const double a = z / s;                             // |z| < 6·s, so s > 0
  return (z * (1 + portable_erf(a)) + s / sqrt_pi * portable_exp(-a * a)) / 2;
}

double stretched_length(const Microfacets& mf, Vector3d v) {
  const double x = mf.alpha_u * v.x, y = mf.alpha_v * v.y;
  return std::sqrt(x * x + y * y);
}

Vector3d sample_ggx(const Microfacets& mf, Vector3d v, Point2f u) {
  const Vector3d w = normalize(Vector3d{mf.alpha_u * v.x, mf.alpha_v * v.y, v.z});
  const double phi = 2 * static_cast<double>(u.x);  // in units of π
  const double z = (1 - static_cast<double>(u.y)) * (1 + w.z) - w.z;
  const double s = safe_sqrt(1 - z * z);
  // Its z is (1 − u.y)·(1 + w.z) > 0.
  const Vector3d h = w + Vector3d{s * sin_pi(phi + 0.5), s * sin_pi(phi), z};
  return normalize(Vector3d{mf.alpha_u * h.x, mf.alpha_v * h.y, h.z});
}

// Slope towards the viewer at polar angle θ on a surface of unit width: its density is in proportion to
// max(0, cosθ + x·sinθ)·exp(−x²). Solved for t = erf(−x), in which the cumulative distribution
// cosθ·(1 + t)/2 + sinθ·exp(−x²)/(2√π) is concave, by Newton's method kept within a bracket.
double sample_beckmann_slope(double cosine, double sine, double u) {
  const double limit = cosine < 4 * sine ? portable_erf(cosine / sine) : 1;
  const auto cumulative = [&](double t, double x) {
    return (cosine * (1 + t) + sine / sqrt_pi * portable_exp(-x * x)) / 2;
  };
  const double target = std::max(u, 1e-9) * beckmann_area(cosine, sine);
  double low = -1, high = limit, t = -1 + std::max(u, 1e-9) * (1 + limit);
  constexpr int most_steps = 12;  // about four are taken
  bool close = false;
  for (int step = 0; step < most_steps && !close; ++step) {
    const double x = inverse_erf(t), error = cumulative(t, x) - target;
    (error > 0 ? high : low) = t;
    close = std::abs(error) < 1e-4 * target;  // and 1e-8 a step later
    const double slope = (cosine - x * sine) / 2;
    const double next = slope > 0 ? t - error / slope : low;
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
  const double z2 = m.z * m.z, exponent = (x * x + y * y) / z2;
  return exponent < 700 ? portable_exp(-exponent) / (area * z2 * z2) : 0;
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

double shadowing_over_cosines(const Microfacets& mf, Vector3d a, Vector3d b) {
  if (a.z < 0) a = -a;
  if (b.z < 0) b = -b;
  const double area_a = visible_area(mf, a), area_b = visible_area(mf, b);
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
  const auto polynomial = [](const auto& coefficients, double w) {
    double sum = 0;
    for (double c : coefficients) sum = c + sum * w;
    return sum;
  };
  constexpr double central[] = {2.81022636e-08,  3.43273939e-07, -3.5233877e-06,
                                -4.39150654e-06, 0.00021858087,  -0.00125372503,
                                -0.00417768164,  0.246640727,    1.50140941};
  constexpr double tail[] = {-0.000200214257, 0.000100950558, 0.00134934322, -0.00367342844, 0.00573950773,
                             -0.0076224613,   0.00943887047,  1.00167406,    2.83297682};
  const double w = -portable_log(std::max((1 - y) * (1 + y), 1e-15));
  return y * (w < 5 ? polynomial(central, w - 2.5) : polynomial(tail, std::sqrt(w) - 3));
}

}  // namespace vitrail
