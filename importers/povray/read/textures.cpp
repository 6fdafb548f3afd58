// SPDX-License-Identifier: Apache-2.0
// texture {}, material {}, finish {}, interior {}.
#include <algorithm>

#include "importers/povray/read/formula.h"
#include "importers/povray/read/levels.h"
#include "importers/povray/read/patterns.h"
#include "importers/povray/read/reader.h"

namespace vitrail::pov {

namespace {

void read_reflection(Reader& reader, Finish& finish) {
  finish.has_reflection = true;
  if (!reader.accept('{')) {
    finish.reflection_min = finish.reflection_max = reader.color();
    return;
  }
  finish.reflection_min = finish.reflection_max = reader.color();
  if (reader.accept(',') || reader.number_follows()) {
    finish.reflection_max = reader.color();
  } else {
    finish.reflection_min = finish.reflection_max;
  }
  while (!reader.accept('}')) {
    const Token token = reader.next();
    if (token.is(Word::fresnel_))
      finish.fresnel = reader.flag();
    else if (token.is(Word::falloff_))
      finish.reflection_falloff = reader.number("falloff");
    else if (token.is(Word::exponent_))
      finish.reflection_exponent = reader.number("exponent");
    else if (token.is(Word::metallic_))
      finish.reflection_metallic = reader.number_follows() ? reader.number("metallic") : 1;
    else if (!token.is(','))
      reader.unexpected(token, "a part of reflection");
  }
}

// Whether a part of finish was read.
bool read_finish_part(Reader& reader, Finish& finish, const Token& token) {
  const auto albedo = [&] { reader.accept(Word::albedo_); };
  switch (token.symbol->word) {
    case Word::ambient_:
      finish.ambient = reader.color();
      return true;
    case Word::emission_:
      finish.emission = reader.color();
      return true;
    case Word::diffuse_:
      albedo();
      finish.diffuse = reader.number("diffuse");
      if (reader.accept(',')) finish.diffuse_back = reader.number("diffuse behind");
      return true;
    case Word::brilliance_:
      finish.brilliance = reader.number("brilliance");
      return true;
    case Word::phong_:
      albedo();
      finish.phong = reader.number("phong");
      return true;
    case Word::phong_size_:
      finish.phong_size = reader.number("phong_size");
      return true;
    case Word::specular_:
      albedo();
      finish.specular = reader.number("specular");
      return true;
    case Word::roughness_:
      finish.roughness = reader.number("roughness");
      return true;
    case Word::metallic_:
      finish.metallic = reader.number_follows() ? reader.number("metallic") : 1;
      return true;
    case Word::reflection_:
      read_reflection(reader, finish);
      return true;
    case Word::reflection_exponent_:
      finish.reflection_exponent = reader.number("reflection_exponent");
      return true;
    case Word::conserve_energy_:
      finish.conserve_energy = reader.flag();
      return true;
    case Word::crand_:
      finish.crand = reader.number("crand");
      return true;
    case Word::irid_:
      reader.expect('{', "behind irid");
      finish.irid = reader.number("irid");
      while (!reader.accept('}')) {
        reader.next();
        reader.numbers();
      }
      return true;
    case Word::subsurface_:
      skip_block(reader);
      finish.subsurface = true;
      return true;
    case Word::fresnel_:
    case Word::use_alpha_:
      reader.flag();
      return true;
    case Word::ior_:
    case Word::caustics_:
    case Word::fade_distance_:
    case Word::fade_power_:
    case Word::refraction_:  // old: interiors have them
      reader.numbers();
      return true;
    default:
      return false;
  }
}

}  // namespace

Shared<Finish> read_finish_block(Reader& reader, const Shared<Finish>& from) {
  if (const auto named = reader.identifier<Shared<Finish>>()) return *named;
  reader.expect('{', "behind finish");
  Finish finish = from ? *from : Finish{};
  finish.place = reader.here();
  for (;;) {
    reader.comma();
    if (const auto named = reader.identifier<Shared<Finish>>()) {
      finish = **named;
      continue;
    }
    const Token token = reader.next();
    if (token.is('}')) break;
    if (token.kind != TokenKind::word || !read_finish_part(reader, finish, token))
      reader.unexpected(token, "a part of finish");
  }
  return std::make_shared<Finish>(finish);
}

Shared<Texture> moved(const Shared<Texture>& texture, const Transform& by) {
  if (texture->by_uv) return texture;
  auto result = std::make_shared<Texture>(*texture);
  result->to_object = by * result->to_object;
  return result;
}

void change_normal(Reader& reader, Texture& top, const Transform& placed) {
  const Shared<Bump> read = read_normal_block(reader);
  if (top.normal || placed == Transform{} || !is_invertible(placed)) {
    top.normal = read;
    return;
  }
  auto unmoved = std::make_shared<Bump>(*read);
  unmoved->to_object = inverse(placed) * read->to_object;
  top.normal = unmoved;
}

Shared<Texture> read_texture_block(Reader& reader) {
  if (const auto named = reader.identifier<Shared<Texture>>(); named) return *named;
  const char close = reader.accept('[') ? ']' : '}';
  if (close == '}') reader.expect('{', "behind texture");
  const Reader::Deeper deeper(reader, reader.here());
  Texture texture = reader.defaults.texture ? *reader.defaults.texture : Texture{};
  texture.place = reader.here();
  Pattern pattern;
  Shared<BlendMap> map;
  bool uv = false;
  for (;;) {
    reader.comma();
    const Token token = reader.peek();
    if (token.is(close)) break;
    if (const auto named = reader.identifier<Shared<Texture>>()) {
      texture = **named;
      continue;
    }
    if (token.kind == TokenKind::word) {
      const Word word = token.symbol->word;
      if (word == Word::pigment_) {
        reader.next();
        change_top(texture, [&](Texture& top, const Transform&) {
          top.pigment = read_pigment_block(reader, reader.defaults.texture ? top.pigment : nullptr);
        });
        continue;
      }
      if (word == Word::normal_) {
        reader.next();
        change_top(texture,
                   [&](Texture& top, const Transform& placed) { change_normal(reader, top, placed); });
        continue;
      }
      if (word == Word::finish_) {
        reader.next();
        change_top(texture, [&](Texture& top, const Transform&) {
          top.finish = read_finish_block(reader, top.finish);
        });
        continue;
      }
      if (word == Word::tiles_) {
        reader.next();
        reader.expect('{', "behind tiles");
        BlendMap tiles;
        tiles.kind = Word::texture_map_;
        while (!reader.accept('}')) {
          const Token part = reader.next();
          if (part.is(Word::texture_)) {
            BlendEntry entry;
            entry.texture = read_texture_block(reader);
            entry.at = static_cast<double>(tiles.entries.size());
            tiles.entries.push_back(std::move(entry));
          } else if (!part.is(Word::tile2_)) {
            reader.unexpected(part, "a part of tiles");
          }
        }
        pattern.kind = Word::checker_;
        settle(reader, tiles);
        map = std::make_shared<BlendMap>(std::move(tiles));
        continue;
      }
      if (word == Word::material_map_) {
        reader.next();
        skip_block(reader);
        reader.notes.dropped("material_map: the texture before it", reader.location(token.place));
        continue;
      }
      if (word == Word::uv_mapping_) {
        reader.next();
        uv = reader.has_uv_mapping = true;
        continue;
      }
      if (names_pattern(word)) {
        reader.next();
        read_pattern(reader, word, pattern, map);
        continue;
      }
    }
    if (const auto named = reader.identifier<Shared<Pigment>>()) {
      change_top(texture, [&](Texture& top, const Transform&) { top.pigment = *named; });
      continue;
    }
    if (const auto named = reader.identifier<Shared<Finish>>()) {
      change_top(texture, [&](Texture& top, const Transform&) { top.finish = *named; });
      continue;
    }
    // A transformation moves all that is there by then.
    Transform step;
    if (read_transform(reader, step)) {
      if (!texture.by_uv) texture.to_object = step * texture.to_object;
      continue;
    }
    Transform none;
    if (read_pattern_modifier(reader, pattern, map, none)) continue;
    reader.unexpected(reader.next(), "a part of texture");
  }
  reader.next();
  const bool is_default_alone = !map && places_of_list(pattern.kind) > 0;
  if (pattern.kind != Word::none && !is_default_alone) {
    texture.pattern = pattern;
    texture.map = map;
  }
  texture.by_uv = texture.by_uv || uv;
  settle(reader, texture);
  return std::make_shared<Texture>(std::move(texture));
}

Shared<Interior> read_interior_block(Reader& reader) {
  if (const auto named = reader.identifier<Shared<Interior>>()) return *named;
  reader.expect('{', "behind interior");
  Interior interior;
  interior.place = reader.here();
  for (;;) {
    reader.comma();
    if (const auto named = reader.identifier<Shared<Interior>>()) {
      interior = **named;
      continue;
    }
    const Token token = reader.next();
    if (token.is('}')) break;
    if (token.is(Word::ior_))
      interior.ior = reader.number("ior");
    else if (token.is(Word::fade_distance_))
      interior.fade_distance = reader.number("fade_distance");
    else if (token.is(Word::fade_power_))
      interior.fade_power = reader.number("fade_power");
    else if (token.is(Word::fade_color_) || token.is(Word::fade_colour_))
      interior.fade_color = reader.color();
    else if (token.is(Word::dispersion_))
      interior.dispersion = reader.number("dispersion");
    else if (token.is(Word::dispersion_samples_))
      reader.numbers();
    else if (token.is(Word::caustics_))
      interior.caustics = reader.number("caustics");
    else if (token.is(Word::media_)) {
      interior.media.push_back(read_media_block(reader));
    } else {
      reader.unexpected(token, "a part of interior");
    }
  }
  return std::make_shared<Interior>(std::move(interior));
}

Shared<MaterialParts> read_material_block(Reader& reader) {
  if (const auto named = reader.identifier<Shared<MaterialParts>>()) return *named;
  reader.expect('{', "behind material");
  MaterialParts material;
  for (;;) {
    reader.comma();
    if (const auto named = reader.identifier<Shared<MaterialParts>>()) {
      material = **named;
      continue;
    }
    if (reader.accept('}')) break;
    if (reader.accept(Word::texture_)) {
      material.texture = read_texture_block(reader);
    } else if (reader.accept(Word::interior_texture_)) {
      material.interior_texture = read_texture_block(reader);
    } else if (reader.accept(Word::interior_)) {
      material.interior = read_interior_block(reader);
    } else {
      Transform step;
      if (!read_transform(reader, step)) reader.unexpected(reader.next(), "a part of material");
      if (material.texture) material.texture = moved(material.texture, step);
      if (material.interior_texture) material.interior_texture = moved(material.interior_texture, step);
      if (material.interior) material.interior = moved(material.interior, step);
    }
  }
  return std::make_shared<MaterialParts>(std::move(material));
}

}  // namespace vitrail::pov
