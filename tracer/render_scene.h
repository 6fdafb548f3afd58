// SPDX-License-Identifier: Apache-2.0
// What every rank holds of the scene besides domains, prepared for tracing.
#pragma once

#include "bundle/manifest.h"
#include "tracer/camera.h"
#include "tracer/lights.h"
#include "tracer/pixel_filter.h"

namespace vitrail {

struct RenderScene {
  Manifest manifest;
  FilterSampler filter;
  LightSampler lights;
  std::uint64_t seed = 0;
};

RenderScene make_render_scene(Manifest manifest, std::uint64_t seed);

// The surface that a triangle belongs to.
const Surface& surface_of(const Manifest& manifest, std::uint32_t triangle);

}  // namespace vitrail
