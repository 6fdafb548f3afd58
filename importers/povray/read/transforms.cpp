// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/read/transforms.h"

#include <numbers>

#include "importers/povray/read/reader.h"

namespace vitrail::pov {

Transform rotation(Vector3d degrees) {
  constexpr double degree = std::numbers::pi / 180;
  Transform t;
  if (degrees.x != 0) t = rotate(degrees.x * degree, {1, 0, 0});
  if (degrees.y != 0) t = rotate(degrees.y * degree, {0, 1, 0}) * t;
  if (degrees.z != 0) t = rotate(degrees.z * degree, {0, 0, 1}) * t;
  return t;
}

namespace {

// Twelve numbers, a row for the image of each axis and one for the origin.
Transform matrix(Reader& reader) {
  reader.expect('<', "behind matrix");
  Transform t;
  for (std::size_t column = 0; column < 4; ++column)
    for (std::size_t row = 0; row < 3; ++row) {
      t.m[row][column] = reader.number("a number of a matrix");
      reader.comma();
    }
  reader.expect('>', "at the end of a matrix");
  return t;
}

}  // namespace

Transform read_transform_block(Reader& reader) {
  if (const auto named = reader.identifier<Shared<Placement>>()) return (*named)->transform;
  reader.expect('{', "behind transform");
  const Reader::Deeper deeper(reader, reader.here());
  Transform t;
  bool inverted = false;
  for (;;) {
    if (reader.accept(Word::inverse_)) {
      inverted = true;
      continue;
    }
    if (const auto named = reader.identifier<Shared<Placement>>()) {
      t = (*named)->transform * t;
      continue;
    }
    if (!read_transform(reader, t)) break;
  }
  reader.expect('}', "at the end of transform");
  if (!inverted) return t;
  if (!is_invertible(t)) reader.fail("this transformation has no inverse", reader.here());
  return inverse(t);
}

bool read_transform(Reader& reader, Transform& transform) {
  const Token token = reader.next();
  Transform by;
  if (token.is(Word::translate_)) {
    by = translate(reader.vector("a translation"));
  } else if (token.is(Word::rotate_)) {
    by = rotation(reader.vector("a rotation"));
  } else if (token.is(Word::scale_)) {
    Vector3d factors = reader.vector("a scale");
    for (int axis = 0; axis < 3; ++axis)
      if (factors[axis] == 0) {  // POV-Ray, too, takes 1 then
        factors[axis] = 1;
        reader.notes.approximated("a scale by 0: by 1", reader.location(token.place));
      }
    by = scale(factors);
  } else if (token.is(Word::matrix_)) {
    by = matrix(reader);
    if (!is_invertible(by)) {
      reader.notes.approximated("a matrix that has no inverse: left out", reader.location(token.place));
      by = {};
    }
  } else if (token.is(Word::transform_)) {
    by = read_transform_block(reader);
  } else {
    reader.put_back(token);
    return false;
  }
  transform = by * transform;
  return true;
}

}  // namespace vitrail::pov
