// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "importers/povray/write/context.h"
#include "scene/records/pattern_texture.h"

namespace vitrail::povray {

// Returns a pattern with its modifiers, and `values` of its map: pigments, as they are written. Without a map
// it goes from 0 to 1.
std::string pattern_text(const PatternTexture& pattern, const std::vector<std::string>& values);

// Returns what is behind `normal {`, of a pattern that tilts normals (scene/models/pattern_normal.h): each
// piece of its map is one of a slope_map. Returns none where its values are textures.
std::optional<std::string> normal_text(const PatternTexture& texture);

// Returns " normal { … }" of the material's heights, "" where nothing tilts.
std::string bumps_of(Context& context, const Material& material);

// Returns functions of POV-Ray's language that facet_text calls.
const char* facet_functions();
// Returns what is behind `normal {`: each small cube of space tilts normals at random, with the slopes of
// microfacets of that α.
std::string facet_text(double alpha, bool beckmann, double size);
// Returns about the share of light that rough mirrors reflect from one facet alone, and not into the surface.
double facet_albedo(double alpha, bool beckmann);

// It is a rough metal under an interface: its facets, and the shares of light that either's facets keep, and
// that passes the coating once.
struct CoatedFacets {
  double eta = 1.5, alpha = 0, albedo = 1, interface_albedo = 1, entering = 1;
};
// Returns what both show at normal incidence, before `albedo` is taken off, of a metal that reflects `bare`.
RGB with_interface(RGB bare, const CoatedFacets& facets);

}  // namespace vitrail::povray
