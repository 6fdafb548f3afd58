// SPDX-License-Identifier: Apache-2.0
#include "tracer/render_scene.h"

#include <algorithm>

namespace vitrail {

RenderScene make_render_scene(Manifest manifest, std::uint64_t seed) {
  FilterSampler filter(manifest.film.filter);
  LightSampler lights = make_light_sampler(manifest);
  return {std::move(manifest), std::move(filter), std::move(lights), seed};
}

const Surface& surface_of(const Manifest& manifest, std::uint32_t triangle) {
  const auto behind =
      std::upper_bound(manifest.surfaces.begin(), manifest.surfaces.end(), triangle,
                       [](std::uint32_t id, const Surface& surface) { return id < surface.first_triangle; });
  return *(behind - 1);
}

}  // namespace vitrail
