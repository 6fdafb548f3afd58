// SPDX-License-Identifier: Apache-2.0
// Shapes that importers/solids makes.
#include <array>

#include "importers/povray/read/function.h"
#include "importers/povray/read/objects.h"
#include "importers/povray/read/reader.h"
#include "importers/povray/read/solid_shapes.h"
#include "importers/solids/fractal.h"
#include "importers/solids/grids.h"
#include "importers/solids/primitives.h"
#include "importers/solids/sweeps.h"

namespace vitrail::pov {

namespace {

using solids::SplineKind;

SolidShape torus(Reader& reader) {
  const double major = reader.number("the radius of a torus");
  reader.comma();
  const double minor = reader.number("the radius of a torus' tube");
  return {[=] { return solids::torus(std::abs(major), std::abs(minor)); },
          {},
          {},
          {},
          false,
          torus_uvs(std::abs(major))};
}

SolidShape superellipsoid(Reader& reader) {
  const Point2d e = reader.point2("the exponents of a superellipsoid");
  return {[=] { return solids::superellipsoid(e.x, e.y); }, {}, {}, {}};
}

SolidShape ovus(Reader& reader) {
  const double bottom = reader.number("the radius of an ovus");
  reader.comma();
  const double top = reader.number("the radius of an ovus");
  return {[=] { return solids::ovus(bottom, top); }, {}, {}, {}};
}

std::vector<Point2d> plane_points(Reader& reader) {
  const int count = reader.integer("the number of points");
  std::vector<Point2d> points;
  for (int i = 0; i < count; ++i) {
    reader.comma();
    points.push_back(reader.point2("a point"));
  }
  reader.comma();
  return points;
}

SplineKind spline_kind_of(Reader& reader) {
  if (reader.accept(Word::quadratic_spline_)) return SplineKind::quadratic;
  if (reader.accept(Word::cubic_spline_)) return SplineKind::cubic;
  if (reader.accept(Word::bezier_spline_)) return SplineKind::bezier;
  reader.accept(Word::linear_spline_);
  return SplineKind::linear;
}

SolidShape prism(Reader& reader) {
  solids::Prism prism;
  for (bool more = true; more;) {
    more = true;
    if (reader.accept(Word::conic_sweep_))
      prism.conic = true;
    else if (reader.accept(Word::linear_sweep_))
      prism.conic = false;
    else if (const Token t = reader.peek();
             t.is(Word::bezier_spline_) || (t.kind == TokenKind::word && spline_kind(t.symbol->word)))
      prism.spline = spline_kind_of(reader);
    else
      more = false;
  }
  prism.height1 = reader.number("a height of a prism");
  reader.comma();
  prism.height2 = reader.number("a height of a prism");
  reader.comma();
  prism.points = plane_points(reader);
  prism.open = reader.accept(Word::open_);
  return {[prism] { return solids::prism(prism); }, {}, {}, {}};
}

SolidShape lathe(Reader& reader) {
  solids::Lathe lathe;
  lathe.spline = spline_kind_of(reader);
  lathe.points = plane_points(reader);
  const SurfaceUvs uvs = lathe_uvs(lathe.spline, lathe.points);
  return {[lathe] { return solids::lathe(lathe); }, {}, {}, {}, false, uvs};
}

SolidShape revolution(Reader& reader) {
  solids::SurfaceOfRevolution sor;
  sor.points = plane_points(reader);
  sor.open = reader.accept(Word::open_);
  const SurfaceUvs uvs = revolution_uvs(sor.points);
  return {[sor] { return solids::surface_of_revolution(sor); }, {}, {}, {}, false, uvs};
}

SolidShape letters(Reader& reader) {
  solids::Text text;
  if (reader.accept(Word::internal_)) {
    reader.integer("the number of a font");
    text.font_file = reader.find_file("timrom.ttf", reader.here()).string();
  } else {
    reader.accept(Word::ttf_);
    const std::string font = reader.text("the name of a font");
    text.font_file = reader.find_file(font, reader.here()).string();
  }
  reader.comma();
  text.utf8 = reader.text("a text");
  reader.comma();
  text.thickness = reader.number("the thickness of a text");
  reader.comma();
  text.offset = reader.vector("the offset of letters");
  return {[text] { return solids::text(text); }, {}, {}, {}};
}

SolidShape sphere_sweep(Reader& reader) {
  solids::SphereSweep sweep;
  if (reader.accept(Word::b_spline_))
    sweep.kind = solids::SweepKind::b_spline;
  else if (reader.accept(Word::cubic_spline_))
    sweep.kind = solids::SweepKind::cubic;
  else
    reader.accept(Word::linear_spline_);
  reader.comma();
  const int count = reader.integer("the number of spheres");
  for (int i = 0; i < count; ++i) {
    reader.comma();
    const Point3d center = reader.point("the centre of a sphere");
    reader.comma();
    sweep.spheres.push_back({center, reader.number("the radius of a sphere")});
  }
  if (reader.accept(Word::tolerance_)) reader.numbers();
  return {[sweep] { return solids::sphere_sweep(sweep); }, {}, {}, {}};
}

SolidShape bicubic_patch(Reader& reader) {
  std::array<Point2d, 4> corners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  for (Token t = reader.next();; t = reader.next()) {
    if (t.is(Word::type_) || t.is(Word::flatness_) || t.is(Word::u_steps_) || t.is(Word::v_steps_)) {
      reader.numbers();
    } else if (t.is(Word::uv_vectors_)) {
      for (Point2d& corner : corners) corner = reader.point2("a uv vector"), reader.comma();
    } else if (!t.is(',')) {
      reader.put_back(t);
      break;
    }
  }
  std::array<Point3d, 16> points;
  for (Point3d& p : points) {
    p = reader.point("a point of a patch");
    reader.comma();
  }
  return {[points] { return solids::bicubic_patch(points); }, {}, {}, {}, true, patch_uvs(points, corners)};
}

std::array<double, 4> four(Reader& reader, const char*) {
  const Numbers n = reader.numbers().promoted(4);
  return {n.v[0], n.v[1], n.v[2], n.v[3]};
}

SolidShape julia_fractal(Reader& reader) {
  solids::JuliaFractal fractal;
  fractal.parameter = four(reader, "the parameter of a fractal");
  for (;;) {
    reader.comma();
    const Token t = reader.next();
    if (t.is(Word::quaternion_))
      fractal.hypercomplex = false;
    else if (t.is(Word::hypercomplex_))
      fractal.hypercomplex = true;
    else if (t.is(Word::sqr_))
      fractal.function = solids::JuliaFractal::Function::square;
    else if (t.is(Word::cube_))
      fractal.function = solids::JuliaFractal::Function::cube;
    else if (t.is(Word::max_iteration_))
      fractal.max_iteration = reader.integer("max_iteration");
    else if (t.is(Word::precision_))
      reader.numbers();
    else if (t.is(Word::slice_)) {
      fractal.slice_normal = four(reader, "the normal of a slice");
      reader.comma();
      fractal.slice_distance = reader.number("the distance of a slice");
    } else if (t.kind == TokenKind::word && (names_number(t.symbol->word) || t.is(Word::reciprocal_)) &&
               !t.is(Word::no_)) {
      reader.notes.approximated("a function of a fractal: its square", reader.location(t.place));
      if (t.is(Word::pwr_)) reader.numbers();
    } else {
      reader.put_back(t);
      break;
    }
  }
  return {[fractal] { return solids::julia_fractal(fractal); }, {}, {}, {}};
}

}  // namespace

bool read_solid(Reader& reader, Word word, Object& object) {
  switch (word) {
    case Word::torus_:
      object.shape = torus(reader);
      return true;
    case Word::superellipsoid_:
      object.shape = superellipsoid(reader);
      return true;
    case Word::ovus_:
      object.shape = ovus(reader);
      return true;
    case Word::prism_:
      object.shape = prism(reader);
      return true;
    case Word::lathe_:
      object.shape = lathe(reader);
      return true;
    case Word::sor_:
      object.shape = revolution(reader);
      return true;
    case Word::text_:
      object.shape = letters(reader);
      return true;
    case Word::sphere_sweep_:
      object.shape = sphere_sweep(reader);
      return true;
    case Word::bicubic_patch_:
      object.shape = bicubic_patch(reader);
      return true;
    case Word::julia_fractal_:
      object.shape = julia_fractal(reader);
      return true;
    default:
      return read_implicit(reader, word, object);
  }
}

}  // namespace vitrail::pov
