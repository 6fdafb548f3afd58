// SPDX-License-Identifier: Apache-2.0
// A SlabBsdf is a slab of a medium of optical depth τ, in which light scatters once. It follows Hanrahan and
// Krueger, "Reflection from Layered Surfaces due to Subsurface Scattering" (1993). Its boundaries do nothing.
// As in Mitsuba 0.6, f has a factor |cos θ_out| more than theirs: the slab is darker towards grazing, and f
// is not reciprocal. With c, c' the two cosines and ϖ the albedo, f·|cos θ_in| is
//
//   ϖ p c c'/(c + c')·(1 − e^(−τ(1/c + 1/c')))   where light is reflected,
//   ϖ p c c'/(c − c')·(e^(−τ/c) − e^(−τ/c'))     where it goes through.
//
// Light that does not meet anything, e^(−τ/c), goes straight on: a delta.
#pragma once

#include <optional>

#include "tracer/bsdf/bsdf.h"

namespace vitrail {

struct SlabBsdf {
  SampledSpectrum depth, albedo;  // τ ≥ 0
  double g = 0;
  SampledSpectrum throughput = filled(1);  // of the path: guides its choice
};

// Returns the share that goes straight on, along a direction that makes this cosine with the normal.
SampledSpectrum straight_transmittance(const SlabBsdf& bsdf, double cosine);

BsdfValue eval(const SlabBsdf& bsdf, Vector3d out, Vector3d in);
double pdf(const SlabBsdf& bsdf, Vector3d out, Vector3d in);
std::optional<BsdfSample> sample(const SlabBsdf& bsdf, Vector3d out, float u_lobe, Point2f u);

}  // namespace vitrail
