// SPDX-License-Identifier: Apache-2.0
// This file has light from one point to many, for any number of lanes, of emitters whose shapes are plain.
#pragma once

#include "tracer/lights/point_emitter.h"
#include "tracer/simd/portable_math_lanes.h"
#include "tracer/simd/vectors.h"

namespace vitrail::lanes {
namespace {

// Returns the part of its intensity that a spot without a texture sends where the cosine to its axis is z.
// spot(j) is the SpotShape of lane j.
template <class D, class SpotOf>
VITRAIL_LANES D spot_part(D z, const SpotOf& spot) {
  using Falloff = SpotLight::Falloff;
  const auto number = [&](double SpotShape::*of) __attribute__((always_inline)) {
    return gather<D>([&](int j) __attribute__((always_inline)) { return spot(j).*of; });
  };
  const auto falls = [&](Falloff falloff) __attribute__((always_inline)) {
    return gather_mask<D>([&](int j) __attribute__((always_inline)) { return spot(j).falloff == falloff; });
  };
  const D cos_beam = number(&SpotShape::cos_beam), cos_cutoff = number(&SpotShape::cos_cutoff);
  const D x = (z - cos_cutoff) / (cos_beam - cos_cutoff);
  D part = select<D>(falls(Falloff::quartic), x * x * x * x, x * x * (3.0 - 2.0 * x));
  if (const Mask<D> linear = falls(Falloff::linear) & (z < cos_beam); any(linear)) {
    const D cutoff = number(&SpotShape::cutoff_rad), width = cutoff - number(&SpotShape::beam_rad);
    const D within = lanes::clamp<D>((cutoff - portable_acos(z)) / width, 0.0, 1.0);
    part = select<D>(linear, select<D>(width > 0, within, fill<D>(1)), part);
  }
  part = select<D>(z >= cos_beam, fill<D>(1), part);
  const D tightness = number(&SpotShape::tightness);
  if (const Mask<D> tight = tightness != 0; any(tight))
    part = select<D>(tight, part * portable_pow<D>(z, tightness), part);
  return select<D>(z > cos_cutoff, part, fill<D>(0));
}

template <class D>
struct EmitterSample {
  Mask<D> arrives;
  Vector<D> to_light;
  D distance;
  // The irradiance across the direction is part · spectrum · weakening, in this order.
  FloatsLike<D> part, weakening;
};

// It is draw_emitter. emitter(j) is the PointEmitter of lane j, whose shape is plain.
template <class D, class EmitterOf>
VITRAIL_LANES EmitterSample<D> draw_emitter(Vector<D> p, const EmitterOf& emitter) {
  EmitterSample<D> s;
  const Vector<D> position = gather_vector<D>([&](int j) __attribute__((always_inline))->const Point3d& {
    return emitter(j).position;
  });
  const Vector<D> towards = position - p;
  const D distance2 = dot(towards, towards);
  s.arrives = distance2 > 0;
  s.distance = lanes::sqrt(distance2);
  s.to_light = towards * (1.0 / s.distance);
  const auto row = [&](int i) __attribute__((always_inline)) {
    const auto column = [&](int k) __attribute__((always_inline)) {
      return gather<D>([&](int j) __attribute__((always_inline)) {
        return emitter(j).shape.get()->world_to_light.m[i][k];
      });
    };
    return dot(Vector<D>{column(0), column(1), column(2)}, -s.to_light);
  };
  const Vector<D> local = normalize(Vector<D>{row(0), row(1), row(2)});
  s.part = to_floats(spot_part(
      local.z, [&](int j) __attribute__((always_inline))->const SpotShape& {
        return *emitter(j).shape.get()->plain();
      }));
  D weakening = 1.0 / distance2;
  const Mask<D> fades =
      gather_mask<D>([&](int j) __attribute__((always_inline)) { return emitter(j).fading != nullptr; });
  if (any(fades)) {  // as weakened (scene/models/fading.h)
    const auto of = [&](float Fading::*number, double otherwise) __attribute__((always_inline)) {
      return gather<D>([&](int j) __attribute__((always_inline)) {
        const Fading* const fading = emitter(j).fading;
        return fading && fading->fade_distance > 0 && fading->fade_power > 0 ? double{fading->*number}
                                                                             : otherwise;
      });
    };
    const D power = of(&Fading::fade_power, 0);
    const D ratio = s.distance / of(&Fading::fade_distance, 1);
    const Mask<D> squares = power == 2;
    const D raised =
        all(squares) ? ratio * ratio : select<D>(squares, ratio * ratio, portable_pow<D>(ratio, power));
    const D faded = select<D>(power > 0, 2.0 / (1.0 + raised), fill<D>(1));
    weakening = select<D>(fades, faded, weakening);
  }
  s.weakening = to_floats(weakening);
  return s;
}

}  // namespace
}  // namespace vitrail::lanes
