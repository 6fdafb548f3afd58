// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/read/objects.h"

#include <fmt/format.h>

#include <utility>

#include "importers/povray/read/extents.h"
#include "importers/povray/read/levels.h"
#include "importers/povray/read/reader.h"

namespace vitrail::pov {

bool names_object(Word word) {
  switch (word) {
    case Word::bicubic_patch_:
    case Word::blob_:
    case Word::box_:
    case Word::cone_:
    case Word::cubic_:
    case Word::cylinder_:
    case Word::difference_:
    case Word::disc_:
    case Word::height_field_:
    case Word::intersection_:
    case Word::isosurface_:
    case Word::julia_fractal_:
    case Word::lathe_:
    case Word::light_group_:
    case Word::light_source_:
    case Word::merge_:
    case Word::mesh_:
    case Word::mesh2_:
    case Word::object_:
    case Word::ovus_:
    case Word::parametric_:
    case Word::plane_:
    case Word::poly_:
    case Word::polygon_:
    case Word::polynomial_:
    case Word::prism_:
    case Word::quadric_:
    case Word::quartic_:
    case Word::smooth_triangle_:
    case Word::sor_:
    case Word::sphere_:
    case Word::sphere_sweep_:
    case Word::superellipsoid_:
    case Word::text_:
    case Word::torus_:
    case Word::triangle_:
    case Word::union_:
      return true;
    default:
      return false;
  }
}

namespace {

// The texture that a part of one goes to.
std::shared_ptr<Texture> changed(Reader& reader, const Object& object) {
  if (object.texture) return std::make_shared<Texture>(*object.texture);
  auto texture = reader.defaults.texture ? std::make_shared<Texture>(*reader.defaults.texture)
                                         : std::make_shared<Texture>();
  texture->place = reader.here();
  return texture;
}

// Textures lie on those that are there.
void add_layer(Object& object, const Shared<Texture>& texture, int& layers) {
  if (!object.texture || layers == 0) {
    object.texture = texture;
  } else {
    auto layered = std::make_shared<Texture>();
    layered->place = texture->place;
    if (object.texture->layers.empty())
      layered->layers.push_back(object.texture);
    else
      *layered = *object.texture;
    if (!texture->layers.empty())
      layered->layers.insert(layered->layers.end(), texture->layers.begin(), texture->layers.end());
    else
      layered->layers.push_back(texture);
    object.texture = layered;
  }
  ++layers;
}

void move(Object& object, const Transform& by) {
  object.to_parent = by * object.to_parent;
  if (object.texture && !object.uv_mapping) object.texture = moved(object.texture, by);
  if (object.interior_texture && !object.uv_mapping)
    object.interior_texture = moved(object.interior_texture, by);
  if (object.interior) object.interior = moved(object.interior, by);
  for (Shared<Object>& clip : object.clipped_by) {
    auto copy = std::make_shared<Object>(*clip);
    copy->to_parent = by * copy->to_parent;
    clip = copy;
  }
}

Object copy_of(const Shared<Object>& object) {
  Object copy = *object;
  copy.declared = copy.refers = false;
  if (!copy.original) copy.original = object;
  return copy;
}

// What refers to a union becomes a copy of it before its texture or interior changes: they are the union's
// own then.
void make_own(Object& object, int& layers) {
  if (!object.refers) return;
  Object own = copy_of(object.children.front());
  move(own, object.to_parent);
  own.place = object.place;
  own.clipped_by.insert(own.clipped_by.end(), object.clipped_by.begin(), object.clipped_by.end());
  own.inverse ^= object.inverse, own.no_shadow |= object.no_shadow, own.no_image |= object.no_image;
  own.hollow |= object.hollow, own.uv_mapping |= object.uv_mapping, own.no_reflection |= object.no_reflection;
  own.no_radiosity |= object.no_radiosity, own.double_illuminate |= object.double_illuminate;
  layers = own.texture ? 1 : 0;
  object = std::move(own);
}

bool is_of_surface(Word word) {
  return word == Word::texture_ || word == Word::pigment_ || word == Word::normal_ || word == Word::finish_ ||
         word == Word::interior_texture_ || word == Word::interior_ || word == Word::material_;
}

void read_clips(Reader& reader, Object& object) {
  reader.expect('{', "behind clipped_by");
  if (reader.accept(Word::bounded_by_)) {
    reader.notes.dropped("clipped_by { bounded_by }", reader.location(reader.here()));
    reader.expect('}', "at the end of clipped_by");
    return;
  }
  while (!reader.accept('}')) object.clipped_by.push_back(read_object(reader));
}

// They say where POV-Ray looks for the object. One without an end is made within their box; of others they
// are no part.
void read_bounds(Reader& reader, Object& object) {
  reader.expect('{', "behind bounded_by");
  Bounds3d bound;
  if (!reader.accept(Word::clipped_by_))
    while (!reader.at('}'))
      if (const Bounds3d one = extents_of(*read_object(reader)); !one.empty()) extend(bound, one);
  reader.expect('}', "at the end of bounded_by");
  if (auto* solid = std::get_if<SolidShape>(&object.shape); solid && solid->unbounded && !bound.empty()) {
    solid->box = moved_box(bound, inverse(object.to_parent));
    solid->make = [within = *solid->unbounded, box = *solid->box] { return within(box); };
  }
}

// What an object or a lamp says of photons; all but which objects they are shot at is left out.
void read_photons(Reader& reader) {
  reader.expect('{', "behind photons");
  for (int depth = 1; depth > 0;) {
    const Token token = reader.next();
    if (token.kind == TokenKind::end) reader.fail("photons has no closing brace", token.place);
    if (token.is(Word::target_))
      reader.has_photon_target |= reader.flag();
    else if (token.is(Word::reflection_) || token.is(Word::refraction_))
      reader.photons_go_on |= reader.flag();
    depth += token.is('{') ? 1 : token.is('}') ? -1 : 0;
  }
}

}  // namespace

bool read_object_modifier(Reader& reader, Object& object, int& layers) {
  reader.comma();
  Transform step;
  if (read_transform(reader, step)) {
    move(object, step);
    return true;
  }
  const Token token = reader.next();
  if (token.kind != TokenKind::word) {
    reader.put_back(token);
    return false;
  }
  if (is_of_surface(token.symbol->word)) make_own(object, layers);
  switch (token.symbol->word) {
    case Word::texture_:
      add_layer(object, read_texture_block(reader), layers);
      return true;
    case Word::pigment_: {
      auto texture = changed(reader, object);
      change_top(*texture, [&](Texture& top, const Transform&) {
        top.pigment = read_pigment_block(reader);
        top.pattern.reset();
      });
      object.texture = texture;
      return true;
    }
    case Word::normal_: {
      auto texture = changed(reader, object);
      change_top(*texture,
                 [&](Texture& top, const Transform& placed) { change_normal(reader, top, placed); });
      object.texture = texture;
      return true;
    }
    case Word::finish_: {
      auto texture = changed(reader, object);
      change_top(*texture,
                 [&](Texture& top, const Transform&) { top.finish = read_finish_block(reader, top.finish); });
      object.texture = texture;
      return true;
    }
    case Word::interior_texture_:
      object.interior_texture = read_texture_block(reader);
      return true;
    case Word::interior_:
      object.interior = read_interior_block(reader);
      return true;
    case Word::material_: {
      const auto material = read_material_block(reader);
      if (material->texture) add_layer(object, material->texture, layers);
      if (material->interior_texture) object.interior_texture = material->interior_texture;
      if (material->interior) object.interior = material->interior;
      return true;
    }
    case Word::clipped_by_:
      read_clips(reader, object);
      return true;
    case Word::bounded_by_:
      read_bounds(reader, object);
      return true;
    case Word::no_shadow_:
      object.no_shadow = true;
      return true;
    case Word::no_image_:
      object.no_image = reader.flag();
      return true;
    case Word::inverse_:
      object.inverse = !object.inverse;
      return true;
    case Word::hollow_:
      object.hollow = reader.flag();
      return true;
    case Word::uv_mapping_:
      object.uv_mapping = reader.has_uv_mapping = true;
      return true;
    case Word::no_reflection_:
      object.no_reflection = reader.flag();
      return true;
    case Word::no_radiosity_:
      object.no_radiosity = reader.flag();
      return true;
    case Word::double_illuminate_:
      object.double_illuminate = reader.flag();
      return true;
    case Word::sturm_:
    case Word::hierarchy_:
    case Word::split_union_:
    case Word::cutaway_textures_:
    case Word::global_lights_:
      reader.flag();
      return true;
    case Word::photons_:
      read_photons(reader);
      return true;
    case Word::radiosity_:
      skip_block(reader);
      return true;
    default:
      reader.put_back(token);
      return false;
  }
}

Shared<Object> read_object_in(Reader& reader) {
  const int before = std::exchange(reader.function_levels, 0);
  auto object = std::make_shared<Object>();
  object->place = reader.peek().place;
  int layers = 0;
  if (const auto named = reader.identifier<Shared<Object>>()) {
    // A copy of a group refers to it, so that many copies of it can be one prototype.
    if (const auto* group = std::get_if<GroupShape>(&(*named)->shape);
        group && (*named)->declared && (*named)->children.size() > 1 && group->kind == Word::union_) {
      object->children.push_back(*named);
      object->refers = true;
    } else {
      *object = copy_of(*named);
      layers = object->texture ? 1 : 0;
    }
  } else {
    const Token token = reader.peek();
    if (token.kind != TokenKind::word || !names_object(token.symbol->word))
      reader.unexpected(reader.next(), "an object");
    *object = *read_object(reader);
    layers = object->texture ? 1 : 0;
  }
  while (read_object_modifier(reader, *object, layers)) {
  }
  settle(reader, *object, reader.function_levels);
  reader.function_levels = before;
  return object;
}

Shared<Object> read_object(Reader& reader) {
  if (const auto named = reader.identifier<Shared<Object>>()) return *named;
  const Token token = reader.next();
  if (token.kind != TokenKind::word || !names_object(token.symbol->word))
    reader.unexpected(token, "an object");
  const Reader::Deeper deeper(reader, token.place);
  const Word word = token.symbol->word;
  reader.expect('{', "behind the word of an object");
  if (word == Word::object_) {
    auto object = read_object_in(reader);
    reader.expect('}', "at the end of an object");
    return object;
  }
  const int before = std::exchange(reader.function_levels, 0);
  auto object = std::make_shared<Object>();
  object->place = token.place;
  int layers = 0;
  // "sphere { Name scale 2 }", too, is a copy.
  if (const auto named = reader.identifier<Shared<Object>>()) {
    const bool adds = word == Word::union_ || word == Word::merge_ || word == Word::intersection_ ||
                      word == Word::difference_ || word == Word::light_group_;
    if (!adds) {
      *object = copy_of(*named);
      object->place = token.place;
      layers = object->texture ? 1 : 0;
    } else {
      object->shape = GroupShape{word};
      object->children.push_back(*named);
    }
  }
  switch (word) {
    case Word::union_:
    case Word::merge_:
    case Word::intersection_:
    case Word::difference_:
    case Word::light_group_:
      object->shape = GroupShape{word};
      for (;;) {
        reader.comma();
        const Token next = reader.peek();
        const bool names =
            next.kind == TokenKind::word &&
            (names_object(next.symbol->word) || (next.symbol->value() && next.symbol->word == Word::none));
        if (!names) break;
        object->children.push_back(read_object(reader));
      }
      break;
    case Word::light_source_:
      if (!std::holds_alternative<LightShape>(object->shape)) read_light(reader, *object);
      break;
    default:
      if (std::holds_alternative<GroupShape>(object->shape)) read_shape(reader, word, *object);
  }
  while (read_object_modifier(reader, *object, layers)) {
  }
  reader.expect('}', "at the end of an object");
  settle(reader, *object, reader.function_levels);
  reader.function_levels = before;
  return object;
}

}  // namespace vitrail::pov
