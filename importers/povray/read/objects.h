// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "importers/povray/read/object.h"

namespace vitrail::pov {

class Reader;

// Returns whether the word begins an object.
bool names_object(Word word);

// Reads an object, from its word on. Throws Error where there is none.
Shared<Object> read_object(Reader& reader);

// Reads an object, or the name of one, with modifiers; up to the brace that ends the block.
Shared<Object> read_object_in(Reader& reader);

// These read shapes behind word and brace, up to their modifiers (simple_shapes.cpp, mesh_shapes.cpp, …).
void read_shape(Reader& reader, Word word, Object& object);
void read_mesh(Reader& reader, Object& object);
void read_mesh2(Reader& reader, Object& object);
void read_polygon(Reader& reader, Object& object);
void read_triangle(Reader& reader, Object& object, bool smooth);
void read_light(Reader& reader, Object& object);
// Returns false where the word begins none of these.
bool read_solid(Reader& reader, Word word, Object& object);

// Reads a modifier of objects, if one comes. `layers` counts the textures that this block has given by now.
bool read_object_modifier(Reader& reader, Object& object, int& layers);

}  // namespace vitrail::pov
