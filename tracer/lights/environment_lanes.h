// SPDX-License-Identifier: Apache-2.0
// This file has directions to environments and the radiance from there, for any number of lanes. It finds the
// sun's disc and the ground lane by lane.
#pragma once

#include "tracer/lights/direction_table_lanes.h"
#include "tracer/lights/environment.h"
#include "tracer/lights/light_sampler.h"
#include "tracer/lights/sky_lanes.h"
#include "tracer/sampling/flat_spectrum_lanes.h"
#include "tracer/textures/image_lanes.h"

namespace vitrail::lanes {
namespace {

namespace detail {

// It is a place on the sun's disc: the cosine of the angle from its middle is 1 − below.
template <class D>
struct SunPlace {
  D below, sine;
};
template <class D>
VITRAIL_LANES SunPlace<D> place_on_sun(const SkyModel& sky, D u) {
  const D below = u * (1.0 - sky.sun_cosine());
  return {below, safe_sqrt(below * (2.0 - below))};
}
// `cosine` and `sine` are of the turn about the disc's middle.
template <class D>
VITRAIL_LANES Vector<D> direction_on_sun(const SkyModel& sky, SunPlace<D> place, D cosine, D sine) {
  const Vector<D> n = fill<D>(sky.to_sun());
  const bool away_from_x = sky.to_sun().x < 0.5 && sky.to_sun().x > -0.5;
  const Vector<D> x =
      lanes::normalize(cross(fill<D>(away_from_x ? Vector3d{1, 0, 0} : Vector3d{0, 1, 0}), n));
  return x * (place.sine * cosine) + cross(n, x) * (place.sine * sine) + n * (1.0 - place.below);
}

template <class D>
VITRAIL_LANES Vector<D> to_light(const DirectionFrame& frame, Vector<D> d) {
  return {dot(d, fill<D>(frame.x)), dot(d, fill<D>(frame.y)), dot(d, fill<D>(frame.z))};
}
template <class D>
VITRAIL_LANES Vector<D> to_world(const DirectionFrame& frame, Vector<D> d) {
  return fill<D>(frame.x) * d.x + fill<D>(frame.y) * d.y + fill<D>(frame.z) * d.z;
}

// It is the place where an image of so many texels is looked up for a point of the sphere's picture.
template <class D>
struct ImagePlace {
  D s, t;            // by latitude and longitude, bilinear
  IntsLike<D> x, y;  // of an equal-area map: the nearest texel, y up
};
template <class D>
VITRAIL_LANES ImagePlace<D> place_in_image(PicturePoint<D> at, int width, int height) {
  using I = IntsLike<D>;
  const auto nearest = [](D x, int count) __attribute__((always_inline)) {
    return lanes::clamp<I>(convert<std::int32_t>(x * static_cast<double>(count)), 0, count - 1);
  };
  return {at.x, 1.0 - (at.y * static_cast<double>(height - 1) + 0.5) / static_cast<double>(height),
          nearest(at.x, width), height - 1 - nearest(at.y, height)};
}

// It is vitrail::radiance_of_image, in the lanes that are `on`.
template <class D, class WavelengthsOf>
VITRAIL_LANES Four<FloatsLike<D>> radiance_of_image(const Environment& e, PicturePoint<D> at, Mask<D> on,
                                                    const WavelengthsOf& wavelengths) {
  using F = FloatsLike<D>;
  const unsigned lanes = bits(on);
  const BakedImage* const image = baked_image_of(e);
  if (!image)
    return lane_by_lane<F>(
        lanes, [&](int j) __attribute__((always_inline)) {
          return vitrail::radiance_of_image(e, {lane(at.x, j), lane(at.y, j)}, wavelengths(j));
        });
  const BakedImage::Size size = image->size(0);
  const ImagePlace<D> place = place_in_image(at, size.width, size.height);
  Four<F> radiance = e.projection == SphereProjection::equal_area
                         ? texel(*image, place.x, place.y, 0, lanes, wavelengths)
                         : bilinear(*image, place.s, place.t, Wrap::repeat, 0, lanes, wavelengths);
  Four<F> scale;
  if (const float* const constant = constant_scale_of(e))
    for (int i = 0; i < hero_count; ++i) scale[i] = fill<F>(*constant);
  else
    scale = lane_by_lane<F>(
        lanes, [&](int j) __attribute__((always_inline)) { return scale_of(e, wavelengths(j)); });
  for (int i = 0; i < hero_count; ++i) radiance[i] = radiance[i] * scale[i] * e.factor;
  return radiance;
}

}  // namespace detail

// Samples a direction over the sun's disc, uniform per solid angle, in the sky's own frame. u and v are in
// [0,1).
template <class D>
VITRAIL_LANES Vector<D> sample_sun(const SkyModel& sky, D u, D v) {
  const D turn = 2 * pi * v;
  return detail::direction_on_sun(sky, detail::place_on_sun(sky, u), portable_cos(turn), portable_sin(turn));
}

// u and v are in [0,1).
template <class D>
VITRAIL_LANES Vector<D> sample_direction(const Environment& e, D u, D v) {
  if (!(e.sun_share > 0)) return detail::to_world(e.frame, sample(e.table, u, v));
  const Mask<D> of_sun = u < e.sun_share;
  // Both samples turn about an axis, by one angle.
  D turn = v, across = fill<D>(0), z = fill<D>(0);
  if (!all(of_sun)) {
    const D of_sky = select<D>(of_sun, fill<D>(0), (u - e.sun_share) / (1.0 - e.sun_share));
    const TablePlace<D> place = place_in_table(e.table, of_sky, v);
    turn = select<D>(of_sun, v, place.at.x);
    z = place.z;
    across = safe_sqrt(1.0 - z * z);
  }
  const D cosine = portable_cos(2 * pi * turn), sine = portable_sin(2 * pi * turn);
  Vector<D> direction{across * cosine, across * sine, z};
  if (any(of_sun)) {
    const detail::SunPlace<D> place = detail::place_on_sun(*e.sky, D(u / e.sun_share));
    direction = select<D>(of_sun, detail::direction_on_sun(*e.sky, place, cosine, sine), direction);
  }
  return detail::to_world(e.frame, direction);
}

// It holds the radiance at the wavelengths of a path, and the density per solid angle with which the
// direction is chosen.
template <class D>
struct Seen {
  Four<FloatsLike<D>> radiance;
  D pdf;
};

// It is vitrail::value_towards, in the lanes that are `on`; wavelengths(j) are those of lane j.
template <class D, class WavelengthsOf>
VITRAIL_LANES Seen<D> value_towards(const Environment& e, Vector<D> direction, Mask<D> on,
                                    const WavelengthsOf& wavelengths) {
  const Vector<D> d = detail::to_light(e.frame, direction);
  const PicturePoint<D> at = sphere_point(e.projection, d);
  Seen<D> seen{};
  seen.pdf = pdf(e.table, at);
  if (!e.sky) {
    seen.radiance = detail::radiance_of_image(e, at, on, wavelengths);
    return seen;
  }
  const SkyModel& sky = *e.sky;
  seen.radiance = sky_towards(sky, d, on, wavelengths);
  const Mask<D> below = on & (d.z < 0);
  if (sky.has_ground() && any(below))
    for (int j = 0; j < width<D>; ++j) {
      if (!is_set(below, j)) continue;
      const SampledSpectrum radiance = sky.ground(wavelengths(j));
      for (int i = 0; i < hero_count; ++i) set_lane(seen.radiance[i], j, radiance.v[i]);
    }
  seen.pdf = (1.0 - e.sun_share) * seen.pdf;
  if (!(e.sun_share > 0) || !sky.has_sun()) return seen;
  const Mask<D> sun = on & (d.z >= 0) & (dot(d, fill<D>(sky.to_sun())) >= sky.sun_cosine());
  if (!any(sun)) return seen;
  for (int j = 0; j < width<D>; ++j) {
    if (!is_set(sun, j)) continue;
    const SampledSpectrum radiance = sky.sun(lane(d, j), wavelengths(j));
    for (int i = 0; i < hero_count; ++i)
      set_lane(seen.radiance[i], j, lane(seen.radiance[i], j) + radiance.v[i]);
  }
  seen.pdf = select<D>(sun, seen.pdf + e.sun_share / (2 * pi * (1.0 - sky.sun_cosine())), seen.pdf);
  return seen;
}

namespace detail {

template <class D, class WavelengthsOf>
VITRAIL_LANES Four<FloatsLike<D>> constant_radiance(const FlatSpectrum& light,
                                                    const WavelengthsOf& wavelengths) {
  using F = FloatsLike<D>;
  if (!light.other)
    return flat_values<D>(
        [&](int) __attribute__((always_inline))->const FlatSpectrum& { return light; },
        [&](int i) __attribute__((always_inline)) {
          return gather<F>([&](int j)
                               __attribute__((always_inline)) { return wavelengths(j).lambda_nm.data()[i]; });
        });
  Four<F> values;
  for (int j = 0; j < width<D>; ++j) {
    const SampledSpectrum radiance = vitrail::evaluate(*light.other, wavelengths(j));
    for (int i = 0; i < hero_count; ++i) set_lane(values[i], j, radiance.v[i]);
  }
  return values;
}

}  // namespace detail

// It is vitrail::background, in the lanes that are `on`.
template <class D, class WavelengthsOf>
VITRAIL_LANES Seen<D> background(const LightSampler& lights, Vector<D> direction, Mask<D> on,
                                 const WavelengthsOf& wavelengths) {
  Seen<D> sum{};
  const auto add = [&](const Four<FloatsLike<D>>& radiance) __attribute__((always_inline)) {
    for (int i = 0; i < hero_count; ++i) sum.radiance[i] = sum.radiance[i] + radiance[i];
  };
  for (std::size_t i = 0; i < lights.constant.size(); ++i)
    add(detail::constant_radiance<D>(lights.constant.data()[i], wavelengths));
  const Environment* const environments = lights.environments.data();
  for (std::size_t i = 0; i < lights.environments.size(); ++i) {
    const Seen<D> seen = value_towards(environments[i], direction, on, wavelengths);
    add(seen.radiance);
    sum.pdf = sum.pdf + lights.share.data()[lights.first_environment() + i] * seen.pdf;
  }
  return sum;
}

}  // namespace
}  // namespace vitrail::lanes
