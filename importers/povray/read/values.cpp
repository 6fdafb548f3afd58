// SPDX-License-Identifier: Apache-2.0
// What #declare and the arguments of macros take.
#include <fmt/format.h>

#include "importers/povray/read/fog.h"
#include "importers/povray/read/function.h"
#include "importers/povray/read/levels.h"
#include "importers/povray/read/objects.h"
#include "importers/povray/read/patterns.h"
#include "importers/povray/read/reader.h"
#include "importers/povray/read/spline.h"
#include "importers/povray/read/view.h"

namespace vitrail::pov {

namespace {

// array[2][3] {{…}, {…}}, or without sizes.
void read_elements(Reader& reader, Array& array, std::size_t dimension, std::vector<Value>& elements) {
  reader.expect('{', "before the elements of an array");
  std::size_t count = 0;
  while (!reader.accept('}')) {
    if (reader.accept(',')) continue;
    ++count;
    if (dimension + 1 < array.sizes.size()) {
      read_elements(reader, array, dimension + 1, elements);
      continue;
    }
    elements.push_back(read_value(reader));
    if (elements.size() > (std::size_t{1} << 28)) reader.fail("an array is too large", reader.here());
  }
  std::size_t& size = array.sizes[dimension];
  if (size == 0) size = count;
  if (count > size) reader.fail(fmt::format("there are {} elements for {}", count, size), reader.here());
  // What is not given has no value.
  std::size_t stride = 1;
  for (std::size_t i = dimension + 1; i < array.sizes.size(); ++i) stride *= array.sizes[i];
  elements.resize(elements.size() + (size - count) * stride);
}

Value read_array(Reader& reader) {
  auto array = std::make_shared<Array>();
  std::size_t total = 1;
  while (reader.at('[')) {
    reader.next();
    const double size = reader.number("the size of an array");
    reader.expect(']', "behind the size of an array");
    constexpr double most = 1 << 28;
    if (!(size >= 1 && size * static_cast<double>(total) <= most))
      reader.fail(fmt::format("the size of an array is {}", size), reader.here());
    array->sizes.push_back(static_cast<std::size_t>(size));
    total *= array->sizes.back();
  }
  const bool sized = !array->sizes.empty();
  if (!sized) array->sizes.push_back(0);
  if (reader.at('{') || !sized)
    read_elements(reader, *array, 0, array->elements);
  else
    array->elements.resize(total);
  settle(reader, *array);
  return array;
}

Value read_spline(Reader& reader) {
  reader.expect('{', "behind spline");
  auto spline = std::make_shared<Spline>();
  for (;;) {
    reader.comma();
    const Token token = reader.next();
    if (token.is('}')) return spline;
    if (token.kind == TokenKind::word)
      if (const auto kind = spline_kind(token.symbol->word)) {
        spline->kind = *kind;
        continue;
      }
    reader.put_back(token);
    if (const auto named = reader.identifier<std::shared_ptr<Spline>>()) {
      const auto kind = spline->kind;
      *spline = **named;
      if (kind != Spline::Kind::linear) spline->kind = kind;
      continue;
    }
    Spline::Knot knot;
    knot.at = reader.number("a place on a spline");
    reader.comma();
    knot.value = reader.numbers();
    if (knot.value.terms == 1) knot.value = knot.value.promoted(3);
    spline->add(knot);
  }
}

// One texture, or one upon the other.
Value read_textures(Reader& reader) {
  Shared<Texture> first = read_texture_block(reader);
  if (!reader.at(Word::texture_)) return first;
  auto layered = std::make_shared<Texture>();
  layered->place = first->place;
  const auto add = [&](const Shared<Texture>& t) {
    if (t->layers.empty())
      layered->layers.push_back(t);
    else
      layered->layers.insert(layered->layers.end(), t->layers.begin(), t->layers.end());
  };
  add(first);
  while (reader.at(Word::texture_)) {
    reader.next();
    add(read_texture_block(reader));
  }
  settle(reader, *layered);
  return Shared<Texture>(layered);
}

}  // namespace

Value read_value(Reader& reader) {
  const Token token = reader.peek();
  if (token.kind != TokenKind::word) return reader.evaluate();
  const Word word = token.symbol->word;
  if (word == Word::none) return reader.evaluate();
  const auto read = [&] { reader.next(); };
  if (names_object(word)) {
    auto object = std::make_shared<Object>(*read_object(reader));
    object->declared = true;
    return Shared<Object>(object);
  }
  if (const Word kind = map_kind(word); kind != Word::none) {
    read();
    return read_map_block(reader, kind);
  }
  switch (word) {
    case Word::texture_:
      read();
      return read_textures(reader);
    case Word::pigment_:
      read();
      return read_pigment_block(reader);
    case Word::normal_:
      read();
      return read_normal_block(reader);
    case Word::finish_:
      read();
      return read_finish_block(reader);
    case Word::interior_:
      read();
      return read_interior_block(reader);
    case Word::material_:
      read();
      return read_material_block(reader);
    case Word::camera_:
      read();
      return read_camera_block(reader);
    case Word::sky_sphere_:
      read();
      return read_sky_sphere_block(reader);
    case Word::transform_:
      read();
      return Shared<Placement>(std::make_shared<Placement>(Placement{read_transform_block(reader)}));
    case Word::function_:
      read();
      return declare_function(reader);
    case Word::array_:
      read();
      return read_array(reader);
    case Word::spline_:
      read();
      return read_spline(reader);
    case Word::density_:
      read();
      if (auto named = reader.identifier<Shared<Pigment>>()) return *named;
      return read_pigment_block(reader);
    case Word::fog_:
      read();
      return read_fog_block(reader);
    case Word::media_:
      read();
      return read_media_block(reader);
    case Word::rainbow_:
      read();
      if (auto named = reader.identifier<Dropped>()) return *named;
      skip_block(reader);
      return Dropped{token.symbol->name};
    case Word::translate_:
    case Word::rotate_:
    case Word::scale_:
    case Word::matrix_: {
      // "#declare T = rotate 90*x" is a vector in old scenes.
      Transform t;
      read_transform(reader, t);
      return Shared<Placement>(std::make_shared<Placement>(Placement{t}));
    }
    default:
      return reader.evaluate();
  }
}

}  // namespace vitrail::pov
