// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/read/objects.h"
#include "importers/povray/read/reader.h"

namespace vitrail::pov {

namespace {

// What takes a part of the light from where the file says it to before the transformations that stand in
// front of it: as in povray, they move what was said by then.
Transform before_what_stands(const Object& object) {
  return is_invertible(object.to_parent) ? inverse(object.to_parent) : Transform{};
}

void read_area(Reader& reader, LightShape& light, const Transform& before) {
  light.area = true;
  light.axis1 = transform_vector(before, reader.vector("an axis of an area_light"));
  reader.comma();
  light.axis2 = transform_vector(before, reader.vector("an axis of an area_light"));
  reader.comma();
  light.count1 = std::max(1, reader.integer("a number of lights"));
  reader.comma();
  light.count2 = std::max(1, reader.integer("a number of lights"));
}

bool read_light_part(Reader& reader, LightShape& light, Object& object, const Token& token) {
  switch (token.symbol->word) {
    case Word::spotlight_:
      light.kind = LightShape::Kind::spot;
      return true;
    case Word::cylinder_:
      light.kind = LightShape::Kind::cylinder;
      return true;
    case Word::parallel_:
      light.parallel = true;
      return true;
    case Word::point_at_:
      light.point_at = transform_point(before_what_stands(object), reader.point("point_at"));
      return true;
    case Word::radius_:
      light.radius_deg = reader.number("radius");
      return true;
    case Word::falloff_:
      light.falloff_deg = reader.number("falloff");
      return true;
    case Word::tightness_:
      light.tightness = reader.number("tightness");
      return true;
    case Word::area_light_:
      read_area(reader, light, before_what_stands(object));
      return true;
    case Word::circular_:
      light.circular = true;
      return true;
    case Word::fade_distance_:
      light.fade_distance = reader.number("fade_distance");
      return true;
    case Word::fade_power_:
      light.fade_power = reader.number("fade_power");
      return true;
    case Word::shadowless_:
      light.shadowless = true;
      return true;
    case Word::media_interaction_:
      if (!reader.flag())
        reader.notes.approximated("media_interaction off: media show the light",
                                  reader.location(token.place));
      return true;
    case Word::media_attenuation_:
      light.attenuated = reader.flag();
      return true;
    case Word::adaptive_:
      if (reader.number_follows()) reader.numbers();
      return true;
    case Word::area_illumination_:
    case Word::jitter_:
    case Word::orient_:
      reader.flag();
      return true;
    case Word::looks_like_: {
      reader.expect('{', "behind looks_like");
      auto looks = std::make_shared<Object>(*read_object_in(reader));
      reader.expect('}', "at the end of looks_like");
      const Transform placed = before_what_stands(object) *
                               translate(transform_point(object.to_parent, light.position) - Point3d{});
      looks->to_parent = placed * looks->to_parent;
      if (looks->texture) looks->texture = moved(looks->texture, placed);
      looks->no_shadow = true;
      object.children.push_back(looks);
      return true;
    }
    case Word::projected_through_:
      reader.expect('{', "behind projected_through");
      read_object_in(reader);
      reader.expect('}', "at the end of projected_through");
      light.projected = true;
      return true;
    default:
      return false;
  }
}

}  // namespace

void read_light(Reader& reader, Object& object) {
  LightShape light;
  light.position = reader.point("the place of a light");
  reader.comma();
  light.color = reader.color();
  for (;;) {
    reader.comma();
    const Token token = reader.next();
    if (token.kind == TokenKind::word && read_light_part(reader, light, object, token)) continue;
    reader.put_back(token);
    int layers = 0;
    if (token.is('}') || !read_object_modifier(reader, object, layers)) break;
  }
  object.shape = light;
}

}  // namespace vitrail::pov
