// SPDX-License-Identifier: Apache-2.0
// These traits follow from a material's record alone, and are said once for readers, writers, the partitioner
// and the tracer. Every kind of material has its row in material_traits.cpp: without one, a new kind does not
// compile.
#pragma once

#include <vector>

#include "scene/records/material.h"
#include "scene/records/scattering_table.h"

namespace vitrail {

// It says how a material turns light: `smooth` by mirrors and smooth interfaces, `spread` by all that spreads
// it. Light that goes straight on is neither.
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

// Returns whether a model, without the materials that it refers to, has a direction along the surface: as its
// traits say, but for tables that turn out to have none. `tables` are those of its scene.
bool has_direction(const MaterialModel& model, const std::vector<ScatteringTable>& tables);

// Returns the traits of a model without the materials that it refers to.
MaterialTraits traits_of(const MaterialModel& model);
// Returns the traits with those materials: `others` are the traits of the materials before it.
MaterialTraits traits_of(const Material& material, const std::vector<MaterialTraits>& others);
// Returns the traits of each material of a scene or bundle.
std::vector<MaterialTraits> traits_of(const std::vector<Material>& materials);

// Returns the materials that a material refers to.
std::vector<Id<Material>> parts_of(const MaterialModel& model);

// Returns whether it scatters as the materials do that it refers to. Bumps are theirs.
inline bool is_made_of_others(const Material& material) { return !parts_of(material.model).empty(); }

// has_sides returns whether its surface looks different from its two sides; `others` says it of the materials
// before it. with_sides returns it for each material.
bool has_sides(const Material& material, const MaterialTraits& traits, const std::vector<bool>& others);
std::vector<bool> with_sides(const std::vector<Material>& materials);

// Returns whether it blends a material that turns light by a mirror with one that spreads it.
bool blends_mirror_with_spread(const Material& material, const std::vector<MaterialTraits>& others);

// Returns whether there are no microfacets: a smooth surface.
bool is_smooth(const Roughness& roughness);

}  // namespace vitrail
