// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "importers/povray/read/extents.h"
#include "importers/povray/read/function.h"
#include "importers/povray/read/height_image.h"
#include "importers/povray/read/reader.h"
#include "importers/povray/read/solid_shapes.h"
#include "importers/solids/implicit.h"

namespace vitrail::pov {

namespace {

// A set without end is looked at within a box; on its own within this one, and farther where it leaves that.
const Bounds3d alone{{-20, -20, -20}, {20, 20, 20}};
constexpr double farthest = 1000;

Bounds3d bounds_of_seen(const solids::Solid& solid) {
  Bounds3d bounds;
  for (std::size_t t = 0; t < solid.triangles.size(); ++t)
    if (solid.surfaces[t] != solids::unseen)
      for (const std::uint32_t corner : solid.triangles[t]) extend(bounds, solid.positions[corner]);
  return bounds;
}

// The surface within `box`. What is much smaller than the box may lie between the points of its lattice: it
// is looked for in cubes around the origin, each half the one before, and then in what is found.
solids::Solid surface_within(const solids::Field& field, const Bounds3d& box) {
  solids::Implicit implicit;
  implicit.field = field;
  implicit.open = true;
  implicit.cells = 64;  // what is thinner than a cell is not found, and would be cut off
  implicit.most_halvings = 0;
  Bounds3d found, container = box;
  for (double half = alone.upper.x; half > 0.1 && found.empty(); half /= 2) {
    const Bounds3d cube = common(box, Bounds3d{{-half, -half, -half}, {half, half, half}});
    container = half == alone.upper.x || cube.empty() ? box : cube;
    implicit.container = container;
    found = bounds_of_seen(solids::implicit(implicit));
  }
  for (int times = 0; times < 4 && !found.empty(); ++times) {
    const Vector3d size = extent(container);
    const double margin = 2 * std::max({size.x, size.y, size.z}) / implicit.cells;
    const Vector3d wider{margin, margin, margin};
    const Bounds3d closer = common(container, Bounds3d{found.lower - wider, found.upper + wider});
    const Vector3d smaller = extent(closer);
    if (smaller.x * smaller.y * smaller.z > 0.5 * size.x * size.y * size.z) break;
    implicit.container = container = closer;
    found = bounds_of_seen(solids::implicit(implicit));
  }
  solids::Implicit fine;
  fine.field = field;
  fine.open = true;
  fine.container = container;
  fine.cells = 64;
  return solids::implicit(fine);
}

// All of it: what reaches the sides of the box goes on.
solids::Solid surface_alone(const solids::Field& field) {
  solids::Solid solid = surface_within(field, alone);
  const Bounds3d seen = bounds_of_seen(solid);
  bool ends = true;
  for (int axis = 0; axis < 3 && !seen.empty(); ++axis)
    ends = ends && seen.lower[axis] > alone.lower[axis] && seen.upper[axis] < alone.upper[axis];
  return ends ? solid : solids::far_reaching(field, alone.upper.x, farthest);
}

SolidShape endless(Reader& reader, const Place& place, int order, std::vector<double> coefficients) {
  const auto within = [order, coefficients](const Bounds3d& box) {
    return surface_within(solids::polynomial(order, coefficients), box);
  };
  reader.notes.approximated(
      "a surface of a polynomial: what is within 1000 of the origin, or of what it is cut by",
      reader.location(place));
  const solids::Field field = solids::polynomial(order, std::move(coefficients));
  SolidShape shape{[field] { return surface_alone(field); }, within, {}, {}};
  shape.inside = [field](Point3d p) { return field(p) < 0; };
  return shape;
}

std::vector<double> coefficients(Reader& reader, int order) {
  const int count = (order + 1) * (order + 2) * (order + 3) / 6;
  reader.expect('<', "before coefficients");
  std::vector<double> result;
  for (int i = 0; i < count; ++i) {
    result.push_back(reader.number("a coefficient"));
    reader.comma();
  }
  reader.expect('>', "behind coefficients");
  return result;
}

SolidShape quadric(Reader& reader, const Place& place) {
  std::array<double, 10> abc;
  for (std::size_t group = 0; group < 3; ++group) {
    const Vector3d v = reader.vector("coefficients of a quadric");
    for (int i = 0; i < 3; ++i) abc[3 * group + static_cast<std::size_t>(i)] = v[i];
    reader.comma();
  }
  abc[9] = reader.number("a coefficient of a quadric");
  return endless(reader, place, 2, solids::quadric_coefficients(abc));
}

SolidShape poly(Reader& reader, const Place& place, int order) {
  if (order == 0) {
    order = reader.integer("the order of a polynomial");
    reader.comma();
  }
  if (order < 1 || order > 35) reader.fail(fmt::format("the order of a polynomial is {}", order), place);
  return endless(reader, place, order, coefficients(reader, order));
}

// Of the spheres within which its parts count.
Bounds3d around(const solids::Blob& blob) {
  Bounds3d box;
  for (const solids::BlobComponent& part : blob.components)
    for (const Point3d& end : {part.end1, part.end2})
      for (int corner = 0; corner < 8; ++corner)
        extend(box, transform_point(part.to_blob, end + Vector3d{corner & 1 ? part.radius : -part.radius,
                                                                 corner & 2 ? part.radius : -part.radius,
                                                                 corner & 4 ? part.radius : -part.radius}));
  return box;
}

SolidShape blob(Reader& reader, Object& object) {
  solids::Blob blob;
  for (;;) {
    reader.comma();
    const Token t = reader.next();
    if (t.is(Word::threshold_)) {
      blob.threshold = reader.number("the threshold of a blob");
      continue;
    }
    if (!t.is(Word::sphere_) && !t.is(Word::cylinder_) && !t.is(Word::component_)) {
      reader.put_back(t);
      break;
    }
    solids::BlobComponent part;
    const auto strength = [&] {
      reader.comma();
      reader.accept(Word::strength_);
      part.strength = reader.number("the strength of a blob's part");
    };
    if (t.is(Word::component_)) {  // of old scenes: strength, radius, place
      part.strength = reader.number("the strength of a blob's part");
      reader.comma();
      part.radius = reader.number("the radius of a blob's part");
      reader.comma();
      part.end1 = part.end2 = reader.point("the place of a blob's part");
      blob.components.push_back(part);
      continue;
    }
    reader.expect('{', "behind a part of a blob");
    part.end1 = reader.point("the place of a blob's part");
    reader.comma();
    part.end2 = part.end1;
    if (t.is(Word::cylinder_)) part.end2 = reader.point("the place of a blob's part"), reader.comma();
    part.radius = reader.number("the radius of a blob's part");
    strength();
    Object modified;
    int layers = 0;
    while (read_object_modifier(reader, modified, layers)) {
    }
    reader.expect('}', "at the end of a blob's part");
    if (modified.texture) {
      reader.notes.approximated("textures of a blob's parts: one for all", reader.location(t.place));
      if (!object.texture) object.texture = modified.texture;
    }
    part.to_blob = modified.to_parent;
    blob.components.push_back(part);
  }
  return {[blob] { return solids::blob(blob); }, {}, {}, around(blob)};
}

Bounds3d around(const solids::Container& container) {
  if (const auto* box = std::get_if<Bounds3d>(&container)) return *box;
  const auto& sphere = std::get<solids::ContainingSphere>(container);
  const Vector3d r{sphere.radius, sphere.radius, sphere.radius};
  return {sphere.center - r, sphere.center + r};
}

bool is_within(const solids::Container& container, Point3d p) {
  if (const auto* sphere = std::get_if<solids::ContainingSphere>(&container))
    return length(p - sphere->center) < sphere->radius;
  const auto& box = std::get<Bounds3d>(container);
  for (int axis = 0; axis < 3; ++axis)
    if (!(p[axis] > box.lower[axis] && p[axis] < box.upper[axis])) return false;
  return true;
}

solids::Container read_container(Reader& reader) {
  reader.expect('{', "behind contained_by");
  solids::Container container;
  if (reader.accept(Word::sphere_)) {
    reader.expect('{', "behind sphere");
    solids::ContainingSphere sphere;
    sphere.center = reader.point("the centre of a sphere");
    reader.comma();
    sphere.radius = reader.number("the radius of a sphere");
    container = sphere;
  } else {
    if (!reader.accept(Word::box_)) reader.unexpected(reader.next(), "box or sphere");
    reader.expect('{', "behind box");
    Bounds3d box;
    extend(box, reader.point("a corner of a box"));
    reader.comma();
    extend(box, reader.point("a corner of a box"));
    container = box;
  }
  reader.expect('}', "at the end of a container");
  reader.expect('}', "at the end of contained_by");
  return container;
}

// `function { … }`, or the name of one.
Shared<Function> function_block(Reader& reader) {
  if (!reader.accept(Word::function_)) reader.unexpected(reader.next(), "function");
  return read_function(reader);
}

SolidShape isosurface(Reader& reader) {
  const Shared<Function> function = function_block(reader);
  solids::Implicit implicit;
  double threshold = 0;
  for (;;) {
    reader.comma();
    const Token t = reader.next();
    if (t.is(Word::contained_by_))
      implicit.container = read_container(reader);
    else if (t.is(Word::threshold_))
      threshold = reader.number("the threshold of an isosurface");
    else if (t.is(Word::max_gradient_))
      implicit.max_gradient = reader.number("max_gradient");
    else if (t.is(Word::open_))
      implicit.open = true;
    else if (t.is(Word::accuracy_) || t.is(Word::max_trace_))
      reader.numbers();
    else if (t.is(Word::evaluate_)) {
      for (int i = 0; i < 3; ++i) reader.numbers(), reader.comma();
    } else if (!t.is(Word::all_intersections_)) {
      reader.put_back(t);
      break;
    }
  }
  implicit.max_gradient = 0;  // scenes give less than it is
  implicit.field = [function, threshold](const Point3d& p) {
    const double at[3] = {p.x, p.y, p.z};
    return evaluate(*function, at) - threshold;
  };
  const auto inside = [implicit](Point3d p) {
    return is_within(implicit.container, p) && implicit.field(p) < 0;
  };
  return {[implicit] { return solids::implicit(implicit); }, {}, inside, around(implicit.container)};
}

SolidShape parametric(Reader& reader) {
  std::array<Shared<Function>, 3> functions;
  for (auto& function : functions) {
    reader.comma();
    function = function_block(reader);
  }
  solids::Parametric surface;
  reader.comma();
  const Point2d from = reader.point2("where (u,v) begin");
  reader.comma();
  const Point2d to = reader.point2("where (u,v) end");
  surface.from = {from.x, from.y}, surface.to = {to.x, to.y};
  for (;;) {
    reader.comma();
    const Token t = reader.next();
    if (t.is(Word::contained_by_))
      surface.contained_by = read_container(reader);
    else if (t.is(Word::max_gradient_) || t.is(Word::accuracy_))
      reader.numbers();
    else if (t.is(Word::precompute_)) {
      reader.numbers();
      while (reader.accept(',') || reader.peek().is(Word::x_) || reader.peek().is(Word::y_) ||
             reader.peek().is(Word::z_))
        reader.numbers();
    } else {
      reader.put_back(t);
      break;
    }
  }
  surface.place = [functions](double u, double v) {
    const double at[3] = {u, v, 0};
    return Point3d{evaluate(*functions[0], at), evaluate(*functions[1], at), evaluate(*functions[2], at)};
  };
  std::optional<Bounds3d> box;
  if (surface.contained_by) box = around(*surface.contained_by);
  return {[surface] { return solids::parametric(surface); }, {}, {}, box};
}

SolidShape height_field(Reader& reader, const Place& place) {
  solids::HeightField field;
  std::string file;
  Shared<Function> function;
  if (reader.accept(Word::function_)) {
    field.columns = reader.integer("the width of a height field");
    reader.comma();
    field.rows = reader.integer("the height of a height field");
    function = read_function(reader);
  } else {
    while (reader.peek().kind == TokenKind::word && reader.peek().symbol->word != Word::none &&
           !names_text(reader.peek().symbol->word))
      reader.next();  // the format, which the file itself says
    file = reader.find_image(reader.text("the name of an image"), place);
  }
  for (;;) {
    reader.comma();
    const Token t = reader.next();
    if (t.is(Word::smooth_))
      field.smooth = reader.flag();
    else if (t.is(Word::water_level_))
      field.water_level = reader.number("water_level");
    else if (t.is(Word::gamma_)) {
      if (!reader.accept(Word::srgb_)) reader.numbers();
    } else if (!t.is(Word::premultiplied_)) {
      reader.put_back(t);
      break;
    } else {
      reader.flag();
    }
  }
  if (function) {
    constexpr int most = 4096;
    if (field.columns < 2 || field.rows < 2 || field.columns > most || field.rows > most)
      reader.fail(fmt::format("a height field has {} by {} points", field.columns, field.rows), place);
    for (int row = field.rows - 1; row >= 0; --row)
      for (int column = 0; column < field.columns; ++column) {
        const double at[3] = {column / (field.columns - 1.0), row / (field.rows - 1.0), 0};
        const double height = evaluate(*function, at);
        field.heights.push_back(std::clamp(height, 0.0, 1.0));
      }
  } else if (file.empty()) {
    field.columns = field.rows = 2, field.heights.assign(4, 0.5);
  } else {
    read_heights(file, field, reader, place);
  }
  return {[field] { return solids::height_field(field); }, {}, {}, {}};
}

}  // namespace

bool read_implicit(Reader& reader, Word word, Object& object) {
  switch (word) {
    case Word::quadric_:
      object.shape = quadric(reader, object.place);
      return true;
    case Word::cubic_:
      object.shape = poly(reader, object.place, 3);
      return true;
    case Word::quartic_:
      object.shape = poly(reader, object.place, 4);
      return true;
    case Word::poly_:
      object.shape = poly(reader, object.place, 0);
      return true;
    case Word::blob_:
      object.shape = blob(reader, object);
      return true;
    case Word::isosurface_:
      object.shape = isosurface(reader);
      return true;
    case Word::parametric_:
      object.shape = parametric(reader);
      return true;
    case Word::height_field_:
      object.shape = height_field(reader, object.place);
      return true;
    default:
      return false;
  }
}

}  // namespace vitrail::pov
