// SPDX-License-Identifier: Apache-2.0
// Functions in lanes of spheres that emit.
#pragma once

#include "tests/tracer/lanes/context.h"
#include "tests/tracer/lanes/lane_table.h"
#include "tracer/lanes/rays.h"
#include "tracer/lights/sphere_light_lanes.h"

namespace vitrail::lane_tests {
namespace {

// Of sphere in[0], from in[1…4), with the numbers in[4], in[5].
LANE_FUNCTION(sample_sphere, 6, 13) {
  using D = lanes::Doubles<W>;
  const auto s = lanes::sample_sphere<D>(in.vector(1), in.f(4), in.f(5), [&](int j) -> const PlacedQuadric& {
    return context.spheres[static_cast<int>(in.numbers[j * in.stride])];
  });
  const auto kept = [&](D x) { return lanes::select<D>(s.arrives, x, lanes::fill<D>(0)); };
  out.mask(s.arrives), out.number(kept(lanes::select<D>(s.outside, lanes::fill<D>(1), lanes::fill<D>(0))));
  for (const auto& v : {s.local, s.to_light, s.normal})
    out.number(kept(v.x)), out.number(kept(v.y)), out.number(kept(v.z));
  out.number(kept(s.distance)), out.number(kept(s.pdf));
}
// Of sphere in[0], by a ray from in[1…4) along in[4…7), which starts on it if in[7] > 0.
LANE_FUNCTION(sphere_crossings, 8, 4) {
  using D = lanes::Doubles<W>;
  const auto [first, second] = lanes::sphere_crossings(
      lanes::to_floats(in.vector(1)), lanes::to_floats(in.vector(4)),
      [&](int j) -> const PlacedQuadric& {
        return context.spheres[static_cast<int>(in.numbers[j * in.stride])];
      },
      in.d(7) > 0);
  const auto kept = [](const auto& at) { return lanes::select<D>(at.is_hit, at.t, lanes::fill<D>(0)); };
  out.mask(first.is_hit | second.is_hit), out.mask(first.is_hit & second.is_hit);
  out.number(lanes::select<D>(first.is_hit, first.t, kept(second)));
  out.number(lanes::select<D>(first.is_hit, kept(second), lanes::fill<D>(0)));
}
// The same, along in[4…7) to what is in[8] away.
LANE_FUNCTION(aim_at_sphere, 9, 1) {
  using D = lanes::Doubles<W>;
  const auto p = in.vector(1);
  const auto origin = lanes::to_floats(p);
  const auto nothing = lanes::fill<D>(Vector3d{});
  const auto aimed = lanes::aim<D>(p, origin, {in.vector(4), in.d(8), nothing, lanes::fill<D>(0)},
                                   lanes::fill<D>(0) == lanes::fill<D>(0));
  out.number(lanes::end_on_sphere(
      origin, aimed,
      [&](int j) -> const PlacedQuadric& {
        return context.spheres[static_cast<int>(in.numbers[j * in.stride])];
      },
      in.d(7) > 0));
}

}  // namespace
}  // namespace vitrail::lane_tests
