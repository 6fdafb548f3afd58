// SPDX-License-Identifier: Apache-2.0
// Random numbers and free flights of walks within a layer.
#pragma once

#include <bit>
#include <cstdint>

#include "scene/geometry/portable_math.h"
#include "tracer/bsdf/local.h"

namespace vitrail {

// SplitMix64 (Steele, Lea and Flood 2014), seeded by what a walk is about.
class WalkRandom {
 public:
  WalkRandom(std::uint64_t event, std::uint64_t use) : state_(event ^ use) {}
  WalkRandom& operator<<(double x) {
    state_ ^= std::bit_cast<std::uint64_t>(x);
    state_ = bits();
    return *this;
  }
  WalkRandom& operator<<(Vector3d v) { return *this << v.x << v.y << v.z; }
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }  // in [0, 1)
  Point2f uniform_pair() {
    const std::uint64_t b = bits();
    return {static_cast<float>(b >> 40) * 0x1p-24f, static_cast<float>((b >> 16) & 0xffffff) * 0x1p-24f};
  }

 private:
  std::uint64_t bits() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  std::uint64_t state_;
};

// Transmittance of a slab of so many mean free paths along w.
inline double slab_transmittance(double depth, Vector3d w) {
  if (depth == 0) return 1;
  return w.z != 0 ? portable_exp(-std::abs(depth / w.z)) : 0;
}

// Henyey and Greenstein's (1941) phase function, sr⁻¹; cosine 1 is straight on, |g| < 1.
inline double henyey_greenstein(double g, double cosine) {
  const double d = 1 + g * g - 2 * g * cosine;  // ≥ (1 − |g|)²
  return (1 - g * g) / (4 * pi * d * std::sqrt(d));
}

// Direction in which light that travels along w goes on; its pdf is the phase function.
inline Vector3d sample_henyey_greenstein(double g, Vector3d w, Point2f u) {
  const auto x = static_cast<double>(u.x);
  double cosine = 1 - 2 * x;
  if (std::abs(g) > 1e-3) {
    const double s = (1 - g * g) / (1 - g + 2 * g * x);
    cosine = std::min(1.0, std::max(-1.0, (1 + g * g - s * s) / (2 * g)));
  }
  const double sine = safe_sqrt(1 - cosine * cosine), phi = 2 * static_cast<double>(u.y);
  return normalize(Frame(w).to_world({sine * sin_pi(phi + 0.5), sine * sin_pi(phi), cosine}));
}

}  // namespace vitrail
