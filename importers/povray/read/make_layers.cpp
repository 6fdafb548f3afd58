// SPDX-License-Identifier: Apache-2.0
// Several textures on one surface: layers over each other, and patterns between textures.
#include <algorithm>
#include <array>
#include <memory>
#include <type_traits>

#include "importers/povray/read/formula.h"
#include "importers/povray/read/pigment_patterns.h"
#include "importers/povray/read/reader.h"
#include "importers/povray/read/surfaces.h"

namespace vitrail::pov {

namespace {

SpectrumParameter as_spectrum(const FloatParameter& number) {
  if (const auto* id = std::get_if<Id<vitrail::Texture>>(&number)) return *id;
  return Spectrum{ConstantSpectrum{std::get<float>(number)}};
}

bool is_clear_coat(const pov::Texture& texture) {
  const bool is_clear = texture.layers.empty() && !texture.pattern && texture.pigment &&
                        texture.pigment->color &&
                        texture.pigment->color->v[3] + texture.pigment->color->v[4] >= 1;
  const auto is_white = [](const Numbers& c) { return std::min({c.v[0], c.v[1], c.v[2]}) >= 1; };
  return is_clear && texture.finish && texture.finish->diffuse == 0 &&
         (!(texture.pigment->color->v[3] > 0) || is_white(*texture.pigment->color));
}

bool is_glossy(const pov::Texture& texture) {
  if (!texture.finish) return false;
  const Finish& f = *texture.finish;
  const Numbers& most = f.reflection_max;
  return f.phong > 0 || f.specular > 0 ||
         (f.has_reflection && std::max({most.v[0], most.v[1], most.v[2]}) > 0);
}

// A surface below a layer: with the mirror and highlights of that, which are the same however clear the layer
// is. None where the surface has its own.
Shared<pov::Texture> coated(const pov::Texture& below, const pov::Texture& coat) {
  if (!below.layers.empty() || below.pattern || is_glossy(below) || (below.normal && coat.normal))
    return nullptr;
  const Finish under = below.finish ? *below.finish : Finish{};
  auto finish = std::make_shared<Finish>(*coat.finish);
  finish->ambient = under.ambient, finish->emission = under.emission, finish->diffuse = under.diffuse;
  finish->diffuse_back = under.diffuse_back, finish->brilliance = under.brilliance,
  finish->crand = under.crand;
  auto both = std::make_shared<pov::Texture>(below);
  both->finish = finish;
  if (coat.normal) both->normal = coat.normal;
  return both;
}

// The layers, clear coats in what is below them. What else is below something glossy gets its gloss.
std::vector<Shared<pov::Texture>> without_coats(const std::vector<Shared<pov::Texture>>& layers) {
  std::vector<Shared<pov::Texture>> left;
  for (const Shared<pov::Texture>& layer : layers) {
    const auto both = !left.empty() && is_clear_coat(*layer) ? coated(*left.back(), *layer) : nullptr;
    if (both)
      left.back() = both;
    else
      left.push_back(layer);
  }
  for (std::size_t i = left.size(); i-- > 1;) {
    const bool is_simple = left[i]->layers.empty() && !left[i]->pattern;
    if (!is_simple || !is_glossy(*left[i]) || left[i]->normal) continue;
    if (const auto both = coated(*left[i - 1], *left[i])) left[i - 1] = both;
  }
  return left;
}

bool has_filter(const Pigment& pigment) {
  if (pigment.color) return pigment.color->v[3] > 0;
  return pigment.map && std::ranges::any_of(pigment.map->entries, [](const BlendEntry& entry) {
           return entry.pigment ? has_filter(*entry.pigment) : entry.color.v[3] > 0;
         });
}

// Returns the pigment with `change` applied to each of its colours.
template <class Change>
Shared<Pigment> with_colors(const Pigment& pigment, const Change& change) {
  auto changed = std::make_shared<Pigment>(pigment);
  if (changed->color) change(*changed->color);
  if (!pigment.map) return changed;
  auto map =
      std::make_shared<std::remove_const_t<std::remove_reference_t<decltype(*pigment.map)>>>(*pigment.map);
  for (BlendEntry& entry : map->entries) {
    change(entry.color);
    if (entry.pigment) entry.pigment = with_colors(*entry.pigment, change);
  }
  changed->map = map;
  return changed;
}

// Returns the layer as before version 3.5: `filter` is `transmit`, as povray's pixels say.
Shared<pov::Texture> without_filter(const Shared<pov::Texture>& layer) {
  if (!layer->pigment || !has_filter(*layer->pigment)) return layer;
  auto changed = std::make_shared<pov::Texture>(*layer);
  changed->pigment = with_colors(*layer->pigment, [](Numbers& color) {
    color.v[4] += std::max(color.v[3], 0.0);
    color.v[3] = 0;
  });
  return changed;
}

}  // namespace

Shared<Pigment> filtered_by(const Pigment& pigment, const std::array<double, 3>& through) {
  return with_colors(pigment, [&](Numbers& color) {
    for (std::size_t i = 0; i < through.size(); ++i) color.v[i] *= through[i];
  });
}

// The light below is multiplied by filter·colour + transmit. `crand` is taken of a layer's light after that
// is weakened by what shows through: as much of a clear one.
void Surfaces::put_above(const pov::Texture& texture, const Transform& to_world, Look& look) {
  if (!texture.pigment || texture.pattern || !texture.layers.empty()) return;
  const Pigment& pigment = *texture.pigment;
  if (texture.finish) look.crand_above += texture.finish->crand * grey_of(mean_color(pigment));
  if (!has_filter(pigment)) return;
  if (pigment.color) {
    const auto& v = pigment.color->v;
    const double filter = std::max(v[3], 0.0), transmit = std::max(v[4], 0.0);
    const double all = std::max(share_through(*pigment.color), 1e-6);
    for (std::size_t i = 0; i < 3; ++i)
      look.filter_above[i] *= std::clamp((v[i] * filter + transmit) / all, 0.0, 1.0);
  } else {
    const Transform placed = placed_in(to_world, texture) * pigment.to_object;
    const bool by_uv = look.by_uv || texture.by_uv;
    look.tint = tinted(color_texture(pigment, placed, Part::filtered, 1, by_uv), look, texture.place);
  }
}

Surfaces::Layer Surfaces::mixed(const Layer& first, const Layer& second, const FloatParameter& amount,
                                const Place& place) {
  Layer both = first;
  if (first.opacity == FloatParameter{0.0f})  // the opacity says how much there is of what is not clear
    both.material = second.material;
  else if (second.opacity != FloatParameter{0.0f})
    both.material = add(BlendMaterial{first.material, second.material, amount}, place);
  both.glow_scale = std::max(first.glow_scale, second.glow_scale);
  if (both.glow_scale > 0) both.glow = add(MixTexture{first.glow, second.glow, amount}, false, place);
  if (first.opacity == FloatParameter{0.0f} && second.opacity == FloatParameter{1.0f})
    both.opacity = amount;
  else if (first.opacity != second.opacity)
    both.opacity =
        add(MixTexture{as_spectrum(first.opacity), as_spectrum(second.opacity), amount}, true, place);
  return both;
}

// An average of a texture, of one that only glows, and of black less once: the first texture, which also
// glows. Of what is clear a lamp of nothing is left.
void Surfaces::add_glow_alone(std::vector<std::pair<double, Layer>>& layers, const Place& place) {
  const auto is_black = [&](const Layer& layer) {
    const auto* const diffuse = std::get_if<DiffuseMaterial>(&scene_.materials[layer.material.value].model);
    const auto* const reflects = diffuse ? std::get_if<Spectrum>(&diffuse->reflectance) : nullptr;
    return reflects && luminance(*reflects) == 0 && layer.opacity == FloatParameter{1.0f};
  };
  if (layers.size() != 3) return;
  const auto& [weight, glowing] = layers[1];
  const auto& [less, black] = layers[2];
  if (layers[0].first != weight || weight != -less || !is_black(glowing) || !is_black(black) ||
      layers[0].second.glow_scale > 0)
    return;
  layers[0].second.glow = glowing.glow, layers[0].second.glow_scale = glowing.glow_scale;
  layers.resize(1);
  if (layers[0].second.opacity != FloatParameter{0.0f}) return;
  layers[0].second.opacity = 1.0f;
  layers[0].second.material = add(InterfaceMaterial{}, place);
}

Surfaces::Layer Surfaces::layered(const pov::Texture& texture, const Transform& to_world,
                                  const Look& around) {
  Look look = around;
  look.by_uv = look.by_uv || texture.by_uv;
  if (texture.layers.empty())
    return texture.pattern ? blended(texture, to_world, look) : layer_of(texture, to_world, look);
  Layer result;
  std::vector<Shared<pov::Texture>> layers = without_coats(texture.layers);
  if (reader_.version > 0 && reader_.version < 3.5)
    for (std::size_t i = 1; i < layers.size(); ++i) layers[i] = without_filter(layers[i]);
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const pov::Texture& one = *layers[i];
    Look worn = look;
    worn.covers = look.covers || i > 0;
    for (std::size_t j = i + 1; j < layers.size(); ++j) put_above(*layers[j], to_world, worn);
    const Layer above = layered(one, placed_in(to_world, one), worn);
    const float* const opacity = std::get_if<float>(&above.opacity);
    if (i == 0 || (opacity && *opacity >= 1)) {
      result = above;
      continue;
    }
    // What is behind shows through both.
    const float* const below = std::get_if<float>(&result.opacity);
    const FloatParameter through =
        below && *below >= 1
            ? FloatParameter{1.0f}
            : add(MixTexture{as_spectrum(result.opacity), as_spectrum(FloatParameter{1.0f}), above.opacity},
                  true, one.place);
    result = mixed(result, above, above.opacity, one.place);
    result.opacity = through;
  }
  return result;
}

