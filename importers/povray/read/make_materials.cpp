// SPDX-License-Identifier: Apache-2.0
// Finishes as BSDFs. A lamp of colour c shows ρ·c·cos θ on a diffuse surface of reflectance ρ = pigment ·
// diffuse, as its intensity is π·c here. Highlights are a FinishMaterial; for export, and upon a coat, a
// highlight s·(n·h)^m adds a lobe of Beckmann's microfacets of α² = 2/(m + 2), whose share w is such that its
// peak is as high: π·c·w/(4π·α²) = s·c.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "importers/povray/read/pigment_patterns.h"
#include "importers/povray/read/reader.h"
#include "importers/povray/read/surfaces.h"
#include "scene/records/material_traits.h"
#include "scene/spectra/rgb_to_spectrum.h"

namespace vitrail::pov {

namespace {

const Finish& default_finish() {
  static const Finish finish;
  return finish;
}

double greatest(const Numbers& color) { return std::max({color.v[0], color.v[1], color.v[2]}); }

// The greatest number of its colours.
double brightest(const Pigment& pigment) {
  if (pigment.color) return greatest(*pigment.color);
  double most = 0;
  if (pigment.map)
    for (const BlendEntry& entry : pigment.map->entries)
      most = std::max(most, entry.pigment ? brightest(*entry.pigment) : greatest(entry.color));
  return most;
}

// Lobes beside the diffuse one, with their shares of all light.
struct Lobe {
  MaterialModel model;
  double share = 0;
};

struct Highlight {
  double strength = 0, exponent = 1;
};

// Of (n·h): a phong exponent is of the mirrored direction, whose angle is twice as wide.
Highlight highlight_of(const Finish& finish) {
  if (finish.specular > 0) return {finish.specular, 1 / std::max(finish.roughness, 1e-4)};
  if (finish.phong > 0) return {finish.phong, 4 * std::max(finish.phong_size, 0.1)};
  return {};
}

// `crand` c, as povray shows it: each lamp adds pigment·(diffuse·cosᵇθ − c·u), with u random in 0 … 1 and b
// the brilliance. Its mean, diffuse·cosᵇθ − c/2, is that of a greater brilliance: equal at two angles.
struct Falloff {
  double diffuse = 0, brilliance = 1;
  double grain = 0;  // of the mean, at most: it is times 1 − grain … 1 + grain
};

double darkened(const Finish& finish) { return std::max(finish.diffuse - finish.crand / 2, 0.0); }

Falloff falloff_of(const Finish& finish) {
  constexpr double straight = 0.9, aside = 0.6;  // cos θ
  constexpr double least = 1.0 / 16;
  const double b = std::max(finish.brilliance, 0.0);
  const auto left = [&](double x) { return finish.diffuse * std::pow(x, b) - finish.crand / 2; };
  const double first = left(straight);
  if (!(first > 0)) return {};
  const double second = std::max(left(aside), least * first);
  Falloff f;
  f.brilliance = std::log(first / second) / std::log(straight / aside);
  f.diffuse = first / std::pow(straight, f.brilliance);
  f.grain = std::min(finish.crand / 2 / first, 1.0);
  return f;
}

std::string key_of(const Numbers& n) {
  return fmt::format("{},{},{},{},{};", n.v[0], n.v[1], n.v[2], n.v[3], n.v[4]);
}

std::string key_of(const Finish& f) {
  return key_of(f.ambient) + key_of(f.emission) + key_of(f.reflection_min) + key_of(f.reflection_max) +
         fmt::format("{},{},{},{},{},{},{},{},{},{},{},{};", f.diffuse, f.brilliance, f.phong, f.phong_size,
                     f.specular, f.roughness, f.metallic, f.fresnel, f.reflection_metallic, f.diffuse_back,
                     f.subsurface, f.crand) +
         fmt::format("{},{};", f.reflection_falloff, f.conserve_energy);
}

std::string key_of(const Look& look) {
  std::string key = fmt::format("{},{},{},{};", static_cast<const void*>(look.interior.get()), look.by_uv,
                                look.uvs_are_places, look.double_illuminate);
  if (!look.texture) return key;
  const pov::Texture& t = *look.texture;
  if (t.layers.empty() && !t.pattern && !t.normal && t.pigment && t.pigment->color) {
    key += "c" + key_of(*t.pigment->color);
    return key + key_of(t.finish ? *t.finish : default_finish());
  }
  key += fmt::format("{};{};{};{};", static_cast<const void*>(t.pigment.get()),
                     static_cast<const void*>(t.finish.get()), static_cast<const void*>(t.map.get()),
                     static_cast<const void*>(t.normal.get()));
  if (t.pattern || !t.layers.empty())
    key += fmt::format("t{};", static_cast<const void*>(look.texture.get()));
  const bool by_uv = look.by_uv || t.by_uv;
  if (is_plain(t) && !by_uv) return key;
  const Transform placed = by_uv ? t.to_object : look.to_world * t.to_object;
  for (const auto& row : placed.m) key += fmt::format("{},{},{},{};", row[0], row[1], row[2], row[3]);
  return key;
}

}  // namespace

bool is_plain(const Pigment& pigment) {
  if (pigment.color || pigment.pattern.kind == Word::none) return true;
  return pigment.pattern.uv_mapping;
}

bool is_plain(const pov::Texture& texture) {
  if (texture.normal) return false;
  if (texture.by_uv) return true;
  if (texture.pattern) return false;
  for (const auto& layer : texture.layers)
    if (!is_plain(*layer)) return false;
  return !texture.pigment || is_plain(*texture.pigment);
}

void Surfaces::approximated(const std::string& message, const Place& place) {
  reader_.notes.approximated(message, reader_.location(place));
}
void Surfaces::dropped(const std::string& message, const Place& place) {
  reader_.notes.dropped(message, reader_.location(place));
}

Id<Material> Surfaces::add(MaterialModel model, const Place& place) {
  Material material;
  material.model = std::move(model);
  material.origin = origin(place);
  const bool has_faces =
      !is_made_of_others(material) && !std::holds_alternative<ThinDielectricMaterial>(material.model);
  if (has_faces) material.displacement = displacement_;
  return append(scene_.materials, std::move(material));
}

Surface Surfaces::of(const Look& look) {
  const std::string key = key_of(look);
  if (const auto known = made_.find(key); known != made_.end()) return known->second;
  kept_.push_back(look.texture);
  return made_[key] = made(look);
}

Surface Surfaces::of_sides(const Look& look, const Place& place) {
  const Surface outside = of(look);
  if (!look.interior_texture) return outside;
  Look within = look;
  within.texture = look.interior_texture, within.to_world = look.interior_to_world;
  const Surface inside = of(within);
  const std::array<std::uint32_t, 3> key{outside.material.value, inside.material.value,
                                         outside.glow ? outside.glow->value + 1 : 0};
  const auto [known, is_new] = sides_.try_emplace(key);
  if (is_new) {
    const std::vector<MaterialTraits> traits = traits_of(scene_.materials);
    const auto is_opaque = [&](const Surface& s) {
      return s.opacity == FloatParameter{1.0f} && !traits[s.material.value].transmits;
    };
    // A lamp of nothing that is clear from behind.
    const bool is_lamp =
        outside.glow && inside.opacity == FloatParameter{0.0f} && !inside.glow &&
        std::holds_alternative<InterfaceMaterial>(scene_.materials[outside.material.value].model);
    if (is_lamp || (is_opaque(outside) && is_opaque(inside) && !inside.glow)) {
      known->second = outside;
      if (!is_lamp && inside.material != outside.material)
        known->second->material = add(TwoSidedMaterial{outside.material, inside.material}, place);
      if (outside.glow) {
        AreaLight front = scene_.area_lights[outside.glow->value];
        front.two_sided = false;
        known->second->glow = append(scene_.area_lights, std::move(front));
      }
    }
  }
  if (known->second) return *known->second;
  approximated("interior_texture, where it glows or light goes through: the texture outside", place);
  return outside;
}

Surface Surfaces::made(const Look& look) {
  static const auto black = std::make_shared<pov::Texture>();
  const pov::Texture& texture = look.texture ? *look.texture : *black;
  constexpr double flat = 1e9;
  uvs_are_places_ = look.uvs_are_places;
  uv_space_ = uvs_are_places_ ? scale({1, 1, flat}) : Transform{};
  const Transform to_world = placed_in(look.by_uv ? uv_space_ : look.to_world, texture);
  const bool alone = texture.layers.empty() && !texture.pattern;
  const Layer result = alone ? layer_of(texture, to_world, look, alone) : layered(texture, to_world, look);
  Surface surface{result.material, std::nullopt, result.opacity};
  if (result.glow_scale > 0) {
    AreaLight glow;
    glow.radiance = result.glow;
    glow.two_sided = true;
    glow.sampled = false;
    glow.origin = origin(texture.place);
    surface.glow = append(scene_.area_lights, std::move(glow));
  }
  return surface;
}

Surfaces::Layer Surfaces::layer_of(const pov::Texture& texture, const Transform& to_world, const Look& given,
                                   bool alone) {
  static const auto black = [] {
    auto pigment = std::make_shared<Pigment>();
    pigment->color = Finish::grey(0);
    return Shared<Pigment>(pigment);
  }();
  Look look = given;
  look.by_uv = look.by_uv || texture.by_uv;
  const Shared<Pigment> own = filtered_by(texture.pigment ? *texture.pigment : *black, look.filter_above);
  const Pigment& pigment = *own;
  const auto& [r, g, b] = look.filter_above;
  if (!pigment.color && !pigment.map && std::min({r, g, b}) < 1)  // an image
    look.tint = tinted(Spectrum{unbounded_from_rgb({r, g, b})}, look, pigment.place);
  Finish finish = texture.finish ? *texture.finish : default_finish();
  if (look.crand_above > 0 && !look.covers)
    finish.crand += std::min(look.crand_above / std::max(grey_of(mean_color(pigment)), 1e-3), finish.diffuse);
  if (look.double_illuminate && finish.diffuse_back == 0) finish.diffuse_back = finish.diffuse;
  const Transform placed = to_world * pigment.to_object;
  Layer layer;
  layer.opacity = opacity_of(pigment, placed, look.by_uv);
  const float* const opacity = std::get_if<float>(&layer.opacity);
  const bool shows_behind = opacity && *opacity < 1 && !look.covers;
  const bool clear = shows_behind && look.interior && look.interior->ior > 1.0001;
  const bool colored = shows_behind && pigment.color && pigment.color->v[3] > 0;
  Body body{pigment, finish, placed, look, std::nullopt, texture.place};
  body.glazed = opacity && (alone || clear || colored || *opacity >= 1) &&
                is_glazed(finish, look.interior.get(), *opacity);
  if (clear || colored || (body.glazed && *opacity < 1)) body.solid = *opacity;
  const Bump* const bump = texture.normal.get();
  if (bump && (look.by_uv || bump->pattern.uv_mapping))
    approximated("uv_mapping of a normal: it lies by position", bump->place);
  layer.material = bumpy(body, bump, bump ? to_world * bump->to_object : to_world);
  if (body.solid) layer.opacity = 1.0f;
  std::array<double, 3> factors;
  for (std::size_t i = 0; i < 3; ++i)
    factors[i] = reader_.linear(finish.ambient.v[i] * ambient_.v[i]) + reader_.linear(finish.emission.v[i]);
  const double factor = std::max({factors[0], factors[1], factors[2]});
  if (factor > 0) {
    const double share = body.solid ? static_cast<double>(*body.solid) : 1;
    if (pigment.color) {
      RGB glow;
      glow.r = reader_.linear(pigment.color->v[0]) * factors[0] * share;
      glow.g = reader_.linear(pigment.color->v[1]) * factors[1] * share;
      glow.b = reader_.linear(pigment.color->v[2]) * factors[2] * share;
      layer.glow = Spectrum{emission_from_rgb(glow)};
      layer.glow_scale = static_cast<float>(std::max({glow.r, glow.g, glow.b}));
    } else {
      layer.glow = color_texture(pigment, placed, Part::radiance, factor, look.by_uv);
      if (factors[0] != factors[1] || factors[1] != factors[2]) {
        const Spectrum tint =
            unbounded_from_rgb({factors[0] / factor, factors[1] / factor, factors[2] / factor});
        layer.glow = add(ProductTexture{layer.glow, tint}, false, finish.place);
      }
      layer.glow_scale = static_cast<float>(factor);
    }
    layer.glow = tinted(layer.glow, look, finish.place);
  }
  return layer;
}

Id<Material> Surfaces::material_of(const Body& body) {
  if (body.glazed) return glazed(body);
  if (!body.solid) return material_of(body.pigment, body.finish, body.to_world, body.look);
  const Id<Material> through = clear_material(body.pigment, body.finish, body.look.interior.get());
  if (!(*body.solid > 0.001f)) return through;
  const Id<Material> solid = material_of(body.pigment, body.finish, body.to_world, body.look);
  return add(BlendMaterial{through, solid, *body.solid}, body.place);
}

Id<Material> Surfaces::clear_material(const Pigment& pigment, const Finish& finish,
                                      const Interior* interior) {
  const Numbers color = pigment.color.value_or(Finish::grey(1));
  const Spectrum through = filtered(color);
  const float reflects = finish.has_reflection ? 1 : 0;
  if (interior && interior->ior > 1.0001) {
    DielectricMaterial glass;
    glass.eta = ConstantSpectrum{static_cast<float>(interior->ior)};
    glass.transmittance_factor = through;
    glass.reflectance_factor = Spectrum{ConstantSpectrum{reflects}};
    approximated(
        "a clear surface with ior: a dielectric, whose reflection is Fresnel's and whose shadow is dark or "
        "none",
        finish.place.line ? finish.place : pigment.place);
    return add(glass, pigment.place);
  }
  ThinDielectricMaterial sheet;
  sheet.eta = ConstantSpectrum{1};
  sheet.transmittance_factor = through;
  sheet.reflectance_factor = Spectrum{ConstantSpectrum{0}};
  return add(sheet, pigment.place);
}

Id<Material> Surfaces::material_of(const Pigment& pigment, const Finish& finish, const Transform& to_world,
                                   const Look& look) {
  std::vector<Lobe> lobes;
  const auto metal = [&](double metallic) -> Metal {
    if (!(metallic > 0)) return PerfectReflector{};
    return NormalReflectance{color_texture(pigment, to_world, Part::reflectance, 1, look.by_uv)};
  };
  const double reflection = greatest(finish.reflection_max);
  const bool fresnel = finish.fresnel && reflection > 0;
  const bool as_said = !reader_.for_export && !fresnel && finish.diffuse_back == 0;
  if (const Highlight h = highlight_of(finish); h.strength > 0 && !as_said) {
    const double alpha2 = 2 / (h.exponent + 2);
    Roughness roughness;
    roughness.alpha_u = roughness.alpha_v = static_cast<float>(std::sqrt(alpha2));
    roughness.distribution = Roughness::Distribution::beckmann;
    const double share = std::min(4 * alpha2 * reader_.linear(h.strength), 0.9);
    lobes.push_back({ConductorMaterial{metal(finish.metallic), roughness}, share});
    approximated("phong or specular: microfacets with a highlight as high", finish.place);
  }
  const Falloff falloff = falloff_of(finish);
  const bool grainy = finish.crand > 0 && as_said;
  const double diffuse = reader_.linear(grainy ? falloff.diffuse : darkened(finish));
  if (finish.brilliance != 1 && !as_said) approximated("brilliance: 1", finish.place);
  if (finish.crand > 0)
    approximated(grainy ? "crand: grain of our own places, and a greater brilliance for its dark"
                        : "crand: the mean of its dark, without grain",
                 finish.place);
  if (finish.irid > 0) dropped("irid", finish.place);
  if (finish.subsurface) dropped("subsurface", finish.place);
  if (reflection > 0 && !fresnel) {
    // Between what it is straight on and at grazing angles: nearer to the first, as most of a surface is seen
    // so.
    Numbers mean = finish.reflection_max;
    constexpr double grazing = 0.15;
    for (std::size_t i = 0; i < 3; ++i)
      mean.v[i] = reader_.linear(finish.reflection_min.v[i]) * (1 - grazing) +
                  reader_.linear(finish.reflection_max.v[i]) * grazing;
    const double share = std::min(greatest(mean), 0.98);
    if (greatest(finish.reflection_min) != reflection)
      approximated("reflection by angle: its mean", finish.place);
    ConductorMaterial mirror{metal(finish.reflection_metallic), {}};
    if (!(finish.reflection_metallic > 0) && share > 0)
      mirror.reflectance_factor =
          Spectrum{unbounded_from_rgb({mean.v[0] / share, mean.v[1] / share, mean.v[2] / share})};
    if (share > 0) lobes.push_back({mirror, share});
  }
  double shares = 0;
  for (const Lobe& lobe : lobes) shares += lobe.share;
  if (shares > 0.98) {
    for (Lobe& lobe : lobes) lobe.share *= 0.98 / shares;
    shares = 0.98;
  }
  const double left = 1 - shares;
  const bool highlights = finish.phong > 0 || finish.specular > 0;
  const bool as_finish = as_said && (highlights || finish.brilliance != 1 || grainy ||
                                     diffuse * std::max(brightest(pigment), 1.0) > left);
  SpectrumParameter reflectance = color_texture(
      pigment, to_world, as_finish ? Part::factor : Part::reflectance, diffuse / left, look.by_uv);
  reflectance = tinted(reflectance, look, pigment.place);
  if (grainy)
    reflectance = add(ProductTexture{reflectance, grain(falloff.grain, finish.place)}, false, finish.place);
  MaterialModel base;
  if (as_finish) {
    FinishMaterial m{reflectance, highlight_color(pigment, finish, to_world, look)};
    m.brilliance = static_cast<float>(grainy ? falloff.brilliance : std::max(finish.brilliance, 0.0));
    set_highlights(m, finish, left);
    base = m;
  } else if (fresnel) {
    PlasticMaterial coat;
    coat.diffuse_reflectance = reflectance;
    coat.eta = static_cast<float>(look.interior && look.interior->ior > 1.01 ? look.interior->ior : 1.5);
    coat.exterior_eta = 1;
    coat.specular_reflectance =
        Spectrum{ConstantSpectrum{static_cast<float>(std::min(reader_.linear(reflection), 1.0))}};
    approximated("reflection with fresnel: the coat of a dielectric", finish.place);
    base = coat;
  } else if (finish.diffuse_back > 0) {
    DiffuseTransmissionMaterial sheet;
    sheet.reflectance = reflectance;
    sheet.transmittance = color_texture(pigment, to_world, Part::reflectance,
                                        reader_.linear(finish.diffuse_back) / left, look.by_uv);
    base = sheet;
  } else {
    base = DiffuseMaterial{reflectance};
  }
  Id<Material> result = add(std::move(base), pigment.place);
  double held = left;  // the share of what `result` is by now
  for (Lobe& lobe : lobes) {
    const Id<Material> other = add(std::move(lobe.model), pigment.place);
    held += lobe.share;
    result = add(BlendMaterial{result, other, static_cast<float>(lobe.share / held)}, pigment.place);
  }
  return result;
}

}  // namespace vitrail::pov
