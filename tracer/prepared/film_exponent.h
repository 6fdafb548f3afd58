// SPDX-License-Identifier: Apache-2.0
// The power of two that a film counts in, by the scene's lights.
#pragma once

#include <optional>

#include "tracer/prepared/render_scene.h"

namespace vitrail {

// Radiances, or what lights of no extent come to: what a picture is made of before surfaces dim it.
struct LightRange {
  double dimmest = 0, brightest = 0;  // > 0
};

// Of the lights that shine; none: there are none.
std::optional<LightRange> light_range(const RenderScene& scene);

// `brighter`: by how much a deposit may exceed radiance for the weights of filter and spectral bins. Light
// 2⁴⁰ times dimmer than the dimmest is resolved where that leaves room above the brightest: for deposits of
// 2¹⁶ times it at least, and 2⁴⁰ times it where there is room for both.
int film_exponent(const LightRange& range, double brighter, bool splats = false);
int film_exponent(const RenderScene& scene);

// Of the distances and positions that a film keeps in layers: 2⁻⁴⁵ of how far the scene and the camera reach.
int length_exponent(const RenderScene& scene);

}  // namespace vitrail
