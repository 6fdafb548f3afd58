// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/read/patterns.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "importers/povray/read/formula.h"
#include "importers/povray/read/function.h"
#include "importers/povray/read/levels.h"
#include "importers/povray/read/objects.h"
#include "importers/povray/read/pattern_kinds.h"
#include "importers/povray/read/pattern_parts.h"
#include "importers/povray/read/pattern_warps.h"
#include "importers/povray/read/reader.h"
#include "scene/models/pattern_noise.h"

namespace vitrail::pov {

bool names_pattern(Word word) {
  switch (word) {
    case Word::agate_:
    case Word::average_:
    case Word::boxed_:
    case Word::bozo_:
    case Word::brick_:
    case Word::bumps_:
    case Word::cells_:
    case Word::checker_:
    case Word::crackle_:
    case Word::cubic_:
    case Word::cylindrical_:
    case Word::density_file_:
    case Word::dents_:
    case Word::facets_:
    case Word::function_:
    case Word::gradient_:
    case Word::granite_:
    case Word::hexagon_:
    case Word::image_pattern_:
    case Word::julia_:
    case Word::leopard_:
    case Word::magnet_:
    case Word::mandel_:
    case Word::marble_:
    case Word::object_:
    case Word::onion_:
    case Word::pavement_:
    case Word::pigment_pattern_:
    case Word::planar_:
    case Word::quilted_:
    case Word::radial_:
    case Word::ripples_:
    case Word::slope_:
    case Word::spherical_:
    case Word::spiral1_:
    case Word::spiral2_:
    case Word::spotted_:
    case Word::square_:
    case Word::tiling_:
    case Word::triangular_:
    case Word::waves_:
    case Word::wood_:
    case Word::wrinkles_:
      return true;
    default:
      return false;
  }
}

Word map_kind(Word word) {
  switch (word) {
    case Word::color_map_:
    case Word::colour_map_:
      return Word::color_map_;
    case Word::pigment_map_:
    case Word::texture_map_:
    case Word::normal_map_:
    case Word::slope_map_:
    case Word::density_map_:
      return word;
    default:
      return Word::none;
  }
}

namespace {

// What stands where a list ends before its pattern has all it shows, as povray 3.7 shows it: colours of the
// pattern's own, else what #default says.
BlendEntry missing_entry(const Reader& reader, Word pattern, Word kind, std::size_t index) {
  BlendEntry entry;
  const Shared<Texture>& texture = reader.defaults.texture;
  if (kind == Word::color_map_)
    entry = list_entries(pattern).at(index);
  else if (kind == Word::texture_map_)
    entry.texture = texture ? texture : std::make_shared<Texture>();
  else if (kind == Word::normal_map_)
    entry.bump = texture && texture->normal ? texture->normal : std::make_shared<Bump>();
  else if (texture && texture->pigment)
    entry.pigment = texture->pigment;
  else
    entry.color = Finish::grey(0);
  return entry;
}

// The colours, pigments, normals or textures behind checker, brick, hexagon …; none: those of the pattern.
void read_list(Reader& reader, Word pattern, Shared<BlendMap>& map) {
  BlendMap list;
  for (;;) {
    reader.comma();
    BlendEntry entry;
    const Token token = reader.peek();
    if (token.is(Word::pigment_)) {
      reader.next();
      entry.pigment = read_pigment_block(reader);
      list.kind = Word::pigment_map_;
    } else if (token.is(Word::texture_)) {
      reader.next();
      entry.texture = read_texture_block(reader);
      list.kind = Word::texture_map_;
    } else if (token.is(Word::normal_)) {
      reader.next();
      entry.bump = read_normal_block(reader);
      list.kind = Word::normal_map_;
    } else if (reader.number_follows()) {
      entry.color = reader.color();
    } else {
      break;
    }
    entry.at = static_cast<double>(list.entries.size());
    list.entries.push_back(std::move(entry));
  }
  map.reset();
  if (list.entries.empty()) return;
  for (std::size_t i = list.entries.size(); i < places_of_list(pattern); ++i) {
    list.entries.push_back(missing_entry(reader, pattern, list.kind, i));
    list.entries.back().at = static_cast<double>(i);
  }
  settle(reader, list);
  map = std::make_shared<BlendMap>(std::move(list));
}

// An object, and how it is moved; what else follows it is of the list.
Shared<Object> read_solid(Reader& reader) {
  auto solid = std::make_shared<Object>();
  solid->place = reader.peek().place;
  solid->children.push_back(read_object(reader));
  while (read_transform(reader, solid->to_parent)) {
  }
  settle(reader, *solid);
  return solid;
}

// "number_of_sides 3 number_of_tiles 4 pattern 1 exterior 0 interior 0 form 0", in any order.
void read_pavement(Reader& reader) {
  constexpr std::array parts{Word::number_of_sides_, Word::number_of_tiles_, Word::pattern_,
                             Word::exterior_,        Word::interior_,        Word::form_};
  while (std::ranges::any_of(parts, [&](Word part) { return reader.accept(part); }))
    reader.integer("a part of pavement");
}

void read_numbers_of(Reader& reader, Word word, Pattern& pattern) {
  if (word == Word::gradient_) pattern.direction = reader.vector("the direction of a gradient");
  if (word == Word::spiral1_ || word == Word::spiral2_) pattern.arms = reader.integer("the number of arms");
  if (word == Word::mandel_ || word == Word::magnet_ || word == Word::julia_)
    read_fractal(reader, word, pattern);
  if (word == Word::tiling_ && reader.number_follows()) reader.numbers();
  if (word == Word::pavement_) read_pavement(reader);
  if (word == Word::facets_ && reader.accept(Word::coords_)) reader.numbers();
  if (word == Word::facets_ && reader.accept(Word::size_)) reader.numbers();
}

}  // namespace

NoiseGenerator read_noise_generator(Reader& reader) {
  const Place place = reader.here();
  const int number = reader.integer("the number of a noise generator");
  if (number > 2) reader.notes.approximated("noise_generator 3: noise of the second", reader.location(place));
  return noise_generator(number);
}

void read_pattern(Reader& reader, Word word, Pattern& pattern, Shared<BlendMap>& map) {
  pattern.kind = word;
  if (!pattern.noise) pattern.noise = reader.noise;
  switch (word) {
    case Word::checker_:
    case Word::brick_:
    case Word::hexagon_:
    case Word::cubic_:
    case Word::square_:
    case Word::triangular_:
      read_list(reader, word, map);
      break;
    case Word::function_:
      pattern.function = read_function(reader);
      break;
    case Word::image_pattern_:
      pattern.image = read_image_map(reader);
      break;
    case Word::object_:
      reader.expect('{', "behind object");
      pattern.object = read_solid(reader);
      read_list(reader, word, map);
      reader.expect('}', "at the end of an object");
      break;
    case Word::pigment_pattern_:
      pattern.pigment = read_pigment_block(reader);
      break;
    case Word::density_file_: {
      reader.accept(Word::df3_);
      const std::string name = reader.text("the name of a file");
      pattern.density_file = reader.find_file(name, reader.here()).string();
      pattern.interpolate = 0;
      if (reader.accept(Word::interpolate_)) pattern.interpolate = reader.integer("interpolate");
      break;
    }
    case Word::slope_:
      read_slope(reader, pattern.slope);
      break;
    default:
      read_numbers_of(reader, word, pattern);
  }
}

bool read_pattern_modifier(Reader& reader, Pattern& pattern, Shared<BlendMap>& map, Transform& to_object) {
  if (read_transform(reader, to_object)) return true;
  const Token token = reader.next();
  if (token.kind != TokenKind::word) {
    reader.put_back(token);
    return false;
  }
  const Word word = token.symbol->word;
  if (const Word kind = map_kind(word); kind != Word::none) {
    map = read_map_block(reader, kind);
    return true;
  }
  switch (word) {
    case Word::turbulence_:
      pattern.turbulence = reader.vector("turbulence");
      return true;
    case Word::octaves_:
      pattern.octaves = reader.integer("octaves");
      return true;
    case Word::lambda_:
      pattern.lambda = reader.number("lambda");
      return true;
    case Word::omega_:
      pattern.omega = reader.number("omega");
      return true;
    case Word::frequency_:
      pattern.frequency = reader.number("frequency");
      return true;
    case Word::phase_:
      pattern.phase = reader.number("phase");
      return true;
    case Word::ramp_wave_:
    case Word::triangle_wave_:
    case Word::sine_wave_:
    case Word::scallop_wave_:
    case Word::cubic_wave_:
      pattern.wave = word;
      return true;
    case Word::poly_wave_:
      pattern.wave = word;
      if (reader.number_follows()) pattern.wave_exponent = reader.number("an exponent");
      return true;
    case Word::warp_:
      // A transformation before a warp belongs to the pattern alone, one behind it to both.
      if (to_object != Transform{}) {
        Warp before;
        before.transform = std::exchange(to_object, Transform{});
        pattern.warps.push_back(before);
      }
      pattern.warps.push_back(read_warp(reader));
      return true;
    case Word::brick_size_:
      pattern.brick_size = reader.vector("brick_size");
      return true;
    case Word::mortar_:
      pattern.mortar = reader.number("mortar");
      return true;
    case Word::form_:
      pattern.crackle_form = reader.vector("form");
      return true;
    case Word::metric_:
      pattern.crackle_metric = reader.number("metric");
      return true;
    case Word::offset_:
      pattern.crackle_offset = reader.number("offset");
      return true;
    case Word::solid_:
      pattern.crackle_solid = true;
      return true;
    case Word::agate_turb_:
      pattern.agate_turb = reader.number("agate_turb");
      return true;
    case Word::control0_:
      pattern.control0 = reader.number("control0");
      return true;
    case Word::control1_:
      pattern.control1 = reader.number("control1");
      return true;
    case Word::uv_mapping_:
      pattern.uv_mapping = reader.has_uv_mapping = true;
      return true;
    case Word::noise_generator_:
      pattern.noise = std::make_shared<NoiseGenerator>(read_noise_generator(reader));
      return true;
    case Word::number_of_waves_:
    case Word::turb_depth_:
    case Word::accuracy_:
    case Word::interpolate_:
      reader.numbers();
      return true;
    case Word::use_color_:
    case Word::use_colour_:
    case Word::use_index_:
    case Word::no_bump_scale_:
      return true;
    case Word::exponent_: {
      constexpr int most = 33;
      pattern.fractal.exponent =
          static_cast<std::uint32_t>(std::clamp(reader.integer("the exponent of a fractal"), 2, most));
      return true;
    }
    case Word::exterior_:
      read_fractal_color(reader, pattern.fractal.outside, pattern.fractal.outside_factor);
      return true;
    case Word::interior_:
      read_fractal_color(reader, pattern.fractal.inside, pattern.fractal.inside_factor);
      return true;
    default:
      reader.put_back(token);
      return false;
  }
}

ImageMap read_image_map(Reader& reader, double* bump_size) {
  reader.expect('{', "behind an image");
  ImageMap image;
  const Token first = reader.peek();
  if (first.is(Word::function_)) {
    reader.next();
    reader.numbers(), reader.comma(), reader.numbers();
    skip_block(reader);
    reader.notes.dropped("an image that is made of a function: grey", reader.location(first.place));
  }
  while (!reader.accept('}')) {
    const Token token = reader.next();
    if (token.kind == TokenKind::text ||
        (token.kind == TokenKind::word && token.symbol->word == Word::none) ||
        (token.kind == TokenKind::word && names_text(token.symbol->word))) {
      reader.put_back(token);
      const std::string name = reader.text("the name of an image");
      image.filename = reader.find_image(name, token.place);
      continue;
    }
    if (token.is(',')) continue;
    if (token.kind != TokenKind::word) reader.unexpected(token, "a part of an image");
    switch (token.symbol->word) {
      case Word::map_type_:
        image.map_type = reader.integer("map_type");
        break;
      case Word::once_:
        image.once = true;
        break;
      case Word::interpolate_:
        image.interpolate = reader.integer("interpolate");
        break;
      case Word::filter_:
      case Word::transmit_: {
        double& all = token.symbol->word == Word::filter_ ? image.filter_all : image.transmit_all;
        if (reader.accept(Word::all_)) {
          all = reader.number("a share");
        } else {
          reader.numbers(), reader.comma(), reader.numbers();
          reader.notes.dropped("filter and transmit of one colour of an image's palette",
                               reader.location(token.place));
        }
        break;
      }
      case Word::gamma_:
        if ((image.gamma_srgb = reader.accept(Word::srgb_))) break;
        image.gamma = reader.number("gamma");
        break;
      case Word::bump_size_: {
        const double size = reader.number("bump_size");
        if (bump_size) *bump_size = size;
        break;
      }
      case Word::premultiplied_:
      case Word::use_alpha_:
      case Word::use_color_:
      case Word::use_colour_:
      case Word::use_index_:
        if (reader.number_follows()) reader.numbers();
        break;
      default:  // the format, which the file itself says
        break;
    }
  }
  return image;
}

}  // namespace vitrail::pov
