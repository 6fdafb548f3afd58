// SPDX-License-Identifier: Apache-2.0
// Each row in these films of sensors is of another light of the sky; rows are not samples of one light. They
// give daylight coefficients (Tregenza & Waters, "Daylight coefficients", 1983).
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "scene/daylight/sky_patches.h"
#include "scene/spectra/color.h"
#include "tracer/lights/environment.h"

namespace vitrail {

// It says what the rows of a film are: patches or suns. With patches light comes from all around, and a
// column's paths are one sequence. What leaves the scene is added to the row of the patch that it goes to.
// The mean of a row, over the number of rows, is then the patch's coefficient. With suns the one distant
// light of the scene stands elsewhere for each row. All of a path's connections go to a point of that row's
// disc.
struct DaylightRows {
  std::optional<SkyPatches> patches;
  DirectionFrame sky;            // of the patches
  std::vector<Vector3d> suns;    // unit, towards each, in the bundle's coordinates
  bool reflected_alone = false;  // of suns: without what comes to the sensor from them directly

  // Returns whether rows are lights at all.
  bool any() const { return patches || !suns.empty(); }
  std::size_t count() const { return patches ? patches->count() : suns.size(); }
  // Returns the row of a direction out of the scene, of any length.
  std::size_t row_of(Vector3f direction) const {
    return patches->patch_of(sky.to_light(normalize(cast<double>(direction))));
  }
};

struct RenderScene;
// Returns what films have as X, Y and Z. It is the observer of the CIE, or, in a scene whose colours are
// bands, the one that sees bands (`band_observer`). With such rows it is x̄ and ȳ of the CIE, and in the
// place of z̄ the melanopic action spectrum (scene/daylight/photometry.h).
const std::array<std::array<float, 3>, table_size>& observer_of(const RenderScene& scene);

// Gives the rows to a scene whose only light is an infinite one, for patches, or a distant one.
void set_daylight(RenderScene& scene, DaylightRows rows);

}  // namespace vitrail
