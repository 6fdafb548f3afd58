// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/read/pattern_warps.h"
#include "importers/povray/read/reader.h"

namespace vitrail::pov {

namespace {

// What a warp's first word begins, with the numbers that belong to it; false: it is none of these.
bool begins_warp(Reader& reader, Word word, Warp& warp) {
  switch (word) {
    case Word::turbulence_:
      warp.kind = Warp::Kind::turbulence;
      warp.amount = reader.vector("turbulence");
      return true;
    case Word::repeat_:
      warp.kind = Warp::Kind::repeat;
      warp.amount = reader.vector("the step of a repetition");
      return true;
    case Word::black_hole_:
      warp.kind = Warp::Kind::black_hole;
      warp.center = reader.point("the centre of a black hole");
      reader.comma();
      warp.radius = reader.number("the radius of a black hole");
      return true;
    case Word::transform_:
      warp.kind = Warp::Kind::transform;
      warp.transform = read_transform_block(reader);
      return true;
    case Word::planar_:
      warp.kind = Warp::Kind::planar;
      if (reader.number_follows()) {
        warp.orientation = reader.vector("the orientation of a warp");
        reader.comma();
        warp.distance = reader.number("the distance of a warp");
      }
      return true;
    case Word::cylindrical_:
      warp.kind = Warp::Kind::cylindrical;
      return true;
    case Word::spherical_:
      warp.kind = Warp::Kind::spherical;
      return true;
    case Word::toroidal_:
      warp.kind = Warp::Kind::toroidal;
      return true;
    default:
      return false;
  }
}

}  // namespace

Warp read_warp(Reader& reader) {
  reader.expect('{', "behind warp");
  Warp warp;
  while (!reader.accept('}')) {
    const Token token = reader.next();
    if (token.is(',')) continue;
    if (token.kind != TokenKind::word) reader.unexpected(token, "a part of warp");
    const Word word = token.symbol->word;
    if (begins_warp(reader, word, warp)) continue;
    switch (word) {
      case Word::octaves_:
        warp.octaves = reader.integer("octaves");
        break;
      case Word::lambda_:
        warp.lambda = reader.number("lambda");
        break;
      case Word::omega_:
        warp.omega = reader.number("omega");
        break;
      case Word::offset_:
        warp.offset = reader.vector("the offset of a repetition");
        break;
      case Word::flip_:
        warp.flip = reader.vector("the flip of a repetition");
        break;
      case Word::strength_:
        warp.strength = reader.number("the strength of a black hole");
        break;
      case Word::falloff_:
        warp.falloff = reader.number("the falloff of a black hole");
        break;
      case Word::inverse_:
        warp.inverse = true;
        break;
      case Word::orientation_:
        warp.orientation = reader.vector("the orientation of a warp");
        break;
      case Word::dist_exp_:
        warp.dist_exp = reader.number("dist_exp");
        break;
      case Word::major_radius_:
        warp.major_radius = reader.number("the radius of a torus");
        break;
      default:  // how the holes of a repeated black hole lie
        while (reader.number_follows()) {
          reader.numbers();
          reader.comma();
        }
    }
  }
  return warp;
}

}  // namespace vitrail::pov
