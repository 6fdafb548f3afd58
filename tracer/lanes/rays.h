// SPDX-License-Identifier: Apache-2.0
// This file has rays that leave a surface, in lanes: tracer/rays/departing.h and tracer/transport/aim.h.
#pragma once

#include "tracer/lanes/codes.h"
#include "tracer/lanes/directions.h"
#include "tracer/lanes/sampling.h"
#include "tracer/quadrics/quadric_hits_lanes.h"
#include "tracer/rays/departing.h"
#include "tracer/rays/rounding.h"

namespace vitrail::lanes {
namespace {

template <class D>
VITRAIL_LANES Vector<FloatsLike<D>> offset_origin(Vector<D> p, Vector<D> normal, D rounding, double doubles,
                                                  Vector<D> direction) {
  const D aside = 1e-9 * lanes::max(lanes::max(abs(p.x), abs(p.y)), abs(p.z));
  const D distance = 3.0 * rounding + aside + doubles;
  const D side = select<D>(dot(direction, normal) >= 0, fill<D>(1), fill<D>(-1));
  return to_floats(p + normal * (side * distance));
}

template <class L>
VITRAIL_LANES L hash_of_ray(L seed, Vector<FloatsLike<L>> origin, Code<WordsLike<L>> direction) {
  const auto bits = [](FloatsLike<L> x) __attribute__((always_inline)) {
    return convert<std::uint64_t>(cast_bits<std::uint32_t>(x));
  };
  return stream_seed(seed, bits(origin.x) << 32 | bits(origin.y),
                     bits(origin.z) << 32 ^ convert<std::uint64_t>(direction.first) << 24 ^
                         convert<std::uint64_t>(direction.second));
}

// It is a ray that goes on from a surface, and what it carries, rounded.
template <class D>
struct Departed {
  Vector<FloatsLike<D>> origin, direction;
  Code<WordsLike<D>> code;
  LongsLike<D> random;  // hash_of_ray
  Four<FloatsLike<D>> throughput;
};

// Does what depart (transport/traveller.h) does to a path with that sample_seed, whose depth is counted
// already. `stream` is stream_offset(depth, RayRandom::throughput).
template <class D>
VITRAIL_LANES Departed<D> depart(LongsLike<D> seed, std::type_identity_t<LongsLike<D>> stream,
                                 Vector<FloatsLike<D>> origin, Vector<D> direction,
                                 Four<FloatsLike<D>> throughput) {
  Departed<D> result;
  result.origin = origin;
  result.code = encode_direction(direction);
  result.direction = decode_direction(result.code);
  result.random = hash_of_ray<LongsLike<D>>(seed, origin, result.code);
  LongsLike<D> random = random_bits<LongsLike<D>>(result.random + stream);
  for (int i = 0; i < 4; ++i) {
    result.throughput[i] = rounded_by_chance(throughput[i], convert<std::uint32_t>(random));
    random = random >> 16;
  }
  return result;
}

// It connects a surface to a light.
template <class D>
struct Connected {
  Vector<D> to_light;  // unit
  D distance;          // ∞ of distant lights
  Vector<D> normal;    // of the light there, 0 of points
  D tilt_rad;
};

// It is a connection's ray: vitrail::Aimed, but for quadrics.
template <class D>
struct Aimed {
  Code<WordsLike<D>> code;
  Vector<FloatsLike<D>> direction;
  D end;  // ∞ where its light is
  D cosine;
};

// Aims from `origin` beside p. `sphere` marks lanes whose end end_on_sphere finds.
template <class D>
VITRAIL_LANES Aimed<D> aim(Vector<D> p, Vector<FloatsLike<D>> origin, const Connected<D>& light,
                           Mask<D> sphere = Mask<D>()) {
  const Mask<D> endless = light.distance > std::numeric_limits<double>::max();
  const D finite = select<D>(endless, fill<D>(1), light.distance);
  const Vector<D> way = p + light.to_light * finite - to_doubles(origin);
  const D way2 = dot(way, way);
  Aimed<D> aimed;
  aimed.code = encode_direction(select<D>(no(endless) & (way2 > 0), way, light.to_light));
  aimed.direction = decode_direction(aimed.code);
  const Vector<D> direction = to_doubles(aimed.direction);
  const D distance = lanes::sqrt(way2), there = dot(way, direction) / dot(direction, direction);
  const D height = dot(way, light.normal), cosine = dot(direction, light.normal);
  const D aside = direction_rounding * distance / abs(cosine);
  const D plane = (height / cosine) * (1 - 1e-12) - aside * light.tilt_rad / abs(cosine);
  const D low = 0.5 * there, high = 2.0 * there;
  const D clamped = select<D>(plane < low, low, select<D>(high < plane, high, plane));
  const Mask<D> meets = height * cosine > 0;
  const D otherwise = select<D>(sphere, there, there * before_point);
  aimed.end = select<D>(endless, fill<D>(std::numeric_limits<double>::infinity()),
                        select<D>(meets, clamped, otherwise));
  aimed.cosine = select<D>(no(endless) & meets, cosine, fill<D>(1));
  return aimed;
}

// Returns the `end` of a ray that leads to a whole sphere; sphere(j) is the PlacedQuadric of lane j. The ray
// ends where it meets the sphere, nearest to its end so far. Near the limb it may miss the sphere, and keeps
// its end. `starts_there` is that of quadric_hits.
template <class D, class SphereOf>
VITRAIL_LANES D end_on_sphere(Vector<FloatsLike<D>> origin, const Aimed<D>& aimed, const SphereOf& sphere,
                              Mask<D> starts_there) {
  const auto [first, second] = sphere_crossings(origin, aimed.direction, sphere, starts_there);
  const Mask<D> by_second =
      second.is_hit & (no(first.is_hit) | (abs(second.t - aimed.end) < abs(first.t - aimed.end)));
  const D t = select<D>(by_second, second.t, first.t);
  return select<D>(first.is_hit | second.is_hit, t * (1 - 1e-12), aimed.end);
}

// They return Shadow::tmax and Shadow::radiance.
template <class D>
VITRAIL_LANES FloatsLike<D> shadow_end(D end) {
  using F = FloatsLike<D>;
  const Mask<D> endless = end > std::numeric_limits<double>::max();
  return select<F>(mask_for<F>(endless), fill<F>(std::numeric_limits<float>::max()),
                   float_below<D>(select<D>(endless, fill<D>(0), end)));
}
template <class F>
VITRAIL_LANES Four<F> shadow_radiance(Four<F> radiance) {
  for (int i = 0; i < 4; ++i) radiance[i] = rounded_radiance(lanes::max(fill<F>(0), radiance[i]));
  return radiance;
}

}  // namespace
}  // namespace vitrail::lanes
