// SPDX-License-Identifier: Apache-2.0
// These functions choose the power of two that a film counts in, by the scene's lights.
#pragma once

#include <optional>

#include "tracer/prepared/render_scene.h"

namespace vitrail {

// It is the range of radiances in a picture before surfaces dim them. A light of no extent counts by the
// radiances that surfaces show of it.
struct LightRange {
  double dimmest = 0, brightest = 0;  // > 0
};

// Returns the range of the lights that shine; none: there are none.
std::optional<LightRange> light_range(const RenderScene& scene);

// `brighter` is the factor by which a deposit may exceed radiance, for the weights of filter and spectral
// bins. The exponent resolves light 2⁴⁰ times dimmer than the dimmest where that leaves room above the
// brightest. Deposits have room for 2¹⁶ times the brightest at least, and 2⁴⁰ times where there is room for
// both.
int film_exponent(const LightRange& range, double brighter, bool splats = false);
int film_exponent(const RenderScene& scene);

// Returns the exponent of the distances and positions that a film keeps in layers: 2⁻⁴⁵ of how far the scene
// and the camera reach.
int length_exponent(const RenderScene& scene);

}  // namespace vitrail
