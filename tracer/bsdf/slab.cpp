// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/slab.h"

#include <algorithm>
#include <cmath>

#include "tracer/bsdf/layer_random_lanes.h"
#include "tracer/bsdf/local.h"

namespace vitrail {

namespace {

// (1 − e^(−x))/x, x ≥ 0.
double mean_exp(double x) {
  if (x < 1e-4) return 1 - x / 2 + x * x / 6;
  return (1 - portable_exp(-x)) / x;
}

// Both of the equations are ϖ p τ·e^(−τ/a)·mean_exp(τ·Δ): of light that is reflected Δ = 1/c + 1/c' and there
// is no e, of light that goes through a is the greater cosine and Δ the difference of the inverses.
double scattered(double depth, double c_out, double c_in, bool reflects) {
  if (reflects) return depth * mean_exp(depth * (1 / c_out + 1 / c_in));
  const double greater = std::max(c_out, c_in), less = std::min(c_out, c_in);
  return depth * portable_exp(-depth / greater) * mean_exp(depth * (1 / less - 1 / greater));
}

// How likely `sample` is to go straight on.
double straight_chance(const SlabBsdf& b, double cosine) {
  const double all = carried(b.throughput, filled(1));
  return all > 0 ? attainable(carried(b.throughput, straight_transmittance(b, cosine)) / all) : 0;
}

}  // namespace

SampledSpectrum straight_transmittance(const SlabBsdf& b, double cosine) {
  SampledSpectrum t;
  for (std::size_t i = 0; i < hero_count; ++i)
    t.v[i] = static_cast<float>(
        lanes::slab_transmittance<double>(static_cast<double>(b.depth.v[i]), {0, 0, cosine}));
  return t;
}

BsdfValue eval(const SlabBsdf& b, Vector3d out, Vector3d in) {
  if (out.z == 0 || in.z == 0) return {};
  const double p = lanes::henyey_greenstein(b.g, -dot(out, in));
  BsdfValue result{.value = {}, .pdf = p * (1 - straight_chance(b, std::abs(out.z)))};
  for (std::size_t i = 0; i < hero_count; ++i)
    result.value.v[i] = static_cast<float>(
        static_cast<double>(b.albedo.v[i]) * p *
        scattered(static_cast<double>(b.depth.v[i]), std::abs(out.z), std::abs(in.z), out.z * in.z > 0));
  return result;
}

double pdf(const SlabBsdf& b, Vector3d out, Vector3d in) { return eval(b, out, in).pdf; }

std::optional<BsdfSample> sample(const SlabBsdf& b, Vector3d out, float u_lobe, Point2f u) {
  const auto chance = static_cast<float>(straight_chance(b, std::abs(out.z)));
  if (u_lobe < chance)
    return BsdfSample{
        .in = -out, .weight = straight_transmittance(b, std::abs(out.z)) * (1 / chance), .specular = true};
  const Vector3d in =
      lanes::lane(lanes::sample_henyey_greenstein<double>(b.g, lanes::fill<double>(-out), u.x, u.y), 0);
  const BsdfValue value = eval(b, out, in);
  if (!(value.pdf > 0)) return std::nullopt;
  return BsdfSample{.in = in, .weight = value.value * static_cast<float>(1 / value.pdf), .pdf = value.pdf};
}

}  // namespace vitrail
