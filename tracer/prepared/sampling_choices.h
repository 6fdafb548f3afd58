// SPDX-License-Identifier: Apache-2.0
// These are ways to sample one picture: they differ in noise and time, and agree in the mean.
#pragma once

#include <cstdint>

#include "tracer/lights/light_tree.h"

namespace vitrail {

// It says when paths end by chance. Mirrors, smooth interfaces and the first other event are left out. A path
// may end where it carries less than all of what a camera ray does (early), or less than a quarter (usual).
// `never` ends it only after 254 events; without that it would go on for ever between white walls.
enum class Roulette : std::uint32_t { early, usual, never };
// Returns the least share of a camera ray that a path has to carry: one that carries less ends by chance.
constexpr float worth_going_on(Roulette roulette) { return roulette == Roulette::usual ? 0.25f : 1.0f; }

inline constexpr std::uint32_t most_light_candidates = 16;

struct SamplingChoices {
  Roulette roulette = Roulette::usual;
  bool one_wavelength = false;  // paths carry their hero wavelength alone, as dispersed ones do
  LightChoice lights = LightChoice::tree;
  // It is the number of candidates, 1 … most_light_candidates, of which one is connected to. They are drawn
  // where the camera sees the point and they differ.
  std::uint32_t light_candidates = 4;
  // Samples lie evenly in their pixels and add to all that the filter reaches from there, by its values.
  // Otherwise the filter chooses where they lie.
  bool splat = false;
  // A pixel's samples are stratified together, not in two groups that tell how far they are off.
  bool one_sequence = false;
  bool operator==(const SamplingChoices&) const = default;
};

}  // namespace vitrail
