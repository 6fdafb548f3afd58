// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/hair.h"

#include <algorithm>
#include <array>

#include "scene/geometry/portable_math.h"
#include "scene/models/hair_color.h"
#include "tracer/bsdf/local.h"
#include "tracer/simd/quick_math.h"

namespace vitrail {

namespace {

constexpr std::size_t lobe_count = 4;  // the last is of all that is reflected more often

double power(double x, int n) {
  double result = 1;
  for (; n > 0; n >>= 1, x *= x)
    if (n & 1) result *= x;
  return result;
}

struct SinCos {
  double sin, cos;
};

// From x = sin(a) and cos(a) by ±b, the cosine taken as positive.
SinCos turned(SinCos a, SinCos b) {
  return {a.sin * b.cos + a.cos * b.sin, std::abs(a.cos * b.cos - a.sin * b.sin)};
}
SinCos doubled(SinCos a) { return {2 * a.sin * a.cos, a.cos * a.cos - a.sin * a.sin}; }

struct Lobe {
  SampledSpectrum attenuation;  // A_p
  double probability = 0;       // in proportion to what the path carries of it
  SinCos theta{0, 1};           // θ_out as the scales turn it
  double variance = 0;
  double turn = 0;  // Φ_p: what a smooth fibre turns φ by; of the last lobe nothing
};

struct Fibre {
  std::array<Lobe, lobe_count> lobes;
  double phi_out = 0;
  bool black = true;  // for what the path carries
};

// A_p, eq. 6 to 8 of d'Eon et al. (2011), summed to infinity in the last.
std::array<SampledSpectrum, lobe_count> attenuations(double fresnel, const SampledSpectrum& transmitted) {
  std::array<SampledSpectrum, lobe_count> a;
  a[0] = filled(static_cast<float>(fresnel));
  for (std::size_t i = 0; i < hero_count; ++i) {
    const double t = static_cast<double>(transmitted.v[i]), once = (1 - fresnel) * (1 - fresnel) * t;
    const double kept = t * fresnel;  // of each reflection within
    a[1].v[i] = static_cast<float>(once);
    a[2].v[i] = static_cast<float>(once * kept);
    a[3].v[i] = kept < 1 ? static_cast<float>(once * kept * kept / (1 - kept)) : 0;
  }
  return a;
}

SampledSpectrum transmittance(const SampledSpectrum& sigma_a, double length) {
  SampledSpectrum t;
  for (std::size_t i = 0; i < hero_count; ++i)
    t.v[i] = static_cast<float>(lanes::quick_exp(-static_cast<double>(sigma_a.v[i]) * length));
  return t;
}

Fibre fibre_of(const HairBsdf& bsdf, Vector3d out) {
  Fibre fibre;
  const double across = std::sqrt(out.y * out.y + out.z * out.z);
  const bool along = across < 1e-10;  // every φ is as good
  const SinCos theta{along ? std::copysign(1.0, out.x) : out.x, std::min(across, 1.0)};
  // γ: from the normal, turned over where it points away, to `out`, in the plane across the fibre; h = sin γ.
  const double normal = out.z < 0 ? -pi / 2 : pi / 2;
  fibre.phi_out = along ? normal : portable_atan2(out.z, out.y);
  const double gamma = fibre.phi_out - normal, cos_gamma = along ? 1 : std::abs(out.z) / across;
  const double h = along ? 0 : (out.z < 0 ? out.y : -out.y) / across;

  // Refracted: θ by Snell's law, γ by it with the index that the plane across the fibre sees (Marschner et
  // al. 2003, appendix B).
  const double sin_theta_t = std::clamp(theta.sin / bsdf.eta, -1.0, 1.0);
  const double cos_theta_t = std::max(safe_sqrt(1 - sin_theta_t * sin_theta_t), 1e-6);
  const double index = std::max(safe_sqrt(bsdf.eta * bsdf.eta - theta.sin * theta.sin), 1e-6);
  const double sin_gamma_t = std::clamp(h * theta.cos / index, -1.0, 1.0);
  const double cos_gamma_t = safe_sqrt(1 - sin_gamma_t * sin_gamma_t);
  const double gamma_t = portable_atan2(sin_gamma_t, cos_gamma_t);

  const double fresnel = fresnel_dielectric(std::min(theta.cos * cos_gamma, 1.0), bsdf.eta);
  const auto a = attenuations(fresnel, transmittance(bsdf.sigma_a, 2 * cos_gamma_t / cos_theta_t));
  const SinCos once{bsdf.sin_alpha, bsdf.cos_alpha}, twice = doubled(once), four = doubled(twice);
  const SinCos turns[lobe_count] = {{-twice.sin, twice.cos}, once, four, {0, 1}};
  constexpr double widths[lobe_count] = {1, 0.25, 4, 4};  // of the variance
  double all = 0;
  for (std::size_t p = 0; p < lobe_count; ++p) {
    Lobe& lobe = fibre.lobes[p];
    lobe.attenuation = a[p];
    lobe.probability = carried(bsdf.throughput, a[p]);
    lobe.theta = turned(theta, turns[p]);
    lobe.variance = widths[p] * bsdf.variance;
    lobe.turn = static_cast<double>(p) * (2 * gamma_t + pi) - 2 * gamma;
    all += lobe.probability;
  }
  fibre.black = !(all > 0);
  for (Lobe& lobe : fibre.lobes) lobe.probability = fibre.black ? 0 : lobe.probability / all;
  return fibre;
}

// M_p(θ_out, θ_in), normalised over cos θ_in dθ_in (d'Eon et al. 2011, eq. 7):
//   e^(−sin θ_out sin θ_in/v) I₀(cos θ_out cos θ_in/v) / (2v sinh(1/v)).
double longitudinal(const Lobe& lobe, SinCos in) {
  const double inverse = 1 / lobe.variance, bessel_at = lobe.theta.cos * in.cos * inverse;
  return lanes::quick_exp(bessel_at - (lobe.theta.sin * in.sin + 1) * inverse) * scaled_bessel_i0(bessel_at) *
         inverse / (1 - lanes::quick_exp(-2 * inverse));
}

// The logistic distribution about 0, cut at ±π.
double logistic(double x, double scale) {
  const double e = lanes::quick_exp(-std::abs(x) / scale), end = lanes::quick_exp(-pi / scale);
  return e * (1 + end) / (scale * (1 + e) * (1 + e) * (1 - end));
}
double sample_logistic(double u, double scale) {
  const double end = lanes::quick_exp(-pi / scale), below = end / (1 + end);  // of what is cut off
  const double y = std::clamp(below + u * (1 - 2 * below), 1e-12, 1 - 1e-12);
  return std::clamp(scale * lanes::quick_log(y / (1 - y)), -pi, pi);
}

double wrapped(double angle) { return angle - 2 * pi * std::nearbyint(angle / (2 * pi)); }

BsdfValue eval(const HairBsdf& bsdf, const Fibre& fibre, Vector3d in) {
  BsdfValue result;
  const SinCos theta{in.x, std::min(std::sqrt(in.y * in.y + in.z * in.z), 1.0)};
  const double turn = portable_atan2(in.z, in.y) - fibre.phi_out;
  for (std::size_t p = 0; p < lobe_count; ++p) {
    const Lobe& lobe = fibre.lobes[p];
    const double azimuthal =
        p + 1 < lobe_count ? logistic(wrapped(turn - lobe.turn), bsdf.spread) : 1 / (2 * pi);
    const double density = longitudinal(lobe, theta) * azimuthal;
    result.value = result.value + lobe.attenuation * static_cast<float>(density);
    result.pdf += lobe.probability * density;
  }
  return result;
}

}  // namespace

double scaled_bessel_i0(double x) {  // Abramowitz & Stegun 1964, 9.8.1 and 9.8.2
  const double t = x / 3.75;
  if (t < 1)
    return lanes::quick_exp(-x) *
           lanes::polynomial(t * t, 1, 3.5156229, 3.0899424, 1.2067492, 0.2659732, 0.0360768, 0.0045813);
  return lanes::polynomial(1 / t, 0.39894228, 0.01328592, 0.00225319, -0.00157565, 0.00916281, -0.02057706,
                           0.02635537, -0.01647633, 0.00392377) /
         std::sqrt(x);
}

HairBsdf make_hair(const SampledSpectrum& sigma_a, const SampledSpectrum& throughput, double eta,
                   double beta_m, double beta_n, double alpha_deg) {
  const double m = std::clamp(beta_m, 0.01, 1.0), n = std::clamp(beta_n, 0.01, 1.0);
  const double deviation = 0.726 * m + 0.812 * m * m + 3.7 * power(m, 20);
  const double scale = 0.265 * n + 1.194 * n * n + 5.372 * power(n, 22);
  const double alpha = alpha_deg * pi / 180;
  return {.sigma_a = sigma_a,
          .throughput = throughput,
          .eta = eta,
          .variance = deviation * deviation,
          .spread = std::sqrt(pi / 8) * scale,
          .sin_alpha = portable_sin(alpha),
          .cos_alpha = portable_cos(alpha)};
}

SampledSpectrum hair_absorption(const SampledSpectrum& color, double beta_n) {
  const double scale = hair_color_scale(beta_n);
  SampledSpectrum sigma_a;
  for (std::size_t i = 0; i < hero_count; ++i) {
    const double c = std::clamp(static_cast<double>(color.v[i]), 1e-30, 1.0);
    const double root = lanes::quick_log(c) / scale;
    sigma_a.v[i] = static_cast<float>(root * root);
  }
  return sigma_a;
}

BsdfValue eval(const HairBsdf& bsdf, Vector3d out, Vector3d in) {
  return eval(bsdf, fibre_of(bsdf, out), in);
}

double pdf(const HairBsdf& bsdf, Vector3d out, Vector3d in) { return eval(bsdf, out, in).pdf; }

std::optional<BsdfSample> sample(const HairBsdf& bsdf, Vector3d out, float u_lobe, Point2f u) {
  const Fibre fibre = fibre_of(bsdf, out);
  if (fibre.black) return std::nullopt;
  std::size_t p = 0;
  double rest = static_cast<double>(u_lobe);
  while (p + 1 < lobe_count && rest >= fibre.lobes[p].probability) rest -= fibre.lobes[p++].probability;
  const Lobe& lobe = fibre.lobes[p];
  const double azimuth = lobe.probability > 0 ? std::clamp(rest / lobe.probability, 0.0, 1.0) : 0.5;

  // θ about −θ_out (d'Eon, Marschner & Hanika, "Importance Sampling for Physically-Based Hair Fiber Models",
  // 2013).
  const double x = 1 - static_cast<double>(u.x);  // above 0
  const double cosine = std::max(
      1 + lobe.variance * lanes::quick_log(x + (1 - x) * lanes::quick_exp(-2 / lobe.variance)), -1.0);
  const double sine = safe_sqrt(1 - cosine * cosine) * lanes::quick_circle(static_cast<double>(u.y)).cosine;
  const double sin_theta = std::clamp(sine * lobe.theta.cos - cosine * lobe.theta.sin, -1.0, 1.0);
  const double cos_theta = safe_sqrt(1 - sin_theta * sin_theta);
  const double phi = fibre.phi_out + (p + 1 < lobe_count ? lobe.turn + sample_logistic(azimuth, bsdf.spread)
                                                         : 2 * pi * azimuth);
  const Vector3d in =
      normalize(Vector3d{sin_theta, cos_theta * portable_cos(phi), cos_theta * portable_sin(phi)});
  const BsdfValue value = eval(bsdf, fibre, in);
  if (!(value.pdf > 0)) return std::nullopt;
  return BsdfSample{.in = in, .weight = value.value * static_cast<float>(1 / value.pdf), .pdf = value.pdf};
}

}  // namespace vitrail
