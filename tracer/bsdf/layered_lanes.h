// SPDX-License-Identifier: Apache-2.0
// This file has what layered.h declares, for any number of lanes: walks of light within a coated layer. z
// runs from 0, the base, to the thickness, the interface; w is the direction of travel as seen from `out`.
// Lanes walk in step, until the last of them is done.
#pragma once

#include "tracer/bsdf/bsdf_lanes.h"
#include "tracer/bsdf/coating_lanes.h"
#include "tracer/bsdf/layer_random_lanes.h"
#include "tracer/bsdf/layered_base_lanes.h"
#include "tracer/sampling/power_heuristic_lanes.h"

namespace vitrail::lanes {
namespace {

// It is vitrail::LayerVolume; thickness > 0, |g| < 1, samples ≥ 1.
template <class D>
struct LayerVolume {
  D thickness, g;
  Four<FloatsLike<D>> albedo;
  D max_depth, samples;
  Mask<D> balanced;
};

template <class D, class Base>
struct Layer {
  Base base;
  Coating<D> coating;
  LayerVolume<D> volume;
  LongsLike<D> event;
  VITRAIL_LANES Mask<D> scatters() const { return mask_for<D>(greatest(volume.albedo) > 0); }
  VITRAIL_LANES Mask<D> only_specular() const { return coating.smooth & base.smooth() & no(scatters()); }
};
template <class D>
using CoatedDiffuse = Layer<D, LambertBase<D>>;
template <class D>
using CoatedConductor = Layer<D, ConductorBase<D>>;

namespace detail {

template <class D>
VITRAIL_LANES Four<FloatsLike<D>> product(Four<FloatsLike<D>> a, const Four<FloatsLike<D>>& b) {
  for (int i = 0; i < 4; ++i) a[i] = a[i] * b[i];
  return a;
}
template <class D>
VITRAIL_LANES Four<FloatsLike<D>> either(Mask<D> mask, Four<FloatsLike<D>> a, const Four<FloatsLike<D>>& b) {
  using F = FloatsLike<D>;
  for (int i = 0; i < 4; ++i) a[i] = select<F>(mask_for<F>(mask), a[i], b[i]);
  return a;
}

// It holds walks that are neither at an interface nor done, where `on`.
template <class D>
struct WalkState {
  D z;
  Vector<D> w;
  Four<FloatsLike<D>> weight;
  Mask<D> on;

