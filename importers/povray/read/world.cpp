// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/read/world.h"

#include <fmt/format.h>

#include "importers/povray/read/objects.h"
#include "importers/povray/read/patterns.h"
#include "importers/povray/read/reader.h"
#include "scene/records/film_settings.h"

namespace vitrail::pov {

namespace {

void read_global_settings(Reader& reader, World& world) {
  reader.expect('{', "behind global_settings");
  for (;;) {
    reader.comma();
    const Token token = reader.next();
    if (token.is('}')) return;
    if (token.kind != TokenKind::word) reader.unexpected(token, "a part of global_settings");
    switch (token.symbol->word) {
      case Word::assumed_gamma_:
        if (reader.accept(Word::srgb_)) {
          reader.assumed_gamma = srgb_gamma;
          break;
        }
        reader.assumed_gamma = reader.number("assumed_gamma");
        if (!(*reader.assumed_gamma > 0)) reader.fail("assumed_gamma has to be above 0", token.place);
        break;
      case Word::max_trace_level_:
        world.max_trace_level = std::max(1, reader.integer("max_trace_level"));
        break;
      case Word::noise_generator_:
        *reader.noise = read_noise_generator(reader);
        reader.has_noise = true;
        break;
      case Word::ambient_light_:
        world.ambient_light = reader.color();
        break;
      case Word::radiosity_:
        world.radiosity = true;
        skip_block(reader);
        break;
      case Word::photons_:
        world.photons = true;
        world.photons_place = token.place;
        skip_block(reader);
        break;
      case Word::subsurface_:
        skip_block(reader);
        break;
      case Word::charset_:
        reader.next();
        break;
      default:
        if (reader.at('{'))
          skip_block(reader);
        else if (reader.number_follows())
          reader.numbers();
    }
  }
}

void drop(Reader& reader, const Token& token) {
  reader.notes.dropped(token.symbol->name, reader.location(token.place));
  if (!reader.identifier<Dropped>()) skip_block(reader);
}

// False: the file ends.
bool read_statement(Reader& reader, World& world) {
  if (const auto named = reader.identifier<Shared<Object>>()) {
    world.objects.push_back({*named, reader.defaults.texture});
    return true;
  }
  const Token token = reader.peek();
  if (token.kind == TokenKind::end) return false;
  if (token.is(';') || token.is(',')) {
    reader.next();
    return true;
  }
  if (token.kind != TokenKind::word) reader.unexpected(token, "an object or a directive");
  const Word word = token.symbol->word;
  if (names_object(word)) {
    Shared<Object> object = read_object(reader);
    world.objects.push_back({std::move(object), reader.defaults.texture});
    return true;
  }
  if (word == Word::none && reader.number_follows()) {  // a macro has left a value
    reader.numbers();
    return true;
  }
  reader.next();
  switch (word) {
    case Word::camera_:
      world.camera = read_camera_block(reader);
      return true;
    case Word::global_settings_:
      read_global_settings(reader, world);
      return true;
    case Word::background_:
      reader.expect('{', "behind background");
      world.background = reader.color();
      world.background_place = token.place;
      reader.expect('}', "at the end of background");
      return true;
    case Word::sky_sphere_:
      world.sky = read_sky_sphere_block(reader);
      return true;
    case Word::fog_:
      world.fogs.push_back(read_fog_block(reader));
      return true;
    case Word::media_:
      world.media.push_back(read_media_block(reader));
      return true;
    case Word::rainbow_:
      drop(reader, token);
      return true;
    case Word::declare_:  // without their #, which povray warns of between statements
    case Word::default_:
    case Word::include_:
    case Word::version_: {
      Token directive = token;
      directive.kind = TokenKind::directive;
      reader.put_back(directive);
      return true;
    }
    case Word::max_trace_level_:  // of version 1
      world.max_trace_level = reader.integer("max_trace_level");
      return true;
    default:
      reader.unexpected(token, "an object or a directive");
  }
}

}  // namespace

World read_world(Reader& reader) {
  World world;
  while (read_statement(reader, world)) {
  }
  world.photons = world.photons && reader.has_photon_target && reader.photons_go_on;
  if (world.photons)
    reader.notes.approximated("photons: paths find what they light, or do not",
                              reader.location(world.photons_place));
  return world;
}

void Reader::set_defaults() {
  expect('{', "behind #default");
  auto texture =
      defaults.texture ? std::make_shared<Texture>(*defaults.texture) : std::make_shared<Texture>();
  while (!accept('}')) {
    const Token token = next();
    if (token.is(Word::texture_)) {
      *texture = *read_texture_block(*this);
    } else if (token.is(Word::pigment_)) {
      texture->pigment = read_pigment_block(*this);
    } else if (token.is(Word::normal_)) {
      texture->normal = read_normal_block(*this);
    } else if (token.is(Word::finish_)) {
      texture->finish = read_finish_block(*this, texture->finish);
    } else if (token.is(Word::radiosity_) || token.is(Word::camera_)) {
      skip_block(*this);
    } else {
      unexpected(token, "texture, pigment, normal or finish");
    }
  }
  defaults.texture = texture;
}

}  // namespace vitrail::pov
