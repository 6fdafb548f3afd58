// SPDX-License-Identifier: Apache-2.0
// Ways to sample one picture: they differ in noise and time, and agree in the mean.
#pragma once

#include <cstdint>

#include "tracer/lights/light_tree.h"

namespace vitrail {

// When paths end by chance, mirrors, smooth interfaces and the first other event apart: where they carry less
// than all of what a camera ray does, less than a quarter of it, or only after 254 events; one that never did
// would go on for ever between white walls.
enum class Roulette : std::uint32_t { early, usual, never };
// Paths that carry less than this, of 1 at first, end by chance.
constexpr float worth_going_on(Roulette roulette) { return roulette == Roulette::usual ? 0.25f : 1.0f; }

inline constexpr std::uint32_t most_light_candidates = 16;

struct SamplingChoices {
  Roulette roulette = Roulette::usual;
  bool one_wavelength = false;  // paths carry their hero wavelength alone, as dispersed ones do
  LightChoice lights = LightChoice::tree;
  // Of which one is connected to, where the camera sees the point and they differ; 1 … most_light_candidates.
  std::uint32_t light_candidates = 4;
  // Samples lie evenly in their pixels and add to all that the filter reaches from there, by its values; else
  // it chooses where they lie.
  bool splat = false;
  // A pixel's samples are stratified together, not in two groups that tell how far they are off.
  bool one_sequence = false;
  bool operator==(const SamplingChoices&) const = default;
};

}  // namespace vitrail
