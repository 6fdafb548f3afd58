// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "importers/povray/read/objects.h"
#include "importers/povray/read/spline.h"

namespace vitrail::pov {

// Reads shapes where a function is negative: quadrics, polynomials, blobs, isosurfaces; and height fields and
// parametrics. Returns false where the word begins none of these.
bool read_implicit(Reader& reader, Word word, Object& object);

}  // namespace vitrail::pov
