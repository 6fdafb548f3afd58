// SPDX-License-Identifier: Apache-2.0
// What scenes ask of objects while they are read.
#pragma once

#include "importers/povray/read/token.h"
#include "scene/geometry/bounds.h"

namespace vitrail::pov {

class Reader;

// What both hold; empty where they do not meet.
Bounds3d common(const Bounds3d& a, const Bounds3d& b);

// By the box of what the object is made of, under its transformation; of what has no end, ±1e7.
Bounds3d extents_of(const Object& object);

// inside() and trace(), behind the opening bracket.
Numbers ask_object(Reader& reader, const Token& function);

}  // namespace vitrail::pov
