// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/fourier.h"

#include <algorithm>
#include <cmath>

#include "scene/geometry/portable_math.h"
#include "tracer/bsdf/invert.h"
#include "tracer/bsdf/spline.h"

namespace vitrail {

namespace {

// What 4 × 4 pairs of nodes add to a pair of cosines.
struct Term {
  double weight;
  const float* coefficients;  // [channel][order]
  std::size_t orders;
};

struct Terms {
  std::array<Term, 16> list;
  std::size_t count = 0, orders = 0;  // `orders` the most of any
};

Terms terms_of(const FourierTable& t, const SplineWeights& out, const SplineWeights& in) {
  Terms terms;
  for (std::size_t o = 0; o < 4; ++o)
    for (std::size_t i = 0; i < 4; ++i) {
      const double weight = out.weight[o] * in.weight[i];
      if (weight == 0) continue;
      const std::size_t pair =
          (static_cast<std::size_t>(out.first) + o) * t.mu.size() + static_cast<std::size_t>(in.first) + i;
      const std::size_t orders = t.orders[pair];
      if (orders == 0) continue;
      terms.list[terms.count++] = {weight, t.coefficients.data() + t.first[pair], orders};
      terms.orders = std::max(terms.orders, orders);
    }
  return terms;
}

// Σ aₖ cos kφ of each channel: cos kφ = 2 cos φ·cos (k − 1)φ − cos (k − 2)φ.
std::array<double, 3> series(const FourierTable& t, const Terms& terms, double cos_phi) {
  std::array<double, 3> sum{};
  double cosine = 1, before = cos_phi;
  for (std::size_t k = 0; k < terms.orders; ++k) {
    for (std::size_t n = 0; n < terms.count; ++n) {
      const Term& term = terms.list[n];
      if (k >= term.orders) continue;
      for (std::size_t c = 0; c < t.channels; ++c)
        sum[c] += term.weight * cosine * static_cast<double>(term.coefficients[c * term.orders + k]);
    }
    const double next = 2 * cos_phi * cosine - before;
    before = cosine, cosine = next;
  }
  return sum;
}

double a0(const FourierTable& t, std::size_t out, std::size_t in) {
  const std::size_t pair = out * t.mu.size() + in;
  return t.orders[pair] > 0 ? static_cast<double>(t.coefficients[t.first[pair]]) : 0;
}

// Σ w·value(μₒ node).
template <class Value>
double along_out(const SplineWeights& out, const Value& value) {
  double sum = 0;
  for (std::size_t o = 0; o < 4; ++o)
    if (out.weight[o] != 0) sum += out.weight[o] * value(static_cast<std::size_t>(out.first) + o);
  return sum;
}

double integral_up_to(const FourierBsdf& b, const SplineWeights& out, std::size_t in) {
  const std::size_t nodes = b.table->mu.size();
  return along_out(out, [&](std::size_t o) { return b.integrals->up_to[o * nodes + in]; });
}

// The cosine of the difference of azimuths between light that travels along −in and the eye's direction.
double cosine_of_azimuths(Vector3d out, Vector3d in) {
  const double lengths = (out.x * out.x + out.y * out.y) * (in.x * in.x + in.y * in.y);
  if (!(lengths > 0)) return 1;
  return std::clamp(-(out.x * in.x + out.y * in.y) / std::sqrt(lengths), -1.0, 1.0);
}

// Radiance is compressed where it comes from the other side.
double compression(const FourierTable& t, Vector3d out, Vector3d in) {
  const auto eta = static_cast<double>(t.eta);
  if (!(out.z * in.z < 0)) return 1;
  return out.z > 0 ? 1 / (eta * eta) : eta * eta;
}

SampledSpectrum color_of(const FourierBsdf& b, const std::array<double, 3>& channels, double scale) {
  const double y = channels[0];
  if (b.table->channels == 1) return filled(static_cast<float>(std::max(0.0, y) * scale));
  // Y = 0.212671 R + 0.715160 G + 0.072169 B.
  const double red = channels[1], blue = channels[2];
  const double green = (y - 0.212671 * red - 0.072169 * blue) / 0.715160;
  SampledSpectrum sum{};
  std::size_t i = 0;
  for (const double c : {red, green, blue})
    sum = sum + b.primaries[i++] * static_cast<float>(std::max(0.0, c) * scale);
  return sum;
}

// The μᵢ up to which the integral of a₀ is that part of the whole.
std::optional<double> sample_cosine(const FourierBsdf& b, const SplineWeights& out, double u) {
  const std::span<const float> mu = b.table->mu;
  const double target = u * integral_up_to(b, out, mu.size() - 1);
  std::size_t low = 0, high = mu.size() - 1;  // the interval lies between them
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (integral_up_to(b, out, middle) <= target ? low : high) = middle;
  }
  const SplineSegment segment = spline_segment(mu, low, [&](std::size_t in) {
    return along_out(out, [&](std::size_t o) { return a0(*b.table, o, in); });
  });
  if (!(segment.width > 0)) return std::nullopt;
  const double t = invert(
      [&](double x) {
        return std::pair{segment.integral(x), segment.width * segment.at(x)};
      },
      0, 1, target - integral_up_to(b, out, low));
  return static_cast<double>(mu[low]) + t * segment.width;
}

// The azimuth φ ∈ [0, π] up to which the integral of the luminance is that part of the whole, π·a₀.
std::optional<double> sample_azimuth(const Terms& terms, double u) {
  std::array<double, max_fourier_orders> a;
  std::fill_n(a.begin(), terms.orders, 0.0);
  for (std::size_t n = 0; n < terms.count; ++n)
    for (std::size_t k = 0; k < terms.list[n].orders; ++k)
      a[k] += terms.list[n].weight * static_cast<double>(terms.list[n].coefficients[k]);
  if (terms.orders == 0 || !(a[0] > 0)) return std::nullopt;
  const auto integral = [&](double phi) {
    const double cos1 = portable_cos(phi), sin1 = portable_sin(phi);
    double cosine = 1, sine = 0, sum = a[0] * phi, density = a[0];
    for (std::size_t k = 1; k < terms.orders; ++k) {
      const double next = cosine * cos1 - sine * sin1;
      sine = sine * cos1 + cosine * sin1, cosine = next;
      sum += a[k] / static_cast<double>(k) * sine, density += a[k] * cosine;
    }
    return std::pair{sum, density};
  };
  return invert(integral, 0, pi, u * pi * a[0]);
}

}  // namespace

