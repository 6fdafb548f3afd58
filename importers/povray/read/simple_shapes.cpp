// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "importers/povray/read/objects.h"
#include "importers/povray/read/reader.h"

namespace vitrail::pov {

namespace {

double radius(Reader& reader, const char* what) {
  const double r = reader.number(what);
  if (r < 0)
    reader.notes.approximated(fmt::format("{} below 0: its amount", what), reader.location(reader.here()));
  return std::abs(r);
}

}  // namespace

void read_shape(Reader& reader, Word word, Object& object) {
  switch (word) {
    case Word::sphere_: {
      SphereShape s;
      s.center = reader.point("the centre of a sphere");
      reader.comma();
      s.radius = radius(reader, "the radius of a sphere");
      object.shape = s;
      return;
    }
    case Word::box_: {
      BoxShape s;
      s.corner1 = reader.point("a corner of a box");
      reader.comma();
      s.corner2 = reader.point("a corner of a box");
      object.shape = s;
      return;
    }
    case Word::plane_: {
      PlaneShape s;
      s.normal = reader.vector("the normal of a plane");
      reader.comma();
      s.distance = reader.number("the distance of a plane");
      if (!(length(s.normal) > 0)) reader.fail("the normal of a plane is 0", object.place);
      s.normal = normalize(s.normal);
      object.shape = s;
      return;
    }
    case Word::cylinder_: {
      ConeShape s;
      s.base = reader.point("an end of a cylinder");
      reader.comma();
      s.cap = reader.point("an end of a cylinder");
      reader.comma();
      s.base_radius = s.cap_radius = radius(reader, "the radius of a cylinder");
      s.open = reader.accept(Word::open_);
      if (s.base == s.cap) reader.fail("a cylinder has no length", object.place);
      object.shape = s;
      return;
    }
    case Word::cone_: {
      ConeShape s;
      s.base = reader.point("an end of a cone");
      reader.comma();
      s.base_radius = radius(reader, "the radius of a cone");
      reader.comma();
      s.cap = reader.point("an end of a cone");
      reader.comma();
      s.cap_radius = radius(reader, "the radius of a cone");
      s.open = reader.accept(Word::open_);
      if (s.base == s.cap) reader.fail("a cone has no length", object.place);
      object.shape = s;
      return;
    }
    case Word::disc_: {
      DiscShape s;
      s.center = reader.point("the centre of a disc");
      reader.comma();
      s.normal = reader.vector("the normal of a disc");
      reader.comma();
      s.radius = radius(reader, "the radius of a disc");
      if (reader.accept(',') || reader.number_follows())
        s.hole_radius = radius(reader, "the radius of a hole");
      if (!(length(s.normal) > 0)) reader.fail("the normal of a disc is 0", object.place);
      object.shape = s;
      return;
    }
    case Word::polygon_:
      return read_polygon(reader, object);
    case Word::triangle_:
    case Word::smooth_triangle_:
      return read_triangle(reader, object, word == Word::smooth_triangle_);
    case Word::mesh_:
      return read_mesh(reader, object);
    case Word::mesh2_:
      return read_mesh2(reader, object);
    default:
      if (!read_solid(reader, word, object)) reader.fail("this kind of object is not read", object.place);
  }
}

}  // namespace vitrail::pov
