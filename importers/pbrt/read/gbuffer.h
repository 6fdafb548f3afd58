// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/records/film_layers.h"

namespace vitrail::pbrt {

// Returns the layers that pbrt's film "gbuffer" keeps of the first surfaces.
constexpr FilmLayers gbuffer_layers() {
  FilmLayers layers;
  for (const Layer layer :
       {Layer::albedo, Layer::position, Layer::geometric_normal, Layer::shading_normal, Layer::uv})
    layers.add(layer);
  return layers;
}

}  // namespace vitrail::pbrt
