// SPDX-License-Identifier: Apache-2.0
#include "scene/records/film_layers.h"

namespace vitrail {

bool add_named(FilmLayers& layers, std::string_view name) {
  if (const std::size_t colon = name.find(':'); colon != std::string_view::npos)
    name.remove_prefix(colon + 1);
  if (name == "normal") name = kind_of(Layer::shading_normal).name;
  if (name == "cryptomatte") {
    layers.add(Layer::crypto_object), layers.add(Layer::crypto_material);
    return true;
  }
  for (std::size_t i = 0; i < layer_count; ++i)
    if (name == layer_kinds[i].name) {
      layers.add(static_cast<Layer>(i));
      return true;
    }
  return false;
}

std::string names_of(const FilmLayers& layers) {
  std::string names;
  for (std::size_t i = 0; i < layer_count; ++i) {
    if (!layers.has(static_cast<Layer>(i))) continue;
    if (!names.empty()) names += ',';
    names += layer_kinds[i].name;
  }
  return names;
}

}  // namespace vitrail
