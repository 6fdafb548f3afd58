// SPDX-License-Identifier: Apache-2.0
// This file has LambertBsdf of diffuse.h, for any number of lanes.
#pragma once

#include "tracer/bsdf/bsdf_lanes.h"
#include "tracer/bsdf/local_lanes.h"

namespace vitrail::lanes {
namespace {

template <class D>
struct Lambert {
  Four<FloatsLike<D>> reflectance;
};

template <class D>
VITRAIL_LANES BsdfValue<D> eval(const Lambert<D>& bsdf, Vector<D> out, Vector<D> in) {
  const D density = in.z / pi;
  BsdfValue<D> f{bsdf.reflectance, density};
  for (int i = 0; i < 4; ++i) f.value[i] = f.value[i] * to_floats(density);
  return detail::where<D>((out.z > 0) & (in.z > 0), f);
}

template <class D>
VITRAIL_LANES BsdfSample<D> sample(const Lambert<D>& bsdf, Vector<D> out, FloatsLike<D> u_x,
                                   FloatsLike<D> u_y) {
  const Vector<D> in = sample_cosine_hemisphere(u_x, u_y);
  const Mask<D> scatters = (out.z > 0) & (in.z > 0);
  return {scatters, in, bsdf.reflectance, in.z / pi, Mask<D>{}};
}

}  // namespace
}  // namespace vitrail::lanes
