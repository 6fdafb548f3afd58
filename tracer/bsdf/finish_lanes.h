// SPDX-License-Identifier: Apache-2.0
// This file has FinishBsdf of finish.h, for any number of lanes.
#pragma once

#include "tracer/bsdf/bsdf_lanes.h"
#include "tracer/bsdf/local_lanes.h"
#include "tracer/simd/portable_math_lanes.h"

namespace vitrail::lanes {
namespace {

template <class D>
struct Finish {
  Four<FloatsLike<D>> reflectance, highlight;
  D brilliance, phong, phong_size, specular, roughness;
};

namespace detail {

template <class D>
VITRAIL_LANES D highlight_of(const Finish<D>& b, Vector<D> out, Vector<D> in) {
  D sum = fill<D>(0);
  const D cosine = out.z * in.z - out.x * in.x - out.y * in.y;  // to the mirrored direction
  const Mask<D> of_phong = (b.phong > 0) & (cosine > 0);
  if (any(of_phong)) sum = select<D>(of_phong, b.phong * portable_pow<D>(cosine, b.phong_size), sum);
  const Mask<D> of_half = b.specular > 0;
  if (any(of_half)) {
    const D half = normalize(out + in).z;
    sum = select<D>(of_half, sum + b.specular * portable_pow<D>(half, 1.0 / b.roughness), sum);
  }
  return sum;
}

}  // namespace detail

template <class D>
VITRAIL_LANES BsdfValue<D> eval(const Finish<D>& b, Vector<D> out, Vector<D> in) {
  const Mask<D> plain = b.brilliance == 1;
  const D diffuse = all(plain) ? in.z : select<D>(plain, in.z, portable_pow<D>(in.z, b.brilliance));
  const FloatsLike<D> base = to_floats(diffuse / pi),
                      highlight = to_floats(detail::highlight_of(b, out, in) / pi);
  BsdfValue<D> f;
  for (int i = 0; i < 4; ++i) f.value[i] = b.reflectance[i] * base + b.highlight[i] * highlight;
  f.pdf = (0.5 * in.z + 0.25) / pi;
  return detail::where<D>((out.z > 0) & (in.z > 0), f);
}

template <class D>
VITRAIL_LANES BsdfSample<D> sample(const Finish<D>& b, Vector<D> out, FloatsLike<D> u_lobe, FloatsLike<D> u_x,
                                   FloatsLike<D> u_y) {
  const Vector<D> cosine = sample_cosine_hemisphere(u_x, u_y);
  // z² is uniform over cosine-weighted directions, and z over even ones.
  const D z = cosine.z * cosine.z, across = safe_sqrt(1.0 - z * z),
          before = safe_sqrt(1.0 - cosine.z * cosine.z);
  const D scale = across / before;
  const Vector<D> even =
      select<D>(before > 0, Vector<D>{cosine.x * scale, cosine.y * scale, z}, fill<D>(Vector3d{0, 0, 1}));
  const Vector<D> in = select<D>(mask_for<D>(u_lobe < 0.5f), even, cosine);
  const BsdfValue<D> value = eval(b, out, in);
  const FloatsLike<D> weight = to_floats(1.0 / value.pdf);
  BsdfSample<D> s{value.pdf > 0, in, value.value, value.pdf, Mask<D>{}};
  for (int i = 0; i < 4; ++i) s.weight[i] = s.weight[i] * weight;
  return s;
}

}  // namespace
}  // namespace vitrail::lanes
