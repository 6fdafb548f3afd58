// SPDX-License-Identifier: Apache-2.0
// Mitsuba's reader and writer ask how Mitsuba shows the parts that materials are made of.
#pragma once

#include <vector>

#include "scene/records/material_traits.h"
#include "scene/records/scene.h"

namespace vitrail::mitsuba {

struct MaterialParts {
  bool straight = false;        // lets light straight through
  bool spread_through = false;  // lets light through that it spreads
  bool height = false;          // some of it has a bump map
  bool bumps = false;           // some of it has a bump map or a normal map
};

// `others` has the parts of the materials that `material` refers to, which come before it.
MaterialParts parts_of(const Material& material, const std::vector<MaterialParts>& others);
std::vector<MaterialParts> parts_of(const std::vector<Material>& materials);

// Returns how Mitsuba 3.9 shows a material's own bumps otherwise, a sentence each.
std::vector<const char*> bumps_shown_otherwise(const Material& material);

// Returns whether Mitsuba 3.9's spectral variants show a principled material otherwise: its tints are the
// colour divided by the luminance of each sample's few wavelengths.
bool is_tinted(const PrincipledMaterial& material);

// Returns whether Mitsuba 3.9 shows the blend too dark: it divides what goes into one direction, as by a
// mirror, by the density of what the other part spreads there.
bool is_darkened(const Material& blend, const std::vector<MaterialTraits>& traits,
                 const std::vector<MaterialParts>& parts);

// Returns whether one of the scene's textures reads values at the mesh's vertices. In an instance that is not
// where its group is Mitsuba 3.9 takes wrong ones: it compares the place in the world with the vertices of
// the group.
bool has_read_vertices(const Scene& scene, const TriangleMesh& mesh);

}  // namespace vitrail::mitsuba
