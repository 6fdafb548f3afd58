// SPDX-License-Identifier: Apache-2.0
// These functions count how deep the things that a scene declares lie within each other. Loops make long
// chains (`#declare U = union { object { U } … }`), and whoever walks or frees one does so by recursion.
#pragma once

#include "importers/povray/read/function.h"
#include "importers/povray/read/object.h"
#include "importers/povray/read/reader.h"

namespace vitrail::pov {

inline constexpr int most_levels = 1000;

// They return the levels below a thing, by those of its parts; 0: it has none.
int levels_within(const Pattern& pattern);
int levels_within(const BlendMap& map);
int levels_within(const Pigment& pigment);
int levels_within(const Bump& bump);
int levels_within(const Texture& texture);
int levels_within(const Interior& interior);
int levels_within(const Object& object);
int levels_within(const Function& function);
int levels_within(const Array& array);
// Returns the levels of what an identifier stands for; 0 where it has none.
int levels_of(const Value& value);

// Sets the levels of a thing whose parts are all there, `from` their least; throws Error above the most.
template <class T>
void settle(Reader& reader, T& thing, int from = 0) {
  thing.levels = 1 + std::max(levels_within(thing), from);
  if (thing.levels > most_levels) reader.too_many_levels(most_levels);
}

}  // namespace vitrail::pov
