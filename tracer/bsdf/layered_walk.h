// SPDX-License-Identifier: Apache-2.0
// Walks of light within a coated layer. z runs from 0, the base, to the thickness, the interface; w is the
// direction of travel as seen from `out`.
#pragma once

#include <algorithm>

#include "tracer/bsdf/coating.h"
#include "tracer/bsdf/layer_random.h"
#include "tracer/bsdf/layered.h"
#include "tracer/bsdf/layered_base.h"
#include "tracer/sampling/power_heuristic.h"

namespace vitrail {

template <class Base>
struct Layer {
  Base base;
  Coating coating;
  LayerVolume volume;  // thickness > 0, |g| < 1
  std::uint64_t event;
  bool scatters() const { return !is_black(volume.albedo); }
  bool only_specular() const { return coating.smooth() && base.smooth() && !scatters(); }
};

// A walk that is neither at an interface nor done.
struct WalkState {
  double z;
  Vector3d w;
  SampledSpectrum weight;
};

enum class Flight { collides, arrives, stuck };

// To the next collision, whose weight is still without the albedo, or to the interface or the base.
template <class Base>
Flight fly(const Layer<Base>& layer, WalkState& s, WalkRandom& random) {
  const double thickness = layer.volume.thickness;
  if (s.w.z == 0) return Flight::stuck;
  if (!layer.scatters()) {
    s.z = s.w.z < 0 ? 0 : thickness;
    s.weight = s.weight * static_cast<float>(slab_transmittance(thickness, s.w));
    return Flight::arrives;
  }
  const double z = s.z - s.w.z * portable_log(1 - random.uniform());
  if (z == s.z) return Flight::stuck;
  s.z = std::clamp(z, 0.0, thickness);
  return z > 0 && z < thickness ? Flight::collides : Flight::arrives;
}

// Russian roulette from the fourth step on; true: the walk ends.
inline bool dies(int depth, SampledSpectrum& weight, WalkRandom& random) {
  const auto most = static_cast<double>(max_value(weight));
  if (depth <= 3 || most >= 0.25) return false;
  if (random.uniform() >= most) return true;
  weight = weight * static_cast<float>(1 / most);
  return false;
}

// What a walk gathers of light from `in`, f·cosθ: at each step the way out is linked to, through a
// direction `wis` that refracts to `in`, and, where interfaces are rough, by the directions that the walk
// takes.
template <class Base>
SampledSpectrum walk_value(const Layer<Base>& layer, Vector3d out, Vector3d in, WalkRandom& random) {
  const Coating& coating = layer.coating;
  const auto& [thickness, g, albedo, max_depth, samples, balanced] = layer.volume;
  const auto wos = sample_coating_transmission(coating, out, random.uniform_pair());
  const auto wis = sample_coating_transmission(coating, in, random.uniform_pair());
  SampledSpectrum sum{};
  if (!wos || !wis) return sum;
  const double wis_weight = wis->weight * coating.eta * coating.eta;  // f·cos/pdf of light that enters
  const Vector3d to_in = -wis->in;                                    // upwards
  const bool rough_exit = !coating.smooth();
  const auto add = [&](const SampledSpectrum& value, double factor) {
    sum = sum + value * static_cast<float>(factor * in.z);
  };
  const auto weigh = [&](double chosen, double other) {
    return rough_exit ? power_heuristic(chosen, other) : 1;
  };
  const auto exit_pdf = [&](Vector3d w) {
    return balanced ? coating_transmitted_pdf(coating, in, -w) : coating_transmitted_pdf(coating, -w, in);
  };

  WalkState s{thickness, wos->in, filled(static_cast<float>(wos->weight))};
  for (int depth = 0; depth < max_depth && !dies(depth, s.weight, random); ++depth) {
    const Flight flight = fly(layer, s, random);
    if (flight == Flight::stuck) continue;
    if (flight == Flight::collides) {
      const double phase = henyey_greenstein(g, dot(s.w, to_in));
      s.weight = s.weight * albedo;
      add(s.weight, phase * weigh(wis->pdf, phase) * slab_transmittance(thickness - s.z, to_in) * wis_weight /
                        std::abs(wis->in.z));
      const Vector3d next = sample_henyey_greenstein(g, s.w, random.uniform_pair());
      const double next_pdf = henyey_greenstein(g, dot(s.w, next));
      s.w = next;
      if (s.w.z > 0 && rough_exit)
        add(s.weight, coating_transmission(coating, -s.w, in) * slab_transmittance(thickness - s.z, s.w) *
                          power_heuristic(next_pdf, exit_pdf(s.w)));
    } else if (s.z > 0) {  // at the interface, from below
      const auto reflected = sample_coating_reflection(coating, -s.w, random.uniform_pair());
      if (!reflected) break;
      s.weight = s.weight * static_cast<float>(reflected->weight);
      s.w = reflected->in;
    } else {
      if (!layer.base.smooth())
        add(s.weight * base_value(layer.base, -s.w, to_in),
            weigh(wis->pdf, base_pdf(layer.base, -s.w, to_in)) * slab_transmittance(thickness, to_in) *
                wis_weight);
      const auto reflected = sample_base(layer.base, -s.w, random.uniform_pair());
      if (!reflected) break;
      s.weight = s.weight * reflected->weight;
      s.w = reflected->in;
      if (rough_exit) {
        const double chosen = layer.base.smooth() ? 1 : power_heuristic(reflected->pdf, exit_pdf(s.w));
        add(s.weight, coating_transmission(coating, -s.w, in) * slab_transmittance(thickness, s.w) * chosen);
      }
    }
  }
  return sum;
}

// A walk from `out` to where it leaves through the interface.
struct WalkEnd {
  Vector3d in;
  SampledSpectrum weight;
  bool specular;
};

template <class Base>
std::optional<WalkEnd> sample_walk(const Layer<Base>& layer, Vector3d out, float u_lobe, Point2f u) {
  const Coating& coating = layer.coating;
  const auto& [thickness, g, albedo, max_depth, samples, balanced] = layer.volume;
  auto entered = sample_coating(coating, out, static_cast<double>(u_lobe), u);
  if (!entered) return std::nullopt;
  WalkState s{thickness, entered->in, filled(static_cast<float>(entered->weight))};
  if (s.w.z > 0) return WalkEnd{s.w, s.weight, coating.smooth()};
  bool specular = coating.smooth();
  WalkRandom random(layer.event, 3);
  random << out << static_cast<double>(u_lobe) << static_cast<double>(u.x) << static_cast<double>(u.y);
  for (int depth = 0; depth < max_depth && !dies(depth, s.weight, random); ++depth) {
    const Flight flight = fly(layer, s, random);
    if (flight == Flight::stuck) return std::nullopt;
    if (flight == Flight::collides) {
      s.weight = s.weight * albedo;
      s.w = sample_henyey_greenstein(g, s.w, random.uniform_pair());
      specular = false;
    } else if (s.z > 0) {
      const double choice = random.uniform();
      const auto met = sample_coating(coating, -s.w, choice, random.uniform_pair());
      if (!met) return std::nullopt;
      s.weight = s.weight * static_cast<float>(met->weight);
      s.w = met->in;
      if (s.w.z > 0) return WalkEnd{s.w, s.weight, specular};
    } else {
      const auto reflected = sample_base(layer.base, -s.w, random.uniform_pair());
      if (!reflected) return std::nullopt;
      s.weight = s.weight * reflected->weight;
      s.w = reflected->in;
      specular = specular && layer.base.smooth();
    }
  }
  return std::nullopt;
}

}  // namespace vitrail