// Each piece of the map is a mixture of both its ends; `average` is one of all, by their weights.
Surfaces::Layer Surfaces::blended(const pov::Texture& texture, const Transform& to_world, const Look& look) {
  std::vector<std::pair<double, Layer>> layers;
  if (texture.map)
    for (const BlendEntry& entry : texture.map->entries)
      if (entry.texture)
        layers.emplace_back(entry.at, layered(*entry.texture, placed_in(to_world, *entry.texture), look));
  if (layers.empty()) {
    dropped("a pattern of textures without textures: black", texture.place);
    return layer_of({}, to_world, look);
  }
  const Word kind = texture.pattern->kind;
  if (kind == Word::average_) add_glow_alone(layers, texture.place);
  Layer result = layers.front().second;
  const bool list = places_of_list(kind) > 0;
  double weights = layers.front().first;
  for (std::size_t i = 1; i < layers.size(); ++i) {
    weights += layers[i].first;
    const FloatParameter amount =
        kind == Word::average_
            ? FloatParameter{static_cast<float>(weights > 0 ? layers[i].first / weights : 0)}
            : amount_texture(*texture.pattern, to_world, look.by_uv, layers[i - 1].first, layers[i].first,
                             texture.place, list, i);
    result = mixed(result, layers[i].second, amount, texture.place);
  }
  return result;
}

}  // namespace vitrail::pov
