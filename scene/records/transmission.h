// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "scene/records/material.h"

namespace vitrail {

// Whether light can go through a surface of the material. `others` says it of the materials that it refers
// to, which come before it.
bool transmits(const Material& material, const std::vector<bool>& others);

// Whether it scatters as the materials do that it refers to. Bumps are theirs.
bool is_made_of_others(const Material& material);

// Whether going straight through it is an event that RenderSettings::straight_counts speaks of; `all` are the
// scene's.
bool is_passed_straight(const Material& material, const std::vector<Material>& all);

// Whether light can go straight through it, an event or not; `others` as above.
bool lets_straight(const Material& material, const std::vector<bool>& others);

// Whether its surface looks different from its two sides; `lets_through` is whether it transmits, `others` as
// above.
bool has_sides(const Material& material, bool lets_through, const std::vector<bool>& others);

// What it turns light by: mirrors and smooth interfaces, and what spreads it. Going straight on is neither;
// `others` as above.
struct Lobes {
  bool smooth = false, spread = false;
};
Lobes lobes_of(const Material& material, const std::vector<Lobes>& others);

// Whether it blends what turns light by a mirror with what spreads it.
bool blends_mirror_with_spread(const Material& material, const std::vector<Lobes>& others);

// The same of each material of a scene.
std::vector<Lobes> lobes_of(const std::vector<Material>& materials);
std::vector<bool> transmitting(const std::vector<Material>& materials);
std::vector<bool> with_sides(const std::vector<Material>& materials);

}  // namespace vitrail
