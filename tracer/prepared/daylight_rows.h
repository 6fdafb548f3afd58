// SPDX-License-Identifier: Apache-2.0
// Films of sensors whose rows are not samples of one light, but each of another light of the sky: daylight
// coefficients (Tregenza & Waters, "Daylight coefficients", 1983).
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "scene/daylight/sky_patches.h"
#include "scene/spectra/color.h"
#include "tracer/lights/environment.h"

namespace vitrail {

// What the rows of a film are. Either patches: light comes from all around, a column's paths are one
// sequence, and what leaves the scene is added to the row of the patch that it goes to. The mean of a row,
// over the number of rows, is then the patch's coefficient. Or suns: the one distant light of the scene
// stands elsewhere for each row, and all of a path's connections go to a point of that row's disc.
struct DaylightRows {
  std::optional<SkyPatches> patches;
  DirectionFrame sky;            // of the patches
  std::vector<Vector3d> suns;    // unit, towards each, in the bundle's coordinates
  bool reflected_alone = false;  // of suns: without what comes to the sensor from them directly

  // Whether rows are lights at all.
  bool any() const { return patches || !suns.empty(); }
  std::size_t count() const { return patches ? patches->count() : suns.size(); }
  // The row of a direction out of the scene, of any length.
  std::size_t row_of(Vector3f direction) const {
    return patches->patch_of(sky.to_light(normalize(cast<double>(direction))));
  }
};

struct RenderScene;
// Returns what films have as X, Y and Z: the observer of the CIE; of a scene whose colours are bands the one
// that sees those (`band_observer`). With such rows it is x̄ and ȳ of the CIE, and in the place of z̄ the
// melanopic action spectrum (scene/daylight/photometry.h).
const std::array<std::array<float, 3>, table_size>& observer_of(const RenderScene& scene);

// Gives them to a scene whose lights are one that is infinite, for patches, or one that is distant.
void set_daylight(RenderScene& scene, DaylightRows rows);

}  // namespace vitrail
