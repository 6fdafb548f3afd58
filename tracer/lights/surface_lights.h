// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "tracer/lights/light_sampler.h"

namespace vitrail {

struct SurfaceLights {
  std::vector<LightBounds> bounds;  // of the triangles and then the quadrics
  std::vector<Glow> glows;          // of the area lights
  std::vector<TriangleParts> parts;
  std::vector<std::uint32_t> parts_of;  // of each triangle; as in LightSampler
};

// Returns what surfaces send; a texture counts by all that it has in boxes around parts of a surface. Power
// is luminous flux over 683 lm/W of both sides that shine, and 0 only where certainly nothing does. No
// surface of an area light counts, for its area, for less than a tenth of the mean of all of them. Triangles
// are parted where they are few.
SurfaceLights surface_lights(const LightScene& scene, std::span<const QuadricLight> quadrics);

}  // namespace vitrail
