// SPDX-License-Identifier: Apache-2.0
// pigment {}, normal {} and the maps of both.
#include <algorithm>

#include "importers/povray/read/function.h"
#include "importers/povray/read/levels.h"
#include "importers/povray/read/patterns.h"
#include "importers/povray/read/reader.h"

namespace vitrail::pov {

void skip_block(Reader& reader) {
  reader.expect('{', "at the beginning of a block");
  for (int depth = 1; depth > 0;) {
    const Token token = reader.next();
    if (token.kind == TokenKind::end) reader.fail("a block has no closing brace", token.place);
    depth += token.is('{') ? 1 : token.is('}') ? -1 : 0;
  }
}

Shared<BlendMap> read_map_block(Reader& reader, Word kind) {
  if (!reader.accept('{')) {
    if (const auto named = reader.identifier<Shared<BlendMap>>()) return *named;
    reader.expect('{', "behind a map");
  }
  const Reader::Deeper deeper(reader, reader.here());
  BlendMap map;
  map.kind = kind;
  if (const auto named = reader.identifier<Shared<BlendMap>>()) map = **named;
  while (reader.accept('[')) {
    BlendEntry entry;
    // Entries of `average` may be without a weight.
    entry.at = kind == Word::color_map_ || reader.number_follows() ? reader.number("a place in a map") : 1;
    reader.comma();
    switch (kind) {
      case Word::pigment_map_:
      case Word::density_map_:
      case Word::normal_map_:
      case Word::texture_map_: {
        // The contents of a block, without its braces.
        reader.put_back([&] {
          Token t;
          t.kind = TokenKind::sign, t.sign = '[', t.place = reader.here();
          return t;
        }());
        if (kind == Word::texture_map_)
          entry.texture = read_texture_block(reader);
        else if (kind == Word::normal_map_)
          entry.bump = read_normal_block(reader);
        else
          entry.pigment = read_pigment_block(reader);
        map.entries.push_back(std::move(entry));
        continue;
      }
      case Word::slope_map_:
        entry.color = reader.numbers();
        reader.comma();
        if (reader.number_follows()) entry.color.v[1] = reader.number("a slope");
        break;
      default: {
        // The old form gives both ends of a piece: [0.0 0.5 color A color B].
        std::optional<double> to;
        const Token token = reader.peek();
        if (reader.number_follows() && !(token.kind == TokenKind::word)) {
          const Numbers n = reader.numbers();
          reader.comma();
          if (n.terms == 1 && !n.is_color && reader.number_follows()) {
            to = n.v[0];
          } else {
            entry.color = n.promoted(n.terms == 1 ? 3 : std::max(3, n.terms)).promoted(5);
            entry.color.is_color = true;
            map.entries.push_back(entry);
            reader.expect(']', "at the end of an entry of a map");
            reader.comma();
            continue;
          }
        }
        entry.color = reader.color();
        map.entries.push_back(entry);
        if (to) {
          reader.comma();
          entry.at = *to;
          if (reader.number_follows()) entry.color = reader.color();
          map.entries.push_back(entry);
        }
        reader.expect(']', "at the end of an entry of a map");
        reader.comma();
        continue;
      }
    }
    map.entries.push_back(std::move(entry));
    reader.expect(']', "at the end of an entry of a map");
    reader.comma();
  }
  reader.expect('}', "at the end of a map");
  settle(reader, map);
  return std::make_shared<BlendMap>(std::move(map));
}

namespace {

// What opens a block: a brace, or the bracket of a map's entry.
char opened(Reader& reader) {
  if (reader.accept('[')) return ']';
  reader.expect('{', "at the beginning of a block");
  return '}';
}

}  // namespace

Shared<Pigment> read_pigment_block(Reader& reader, const Shared<Pigment>& from) {
  if (const auto named = reader.identifier<Shared<Pigment>>(); named) return *named;
  const char close = opened(reader);
  const Reader::Deeper deeper(reader, reader.here());
  Pigment pigment = from ? *from : Pigment{};
  pigment.place = reader.here();
  std::optional<Transform> in_uv;  // of one by (u,v), which what follows its name does not move
  for (;;) {
    reader.comma();
    const Token token = reader.peek();
    if (token.is(close)) break;
    if (auto named = reader.identifier<Shared<Pigment>>()) {
      pigment = **named;
      pigment.place = token.place;
      if (pigment.pattern.uv_mapping) in_uv = pigment.to_object;
      continue;
    }
    if (reader.number_follows()) {
      pigment.color = reader.color();
      pigment.pattern = {}, pigment.map = {};
      continue;
    }
    if (token.kind == TokenKind::word) {
      const Word word = token.symbol->word;
      if (word == Word::red_ || word == Word::green_ || word == Word::blue_ || word == Word::filter_ ||
          word == Word::transmit_) {
        const Numbers before = pigment.color.value_or(Finish::grey(0));
        Numbers changed = reader.color();
        if (word == Word::filter_ || word == Word::transmit_)
          for (std::size_t i = 0; i < 5; ++i)
            if (changed.v[i] == 0) changed.v[i] = before.v[i];
        pigment.color = changed;
        continue;
      }
      if (names_pattern(word)) {
        reader.next();
        pigment.color.reset();
        pigment.pattern.image.reset();
        read_pattern(reader, word, pigment.pattern, pigment.map);
        continue;
      }
      if (word == Word::image_map_) {
        reader.next();
        pigment.color.reset();
        pigment.pattern.kind = word;
        pigment.pattern.image = read_image_map(reader);
        continue;
      }
      if (word == Word::quick_color_ || word == Word::quick_colour_) {
        reader.next();
        pigment.quick_color = reader.color();
        continue;
      }
    }
    if (read_pattern_modifier(reader, pigment.pattern, pigment.map, pigment.to_object)) {
      // A map without a pattern's word makes one of the values along it.
      continue;
    }
    reader.unexpected(reader.next(), "a part of pigment");
  }
  reader.next();
  if (in_uv) pigment.to_object = *in_uv;
  settle(reader, pigment);
  return std::make_shared<Pigment>(std::move(pigment));
}

Shared<Pigment> read_pattern_block(Reader& reader) { return read_pigment_block(reader); }

Shared<Bump> read_normal_block(Reader& reader) {
  if (const auto named = reader.identifier<Shared<Bump>>(); named) return *named;
  const char close = opened(reader);
  const Reader::Deeper deeper(reader, reader.here());
  Bump bump;
  if (reader.defaults.texture && reader.defaults.texture->normal) bump = *reader.defaults.texture->normal;
  bump.place = reader.here();
  for (;;) {
    reader.comma();
    const Token token = reader.peek();
    if (token.is(close)) break;
    if (auto named = reader.identifier<Shared<Bump>>()) {
      bump = **named;
      continue;
    }
    if (token.kind == TokenKind::word) {
      const Word word = token.symbol->word;
      if (names_pattern(word)) {
        reader.next();
        bump.pattern.image.reset();
        read_pattern(reader, word, bump.pattern, bump.map);
        reader.comma();
        if (reader.number_follows()) bump.size = reader.number("the size of bumps");
        continue;
      }
      if (word == Word::bump_map_) {
        reader.next();
        bump.pattern.kind = word;
        bump.pattern.image = read_image_map(reader, &bump.size);
        continue;
      }
      if (word == Word::no_bump_scale_) {
        reader.next();
        bump.scaled = !reader.flag();
        continue;
      }
      if (word == Word::bump_size_) {
        reader.next();
        bump.size = reader.number("bump_size");
        continue;
      }
    }
    if (read_pattern_modifier(reader, bump.pattern, bump.map, bump.to_object)) continue;
    if (reader.number_follows()) {
      bump.size = reader.number("the size of bumps");
      continue;
    }
    reader.unexpected(reader.next(), "a part of normal");
  }
  reader.next();
  settle(reader, bump);
  return std::make_shared<Bump>(std::move(bump));
}

}  // namespace vitrail::pov
