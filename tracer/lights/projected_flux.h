// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "scene/records/light.h"
#include "tracer/textures/textures.h"

namespace vitrail {

// Returns ∫ Y dω of what a light projects through a rectangle at z = 1 of half widths `half`, its scale left
// out. An image counts by all of its texels, as in pbrt-v4. It is 0 only where certainly nothing shines.
double projected_flux(const ProjectionLight& light, Point2d half, const Textures* textures,
                      std::span<const Texture> records);
// It has the flux of one of side² alike parts of that frame, row by row from the bottom.
struct FrameFlux {
  double mean = 0, most = 0;  // of the flux per area of the frame
};
std::vector<FrameFlux> parts_of_frame(const SpectrumParameter& image, Point2d half, bool irradiance, int side,
                                      const Textures* textures, std::span<const Texture> records);
// Returns the mean of a spot's texture over its frame. It is 0 only where certainly nothing shines.
double mean_over_frame(const SpectrumParameter& texture, const Textures* textures,
                       std::span<const Texture> records);

}  // namespace vitrail
