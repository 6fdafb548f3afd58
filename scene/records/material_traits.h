// SPDX-License-Identifier: Apache-2.0
// What follows from a material's record alone, said once for readers, writers, the partitioner and the
// tracer. Every kind of material has its row in material_traits.cpp: without one, a new kind does not
// compile.
#pragma once

#include <vector>

#include "scene/records/material.h"
#include "scene/records/scattering_table.h"

namespace vitrail {

// What it turns light by: mirrors and smooth interfaces, and what spreads it. Going straight on is neither.
struct Lobes {
  bool smooth = false, spread = false;
};

struct MaterialTraits {
  // Light can get to the other side: it is asked from either, and its back is not black.
  bool transmits = false;
  bool straight = false;  // … as it came, an event or not
  bool counts = false;    // going straight is an event that RenderSettings::straight_counts speaks of
  bool mirrors = false;   // part of what connections meet goes back by a mirror: sheets, smooth metal
  bool nothing = false;   // there is no surface at all
  bool fibre = false;     // from behind there is none
  bool gathers = false;   // photons are gathered on it
  bool disperses = false;
  bool along_surface = false;  // it has a direction along the surface: (u,v) show
  Lobes lobes;
};

// Whether a model, without the materials that it refers to, has a direction along the surface: as its traits
// say, but for tables that turn out to have none. `tables`: those of its scene.
bool has_direction(const MaterialModel& model, const std::vector<ScatteringTable>& tables);

// Of a model without the materials that it refers to.
MaterialTraits traits_of(const MaterialModel& model);
// With them: `others` are those of the materials before it.
MaterialTraits traits_of(const Material& material, const std::vector<MaterialTraits>& others);
// Of each material of a scene or bundle.
std::vector<MaterialTraits> traits_of(const std::vector<Material>& materials);

// The materials that a material refers to.
std::vector<Id<Material>> parts_of(const MaterialModel& model);

// Whether it scatters as the materials do that it refers to. Bumps are theirs.
inline bool is_made_of_others(const Material& material) { return !parts_of(material.model).empty(); }

// Whether its surface looks different from its two sides; `others` says it of the materials before it.
bool has_sides(const Material& material, const MaterialTraits& traits, const std::vector<bool>& others);
std::vector<bool> with_sides(const std::vector<Material>& materials);

// Whether it blends what turns light by a mirror with what spreads it.
bool blends_mirror_with_spread(const Material& material, const std::vector<MaterialTraits>& others);

// Whether microfacets are none: a smooth surface.
bool is_smooth(const Roughness& roughness);

}  // namespace vitrail
