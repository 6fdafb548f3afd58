// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "scene/records/film_layers.h"

namespace vitrail::mitsuba {

// Returns how a film's layers differ from what Mitsuba's integrator `aov` gives under their names; empty
// where they do not.
inline std::string difference_from_mitsuba(const FilmLayers& layers) {
  std::vector<std::string> all;
  if (layers.has(Layer::albedo))
    all.emplace_back("the albedo is of all that is scattered, Mitsuba's of diffuse light");
  if (layers.has(Layer::geometric_normal) || layers.has(Layer::shading_normal))
    all.emplace_back("normals face the camera, Mitsuba's the front");
  if (layers.has(Layer::depth))
    all.emplace_back("the depth is from the camera, Mitsuba's from its near plane");
  if (id_planes(layers) > 0)
    all.emplace_back("indices are of one sample and count all of the scene, Mitsuba's are means");
  return fmt::format("{}", fmt::join(all, "; "));
}

}  // namespace vitrail::mitsuba