FourierIntegrals integrals_of(const FourierTable& t) {
  const std::size_t nodes = t.mu.size();
  FourierIntegrals integrals;
  integrals.up_to.reserve(nodes * nodes);
  for (std::size_t o = 0; o < nodes; ++o) {
    double sum = 0;
    integrals.up_to.push_back(0);
    for (std::size_t i = 0; i + 1 < nodes; ++i) {
      sum += spline_segment(t.mu, i, [&](std::size_t in) { return a0(t, o, in); }).integral(1);
      integrals.up_to.push_back(sum);
    }
  }
  return integrals;
}

BsdfValue eval(const FourierBsdf& b, Vector3d out, Vector3d in) {
  const auto from = spline_weights(b.table->mu, -in.z), to = spline_weights(b.table->mu, out.z);
  if (!from || !to || out.z == 0) return {};
  const auto channels = series(*b.table, terms_of(*b.table, *to, *from), cosine_of_azimuths(out, in));
  const double whole = 2 * pi * integral_up_to(b, *to, b.table->mu.size() - 1);
  return {color_of(b, channels, compression(*b.table, out, in)),
          whole > 0 ? std::max(0.0, channels[0] / whole) : 0};
}

double pdf(const FourierBsdf& b, Vector3d out, Vector3d in) { return eval(b, out, in).pdf; }

std::optional<BsdfSample> sample(const FourierBsdf& b, Vector3d out, float, Point2f u) {
  const auto to = spline_weights(b.table->mu, out.z);
  if (!to || !(integral_up_to(b, *to, b.table->mu.size() - 1) > 0)) return std::nullopt;
  const auto mu = sample_cosine(b, *to, static_cast<double>(u.y));
  const auto from = mu ? spline_weights(b.table->mu, *mu) : std::nullopt;
  if (!from) return std::nullopt;
  // The two halves of the circle are alike.
  const double turn = 2 * static_cast<double>(u.x);
  const auto phi = sample_azimuth(terms_of(*b.table, *to, *from), turn < 1 ? turn : 2 - turn);
  if (!phi) return std::nullopt;
  const double c = portable_cos(*phi), s = turn < 1 ? portable_sin(*phi) : -portable_sin(*phi);
  const double length = std::sqrt(out.x * out.x + out.y * out.y), sine = safe_sqrt(1 - *mu * *mu);
  const double x = length > 0 ? out.x / length : 1, y = length > 0 ? out.y / length : 0;
  const Vector3d in = normalize(Vector3d{-sine * (c * x - s * y), -sine * (s * x + c * y), -*mu});
  const BsdfValue value = eval(b, out, in);
  if (!(value.pdf > 0)) return std::nullopt;
  return BsdfSample{.in = in, .weight = value.value * static_cast<float>(1 / value.pdf), .pdf = value.pdf};
}

}  // namespace vitrail
