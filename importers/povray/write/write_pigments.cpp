// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/write/write_pigments.h"

#include <array>
#include <cmath>

#include "images/ptex_means.h"
#include "importers/povray/write/write_patterns.h"
#include "importers/writing/export_colors.h"
#include "scene/records/texture_inputs.h"
#include "scene/shapes/deferred_mesh.h"

namespace vitrail::povray {

namespace {

// A pigment holds all pigments that it is made of, and those that it shares as often as it asks for them.
constexpr std::uint64_t most_pigments = 1024;

// How a pigment is used: as a colour, or as a filter of what lies below it.
struct Use {
  Colors colors = Colors::factors;
  bool as_filter = false;
  Origin user;
};

const char* filter_of(const Use& use) { return use.as_filter ? " filter 1" : ""; }

Pigment constant(RGB c, const Use& use) {
  return {fmt::format("{}{}", color(c), filter_of(use)), 1, {}, true, c};
}

Pigment grey(double value, const Use& use) { return constant({value, value, value}, use); }

Pigment build(Context& context, const SpectrumParameter& parameter, const Use& use);

// ---- Mappings -----------------------------------------------------------------------------------

struct Placement {
  bool by_uv = false;
  std::string map_type;   // of an image_map
  std::string transform;  // of the pattern
};

Transform affine(const UvMapping& m) {
  Transform t;
  t.m[0] = {m.a, m.b, 0, m.c};
  t.m[1] = {m.d, m.e, 0, m.f};
  return t;
}

// Patterns are looked up at the inverse of their transform.
std::string undoing(const Transform& pov_to_texture) {
  return pov_to_texture == Transform{} ? "" : fmt::format(" {}", matrix(inverse(pov_to_texture)));
}

// p = to_texture(inverse(to_pov)(q)) of the point q of POV-Ray's space.
Transform from_pov(const Context& context, const Transform& texture_to_world) {
  return texture_to_world * inverse(context.units.to_pov);
}

Placement place(Context& context, const TextureMapping& mapping, const Origin& origin) {
  if (const auto* uv = std::get_if<UvMapping>(&mapping)) {
    const Transform t = affine(*uv);
    if (is_invertible(t)) return {true, "", undoing(t)};
    context.approximated("texture mapping that is constant along a direction: written as the uv themselves",
                         origin);
    return {true, "", ""};
  }
  Transform t, to_image;
  std::string map_type = "map_type 0 ";
  if (const auto* m = std::get_if<SphericalMapping>(&mapping)) {
    t = inverse(m->texture_to_world);
    // POV-Ray: s = 0 at +x, s = 1/4 at +z, t = 0 at −y. image_of exchanges s and t.
    to_image.m = {{{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}}};
    map_type = "map_type 1 ";
  } else if (const auto* g = std::get_if<GlobeMapping>(&mapping)) {
    t = inverse(g->texture_to_world);
    to_image.m = {{{1, 0, 0, 0}, {0, 0, 1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}}};
    map_type = "map_type 1 ";
  } else if (const auto* c = std::get_if<CylindricalMapping>(&mapping)) {
    t = inverse(c->texture_to_world);
    if (c->of_direction)
      context.approximated("image around a cylinder by direction, as in pbrt-v3: by height", origin);
    // POV-Ray: t = y, and s as on its spheres. Ours: s = 0 at −x.
    to_image.m = {{{-1, 0, 0, 0}, {0, 0, 1, 0}, {0, -1, 0, 0}, {0, 0, 0, 1}}};
    map_type = "map_type 2 ";
  } else {
    const auto& p = std::get<PlanarMapping>(mapping);
    t = inverse(p.texture_to_world);
    const Vector3d across = cross(p.v1, p.v2);
    to_image.m = {{{p.v1.x, p.v1.y, p.v1.z, p.offset_s},
                   {p.v2.x, p.v2.y, p.v2.z, p.offset_t},
                   {across.x, across.y, across.z, 0},
                   {0, 0, 0, 1}}};
  }
  const Transform whole = to_image * from_pov(context, t);
  if (!is_invertible(whole)) {
    context.approximated("texture mapping without an inverse: written without it", origin);
    return {false, map_type, ""};
  }
  return {false, map_type, undoing(whole)};
}

const char* uv_of(const Placement& placement) { return placement.by_uv ? "uv_mapping " : ""; }

// ---- Kinds of texture ---------------------------------------------------------------------------

// A colour inside a map of pigments, where neither filters nor factors above 1 can be.
std::string entry(Context& context, const SpectrumParameter& parameter, const Use& use) {
  const Pigment p = build(context, parameter, use);
  if (!p.filters.empty())
    context.approximated("product of textures inside a texture: its first factor", use.user);
  if (p.factor == 1) return p.text;
  if (p.factor > 1) {
    context.approximated(fmt::format("scale {} of a texture inside a texture: 1", p.factor), use.user);
    return p.text;
  }
  return fmt::format("average pigment_map {{ [{} {}] [{} rgb 0{}] }}", p.factor, p.text, 1 - p.factor,
                     filter_of(use));
}

// A coordinate of an image of so many texels along it, and what its values are multiplied by: POV-Ray's
// images repeat, and so do the texels that it interpolates between at their edges.
struct Wrapped {
  std::string coordinate, weight;
};

Wrapped wrapped(const char* x, int texels, const ImageTexture& texture) {
  const double edge = 0.5 / texels;
  const auto held = [&](const std::string& inside) {
    return fmt::format("min({}, max({}, {}))", 1 - edge, edge, inside);
  };
  if (texture.wrap == Wrap::mirror) return {held(fmt::format("1 - abs({0} - 2*floor({0}/2) - 1)", x)), "1"};
  if (texture.wrap == Wrap::clamp) return {held(x), "1"};
  if (texture.filter == TextureFilter::nearest)
    return {held(x), fmt::format("select({0}, 0, 1)*select(1 - {0}, 0, 1)", x)};
  return {held(x), fmt::format("min(1, max(0, {0}*{1} + .5))*min(1, max(0, (1 - {0})*{1} + .5))", x, texels)};
}

// An image that does not repeat: a function of each channel, at half its value and below 1.
std::string unrepeated(Context& context, const ImageTexture& texture, const std::string& map,
                       const Use& use) {
  const ImageLayout layout = read_image_layout(texture.filename);
  const Wrapped s = wrapped("x", layout.width, texture), t = wrapped("y", layout.height, texture);
  const double most = use.colors == Colors::emissions ? 65536 : 2;
  const std::string name = fmt::format("Image_{}", context.image_functions++);
  context.functions += fmt::format("#declare {} = function {{ pigment {{ {} }} }}\n", name, map);
  const auto channel = [&](const char* which, RGB color_of_it) {
    return fmt::format(" [1 function {{ {}({}, {}, 0).{}*{}*{}/{} }} color_map {{ [0 rgb 0{}] [1 {}{}] }}]",
                       name, s.coordinate, t.coordinate, which, s.weight, t.weight, most, filter_of(use),
                       color(color_of_it * (3 * most)), filter_of(use));
  };
  return fmt::format("average pigment_map {{{}{}{} }}", channel("red", {1, 0, 0}),
                     channel("green", {0, 1, 0}), channel("blue", {0, 0, 1}));
}

Pigment image(Context& context, const ImageTexture& texture, bool is_float, const Origin& origin,
              const Use& use) {
  const auto file = image_of(context, texture, is_float ? ImageUse::number : ImageUse::color, origin);
  if (!file) return grey(0.5, use);
  const Placement placement = place(context, texture.mapping, origin);
  Pigment p;
  const char* const interpolated = texture.filter == TextureFilter::nearest ? "" : "interpolate 2 ";
  const bool is_flat = placement.map_type.empty() || placement.map_type == "map_type 0 ";
  const std::string map =
      texture.wrap != Wrap::repeat && is_flat
          ? unrepeated(context, texture, fmt::format("image_map {{ {} {}}}", *file, interpolated), use)
          : fmt::format("image_map {{ {} {}{}{}}}", *file, placement.map_type, interpolated,
                        use.as_filter ? "filter all 1 " : "");
  p.text = uv_of(placement) + map + placement.transform;
  p.factor = texture.scale;
  if (!texture.invert) return p;
  if (texture.scale != 1) context.approximated("inverted image with a scale: the scale is left out", origin);
  p.text = fmt::format("average pigment_map {{ [2 rgb 0.5{}] [-1 {}] }}", filter_of(use), p.text);
  p.factor = 1;
  return p;
}

Pigment checkerboard(Context& context, const CheckerboardTexture& texture, const Origin& origin,
                     const Use& use) {
  Placement placement;
  if (texture.solid) {
    const Transform t = from_pov(context, inverse(texture.texture_to_world));
    if (is_invertible(t)) placement.transform = undoing(t);
  } else {
    placement = place(context, texture.mapping, origin);
    if (placement.map_type.ends_with("1 ") || placement.map_type.ends_with("2 "))
      context.approximated("checkerboard on a sphere or cylinder: written in space", origin);
  }
  Pigment p;
  p.text =
      fmt::format("{}checker pigment {{ {} }} pigment {{ {} }}{}", uv_of(placement),
                  entry(context, texture.even, use), entry(context, texture.odd, use), placement.transform);
  return p;
}

Pigment pattern(Context& context, const PatternTexture& texture, const Origin& origin, const Use& use) {
  if (texture.kind == PatternTexture::Kind::formula) {
    context.approximated("formula of a pattern: its mean", origin);
    const RGB mean = mean_of_pattern(texture);
    return constant(mean, use);
  }
  std::vector<std::string> values;
  for (const PatternStop& stop : texture.map) values.push_back(entry(context, stop.value, use));
  const Transform inverted = inverse(texture.texture_to_world);
  const Transform t = texture.by_uv ? inverted : from_pov(context, inverted);
  Pigment p;
  p.text = (texture.by_uv ? "uv_mapping " : "") + pattern_text(texture, values) +
           (is_invertible(t) ? undoing(t) : "");
  return p;
}

Pigment mix(Context& context, const MixTexture& texture, const Use& use) {
  const std::string first = entry(context, texture.first, use), second = entry(context, texture.second, use);
  Pigment p;
  if (const auto* id = std::get_if<Id<Texture>>(&texture.amount)) {
    if (const auto pattern = pattern_of(context, *id, use.user)) {
      p.text = fmt::format("{} pigment_map {{ [0 {}] [1 {}] }}{}", pattern->text, first, second,
                           pattern->transform);
      return p;
    }
  }
  const double amount = constant_of(context, texture.amount, "amount of a mix", use.user);
  if (amount <= 0) return build(context, texture.first, use);
  if (amount >= 1) return build(context, texture.second, use);
  p.text = fmt::format("average pigment_map {{ [{} {}] [{} {}] }}", 1 - amount, first, amount, second);
  return p;
}

Pigment product(Context& context, const ProductTexture& texture, const Use& use) {
  Pigment first = build(context, texture.first, use);
  Use above = use;
  above.as_filter = true;
  const Pigment second = build(context, texture.second, above);
  if (first.is_constant && second.is_constant) return constant(first.constant * second.constant, use);
  first.is_constant = false;
  first.factor *= second.factor;
  first.filters.push_back(second.text);
  first.filters.insert(first.filters.end(), second.filters.begin(), second.filters.end());
  return first;
}

Pigment bilinear(Context& context, const BilinearTexture& texture, const Origin& origin, const Use& use) {
  const Placement placement = place(context, texture.mapping, origin);
  const auto column = [&](const SpectrumParameter& low, const SpectrumParameter& high) {
    return fmt::format("gradient y pigment_map {{ [0 {}] [1 {}] }}", entry(context, low, use),
                       entry(context, high, use));
  };
  context.approximated("bilinear texture: it repeats outside of (0,0) … (1,1)", origin);
  Pigment p;
  p.text =
      fmt::format("{}gradient x pigment_map {{ [0 {}] [1 {}] }}{}", uv_of(placement),
                  column(texture.v00, texture.v01), column(texture.v10, texture.v11), placement.transform);
  return p;
}

double farthest_from(const Scene& scene, const MeshAttributeTexture& texture, RGB mean) {
  double farthest = 0;
  for (const TriangleMesh& stored : scene.meshes) {
    TriangleMesh storage;
    for (const MeshAttribute& a : loaded(stored, storage).attributes) {
      if (a.name != texture.name) continue;
      const std::array<double, 3> means =
          a.channels == 3 ? std::array{mean.r, mean.g, mean.b} : std::array{mean.r, mean.r, mean.r};
      for (std::size_t i = 0; i < a.values.size(); ++i)
        farthest =
            std::max(farthest, std::abs(static_cast<double>(a.values[i] * texture.scale) - means[i % 3]));
    }
  }
  return farthest;
}

// What no mesh has is rendered as the number 0, and as the reflectance whose coefficients are 0.
Pigment attribute(Context& context, const MeshAttributeTexture& texture, bool is_float, const Origin& origin,
                  const Use& use) {
  const double absent = is_float ? 0 : 0.5;
  const auto mean = mean_of_attribute(context.scene, texture);
  if (!mean)
    context.approximated(fmt::format("mesh attribute {}, which no mesh has: {}", texture.name, absent),
                         origin);
  else
    context.approximated(
        fmt::format("mesh attribute {}: its mean, ({:.2g}, {:.2g}, {:.2g}), from which its values go up to "
                    "{:.2g} away",
                    texture.name, mean->r, mean->g, mean->b, farthest_from(context.scene, texture, *mean)),
        origin);
  return mean ? constant(*mean, use) : grey(absent, use);
}

Pigment build(Context& context, Id<Texture> id, const Use& use) {
  const Texture& texture = context.scene.textures.at(id.value);
  const Origin& origin = texture.origin;
  if (context.nesting.at(id.value).lookups > most_pigments) {
    context.approximated(
        fmt::format("texture that leads to more than {} others, each written on every way: 0.5",
                    most_pigments),
        origin);
    return grey(0.5, use);
  }
  if (const auto* t = std::get_if<ImageTexture>(&texture.model))
    return image(context, *t, texture.is_float, origin, use);
  if (const auto* t = std::get_if<CheckerboardTexture>(&texture.model))
    return checkerboard(context, *t, origin, use);
  if (const auto* t = std::get_if<PatternTexture>(&texture.model)) return pattern(context, *t, origin, use);
  if (const auto* t = std::get_if<ProductTexture>(&texture.model)) return product(context, *t, use);
  if (const auto* t = std::get_if<MixTexture>(&texture.model)) return mix(context, *t, use);
  if (const auto* t = std::get_if<BilinearTexture>(&texture.model)) return bilinear(context, *t, origin, use);
  if (const auto* t = std::get_if<MeshAttributeTexture>(&texture.model))
    return attribute(context, *t, texture.is_float, origin, use);
  if (const auto* t = std::get_if<DotsTexture>(&texture.model)) {
    context.approximated("texture of dots: what is outside of them", origin);
    return build(context, t->outside, use);
  }
  if (const auto* t = std::get_if<DirectionMixTexture>(&texture.model)) {
    context.approximated("mix by direction: the mean of its colours", origin);
    return mix(context, MixTexture{t->first, t->second, 0.5f}, use);
  }
  if (std::holds_alternative<UvTexture>(texture.model)) {
    context.approximated("texture of the uv themselves: their mean colour", origin);
    return constant({0.5, 0.5, 0}, use);
  }
  if (const auto* t = std::get_if<NoiseTexture>(&texture.model)) {
    context.approximated("texture of noise: its mean", origin);
    return constant(mean_of_noise(*t), use);
  }
  const PtexMean mean = mean_of_ptex(std::get<PtexTexture>(texture.model));
  context.approximated(fmt::format("texture of Ptex: {}", mean.how), origin);
  return constant(mean.color, use);
}

Pigment build(Context& context, const SpectrumParameter& parameter, const Use& use) {
  if (const auto* id = std::get_if<Id<Texture>>(&parameter)) return build(context, *id, use);
  const Spectrum& spectrum = std::get<Spectrum>(parameter);
  if (!is_rgb(spectrum)) context.approximated("spectrum: written as its colour in linear sRGB", use.user);
  return constant(use.colors == Colors::emissions ? signed_emission_rgb(spectrum) : factor_rgb(spectrum),
                  use);
}

bool is_uv(const TextureMapping& mapping) { return std::holds_alternative<UvMapping>(mapping); }

// What of a texture is shown by uv is itself or an input, of those that this writer shows.
bool shows_uvs(const TextureModel& model) {
  if (const auto* t = std::get_if<ImageTexture>(&model)) return is_uv(t->mapping);
  if (const auto* t = std::get_if<CheckerboardTexture>(&model)) return !t->solid && is_uv(t->mapping);
  if (const auto* t = std::get_if<PatternTexture>(&model)) return t->by_uv;
  const auto* t = std::get_if<BilinearTexture>(&model);
  return t && is_uv(t->mapping);
}

template <class F>
void for_shown_inputs(const TextureModel& model, F&& f) {
  if (std::holds_alternative<BilinearTexture>(model)) return;
  const auto* dots = std::get_if<DotsTexture>(&model);
  if (!dots) return for_texture_inputs(model, f);
  if (const auto* id = std::get_if<Id<Texture>>(&dots->outside)) f(*id);
}

}  // namespace

Pigment pigment_of(Context& context, const SpectrumParameter& parameter, const Origin& user, Colors colors) {
  return build(context, parameter, Use{colors, false, user});
}

std::optional<Pattern> pattern_of(Context& context, Id<Texture> id, const Origin& user) {
  const Texture& texture = context.scene.textures.at(id.value);
  const auto* t = std::get_if<ImageTexture>(&texture.model);
  if (!t || t->scale != 1 || t->invert || t->wrap != Wrap::repeat) {
    const Pigment p = build(context, id, Use{Colors::factors, false, user});
    if (p.is_constant || !p.filters.empty()) return {};
    const std::string text = p.factor == 1 ? p.text
                                           : fmt::format("average pigment_map {{ [{} {}] [{} rgb 0] }}",
                                                         p.factor, p.text, 1 - p.factor);
    return Pattern{fmt::format("pigment_pattern {{ {} }}", text), ""};
  }
  const auto file = image_of(context, *t, ImageUse::number, texture.origin);
  if (!file) return {};
  const Placement placement = place(context, t->mapping, texture.origin);
  return Pattern{
      fmt::format("{}image_pattern {{ {} {}interpolate 2 }}", uv_of(placement), *file, placement.map_type),
      placement.transform};
}

bool uses_uvs(const Scene& scene, Id<Texture> texture) {
  return leads_to(scene.textures, texture, shows_uvs,
                  [](const TextureModel& model, auto&& f) { for_shown_inputs(model, f); });
}

}  // namespace vitrail::povray