  VITRAIL_LANES void meet(Mask<D> where, Mask<D> goes_on, Vector<D> next,
                          const Four<FloatsLike<D>>& next_weight) {
    w = select<D>(where, next, w);
    weight = either<D>(where, next_weight, weight);
    on = on & (no(where) | goes_on);
  }
};

// Flies to the next collision, or to the interface or the base, and returns the lanes that collide. The
// weight of a collision is still without the albedo. Walks along the layer are stuck, and end.
template <class D, class Base>
VITRAIL_LANES Mask<D> fly(const Layer<D, Base>& layer, WalkState<D>& s, WalkRandom<D>& random) {
  const D thickness = layer.volume.thickness;
  const Mask<D> scatters = layer.scatters() & s.on, clear = s.on & no(scatters);
  s.on = s.on & (s.w.z != 0);
  Mask<D> collides{};
  if (any(scatters)) {
    const D z = s.z - s.w.z * portable_log<D>(1.0 - random.uniform(scatters & s.on));
    s.on = s.on & (clear | (z != s.z));
    s.z = select<D>(scatters, select<D>(z < 0, fill<D>(0), select<D>(thickness < z, thickness, z)), s.z);
    collides = scatters & s.on & (z > 0) & (z < thickness);
  }
  if (any(clear)) {
    s.z = select<D>(clear, select<D>(s.w.z < 0, fill<D>(0), thickness), s.z);
    s.weight = either<D>(clear, scaled<D>(s.weight, slab_transmittance(thickness, s.w)), s.weight);
  }
  return collides;
}

// Plays Russian roulette from the fourth step on.
template <class D>
VITRAIL_LANES void play_roulette(int depth, WalkState<D>& s, WalkRandom<D>& random) {
  if (depth <= 3) return;
  const D most = to_doubles(greatest(s.weight));
  const Mask<D> played = s.on & (most < 0.25);
  if (!any(played)) return;
  const Mask<D> lives = random.uniform(played) < most;
  s.weight = either<D>(played & lives, scaled<D>(s.weight, 1.0 / most), s.weight);
  s.on = s.on & (no(played) | lives);
}

// Adds to `sum` what a walk gathers of light from `in`, f·cosθ. Each step links to the way out through a
// direction `wis` that refracts to `in`. Where interfaces are rough, it also links by the directions that the
// walk takes.
template <class D, class Base>
VITRAIL_LANES void add_walk(const Layer<D, Base>& layer, Vector<D> out, Vector<D> in, Mask<D> on,
                            WalkRandom<D>& random, Four<FloatsLike<D>>& sum) {
  using F = FloatsLike<D>;
  const Coating<D>& coating = layer.coating;
  const LayerVolume<D>& v = layer.volume;
  const auto u_out = random.uniform_pair(on), u_in = random.uniform_pair(on);
  const CoatingSample<D> wos = sample_coating_transmission(coating, out, u_out.x, u_out.y),
                         wis = sample_coating_transmission(coating, in, u_in.x, u_in.y);
  const D wis_weight = wis.weight * coating.eta * coating.eta;  // f·cos/pdf of light that enters
  const Vector<D> to_in = -wis.in;                              // upwards
  const Mask<D> rough_exit = no(coating.smooth);
  const auto add = [&](Mask<D> where, const Four<F>& value, D factor) __attribute__((always_inline)) {
    const F narrow = to_floats(factor * in.z);
    for (int i = 0; i < 4; ++i) sum[i] = select<F>(mask_for<F>(where), sum[i] + value[i] * narrow, sum[i]);
  };
  const auto weigh = [&](D chosen, D other) __attribute__((always_inline)) {
    return select<D>(rough_exit, power_heuristic(chosen, other), fill<D>(1));
  };

  const Mask<D> enters = on & wos.found & wis.found;
  WalkState<D> s{v.thickness, wos.in, {}, enters};
  for (int i = 0; i < 4; ++i) s.weight[i] = to_floats(wos.weight);
  for (int depth = 0;; ++depth) {
    s.on = s.on & (static_cast<double>(depth) < v.max_depth);
    play_roulette(depth, s, random);
    if (!any(s.on)) return;
    const Mask<D> collides = fly(layer, s, random), at_base = s.on & no(collides) & (s.z == 0),
                  at_interface = s.on & no(collides) & (s.z > 0);
    Mask<D> links = at_base;  // by the direction in which it goes on, too
    D next_pdf = fill<D>(1);
    Mask<D> next_is_certain{};
    if (any(collides)) {
      const D phase = henyey_greenstein(v.g, dot(s.w, to_in));
      const auto u = random.uniform_pair(collides);
      s.weight = either<D>(collides, product<D>(s.weight, v.albedo), s.weight);
      add(collides, s.weight,
          phase * weigh(wis.pdf, phase) * slab_transmittance<D>(v.thickness - s.z, to_in) * wis_weight /
              abs(wis.in.z));
      const Vector<D> next = sample_henyey_greenstein(v.g, s.w, u.x, u.y);
      next_pdf = henyey_greenstein(v.g, dot(s.w, next));
      s.w = select<D>(collides, next, s.w);
      links = links | (collides & (s.w.z > 0));
    }
    if (any(at_interface)) {  // from below
      const auto u = random.uniform_pair(at_interface);
      const CoatingSample<D> reflected = sample_coating_reflection(coating, -s.w, u.x, u.y);
      s.meet(at_interface, reflected.found, reflected.in, scaled<D>(s.weight, reflected.weight));
    }
    if (any(at_base)) {
      const Vector<D> seen = -s.w;
      const Mask<D> facets = at_base & no(layer.base.smooth());
      if (any(facets))
        add(facets, product<D>(s.weight, base_value(layer.base, seen, to_in)),
            weigh(wis.pdf, base_pdf(layer.base, seen, to_in)) * slab_transmittance(v.thickness, to_in) *
                wis_weight);
      const auto u = random.uniform_pair(at_base);
      const BaseSample<D> reflected = sample_base(layer.base, seen, u.x, u.y);
      s.meet(at_base, reflected.found, reflected.in, product<D>(s.weight, reflected.weight));
      next_pdf = select<D>(at_base, reflected.pdf, next_pdf);
      next_is_certain = at_base & layer.base.smooth();
    }
    links = links & s.on & rough_exit;
    if (any(links)) {
      const D exit_pdf =
          coating_transmitted_pdf(coating, select<D>(v.balanced, in, -s.w), select<D>(v.balanced, -s.w, in));
      const D chosen = select<D>(next_is_certain, fill<D>(1), power_heuristic(next_pdf, exit_pdf));
      add(links, s.weight,
          coating_transmission(coating, -s.w, in) * slab_transmittance<D>(v.thickness - s.z, s.w) * chosen);
    }
  }
}

// Samples a walk from `out` to where it leaves through the interface.
template <class D, class Base>
VITRAIL_LANES BsdfSample<D> sample_walk(const Layer<D, Base>& layer, Vector<D> out, FloatsLike<D> u_lobe,
                                        FloatsLike<D> u_x, FloatsLike<D> u_y) {
  const Coating<D>& coating = layer.coating;
  const LayerVolume<D>& v = layer.volume;
  const D lobe = to_doubles(u_lobe);
  const CoatingSample<D> entered = sample_coating(coating, out, lobe, u_x, u_y);
  const Mask<D> enters = entered.found & (out.z > 0);
  WalkState<D> s{v.thickness, entered.in, {}, enters};
  for (int i = 0; i < 4; ++i) s.weight[i] = to_floats(entered.weight);
  Mask<D> leaves = s.on & (s.w.z > 0), specular = coating.smooth;
  s.on = s.on & no(leaves);
  WalkRandom<D> random(layer.event, 3);
  random << out << lobe << to_doubles(u_x) << to_doubles(u_y);
  for (int depth = 0;; ++depth) {
    s.on = s.on & (static_cast<double>(depth) < v.max_depth);
    play_roulette(depth, s, random);
    if (!any(s.on)) break;
    const Mask<D> collides = fly(layer, s, random), at_base = s.on & no(collides) & (s.z == 0),
                  at_interface = s.on & no(collides) & (s.z > 0);
    if (any(collides)) {
      const auto u = random.uniform_pair(collides);
      s.meet(collides, collides, sample_henyey_greenstein(v.g, s.w, u.x, u.y),
             product<D>(s.weight, v.albedo));
      specular = specular & no(collides);
    }
    if (any(at_interface)) {
      const D choice = random.uniform(at_interface);
      const auto u = random.uniform_pair(at_interface);
      const CoatingSample<D> met = sample_coating<D>(coating, -s.w, choice, u.x, u.y);
      s.meet(at_interface, met.found, met.in, scaled<D>(s.weight, met.weight));
      const Mask<D> out_of_it = at_interface & s.on & (s.w.z > 0);
      leaves = leaves | out_of_it;
      s.on = s.on & no(out_of_it);
    }
    if (any(at_base)) {
      const auto u = random.uniform_pair(at_base);
      const BaseSample<D> reflected = sample_base<D>(layer.base, -s.w, u.x, u.y);
      s.meet(at_base, reflected.found, reflected.in, product<D>(s.weight, reflected.weight));
      specular = specular & (no(at_base) | layer.base.smooth());
    }
  }
  specular = specular & leaves;
  return {leaves, s.w, s.weight, fill<D>(0), specular};
}

// Returns about the density of light that leaves after the base reflected it, among all such light.
template <class D>
VITRAIL_LANES D base_lobe(const CoatedDiffuse<D>&, Vector<D>, Vector<D> in, WalkRandom<D>&) {
  return in.z / pi;
}

// It describes a rough metal seen through the interface. `density` is one estimate of the density over the
// directions that rough interfaces refract to, by either side of the base's reflection. `leaves` says whether
// light that the base reflects gets out.
template <class D>
struct MetalLobe {
  D density;
  Mask<D> leaves;
};
template <class D>
VITRAIL_LANES MetalLobe<D> metal_lobe(const CoatedConductor<D>& layer, Vector<D> out, Vector<D> in,
                                      WalkRandom<D>& random) {
  const Coating<D>& coating = layer.coating;
  const Mask<D> every = in.z == in.z;
  const auto u_out = random.uniform_pair(every), u_in = random.uniform_pair(every);
  const CoatingSample<D> wos = sample_coating_transmission(coating, out, u_out.x, u_out.y),
                         wis = sample_coating_transmission(coating, in, u_in.x, u_in.y);
  const Vector<D> seen = -wos.in, to_in = -wis.in;
  const D by_base = base_pdf(layer.base, seen, to_in);
  const auto u_base = random.uniform_pair(every), u_exit = random.uniform_pair(every);
  const BaseSample<D> reflected = sample_base(layer.base, seen, u_base.x, u_base.y);
  const Mask<D> found = wos.found & wis.found;
  const Mask<D> leaves =
      found & reflected.found & sample_coating_transmission(coating, -reflected.in, u_exit.x, u_exit.y).found;
  D density = by_base * in.z / (coating.eta * coating.eta * to_in.z);
  if (!all(coating.smooth)) {
    const D through = coating_transmitted_pdf(coating, -reflected.in, in),
            other = coating_transmitted_pdf(coating, in, -reflected.in);
    const D by_metal =
        select<D>(layer.base.smooth(), through, through * power_heuristic(reflected.pdf, other));
    const D by_link =
        by_base * coating_transmitted_pdf(coating, -to_in, in) / wis.pdf * power_heuristic(wis.pdf, by_base);
    const D both =
        select<D>(reflected.found, by_metal, fill<D>(0)) + select<D>(by_base > 0, by_link, fill<D>(0));
    density = select<D>(coating.smooth, density, both);
  }
  return {select<D>(found, density, fill<D>(0)), leaves};
}
template <class D>
VITRAIL_LANES D base_lobe(const CoatedConductor<D>& layer, Vector<D> out, Vector<D> in,
                          WalkRandom<D>& random) {
  constexpr double narrow = 0.9;  // the rest goes back and forth before it leaves
  const MetalLobe<D> lobe = metal_lobe(layer, out, in, random);
  const D wide = in.z / pi;
  const D density =
      narrow * lobe.density + (1.0 - select<D>(lobe.leaves, fill<D>(narrow), fill<D>(0))) * wide;
  // Light that two smooth faces scatter has collided between them.
  return select<D>(layer.coating.smooth & layer.base.smooth(), wide, density);
}

}  // namespace detail

template <class D, class Base>
VITRAIL_LANES D layer_pdf(const Layer<D, Base>& layer, Vector<D> out, Vector<D> in) {
  const Coating<D>& coating = layer.coating;
  const Mask<D> some = (out.z > 0) & (in.z > 0) & no(layer.only_specular()), rough = no(coating.smooth);
  WalkRandom<D> random(layer.event, 2);
  random << out << in;
  Vector<D> facet = fill<D>(Vector3d{0, 0, 1});
  D reflected = fill<D>(0);
  if (any(rough)) {
    const auto u = random.uniform_pair(rough);
    facet = select<D>(rough, sample_visible_normal(coating.facets, out, u.x, u.y), facet);
    const D by_facet =
        detail::coating_half(coating, out, in).fresnel * coating_reflected_pdf(coating, out, in);
    reflected = select<D>(rough, by_facet, reflected);
  }
  const D entering = 1.0 - fresnel_dielectric<D>(lanes::clamp<D>(dot(out, facet), 0.0, 1.0), coating.eta);
  const D pdf = reflected + entering * detail::base_lobe(layer, out, in, random);
  return select<D>(some, pdf, fill<D>(0));
}

template <class D, class Base>
VITRAIL_LANES BsdfValue<D> eval(const Layer<D, Base>& layer, Vector<D> out, Vector<D> in) {
  using F = FloatsLike<D>;
  const Mask<D> some = (out.z > 0) & (in.z > 0) & no(layer.only_specular());
  BsdfValue<D> f{};
  if (!any(some)) return f;
  WalkRandom<D> random(layer.event, 1);
  random << out << in;
  Four<F> sum{};
  const D walks = layer.volume.samples;
  for (int i = 0; any(some & (static_cast<double>(i) < walks)); ++i)
    detail::add_walk(layer, out, in, some & (static_cast<double>(i) < walks), random, sum);
  const F reflected = to_floats(coating_reflection(layer.coating, out, in) * in.z),
          each = 1.0f / to_floats(walks);
  f.pdf = layer_pdf(layer, out, in);
  for (int i = 0; i < 4; ++i) f.value[i] = reflected + sum[i] * each;
  return detail::where<D>(some, f);
}

template <class D, class Base>
VITRAIL_LANES BsdfSample<D> sample(const Layer<D, Base>& layer, Vector<D> out, FloatsLike<D> u_lobe,
                                   FloatsLike<D> u_x, FloatsLike<D> u_y) {
  BsdfSample<D> s = detail::sample_walk(layer, out, u_lobe, u_x, u_y);
  s.scatters = s.scatters & (s.in.z > 0);
  if (any(s.scatters & no(s.specular)))
    s.pdf = select<D>(s.specular, fill<D>(0), layer_pdf(layer, out, s.in));
  s.scatters = s.scatters & (s.specular | (s.pdf > 0));
  return s;
}

}  // namespace
}  // namespace vitrail::lanes
