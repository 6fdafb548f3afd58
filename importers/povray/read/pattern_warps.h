// SPDX-License-Identifier: Apache-2.0
// Warps and turbulence move the point at which a pattern is looked up (POV-Ray's documentation, "Pattern
// modifiers"; where it leaves a choice, as povray 3.7 shows).
#pragma once

#include "importers/povray/read/surface.h"
#include "scene/geometry/vec.h"

namespace vitrail::pov {

// Reads behind the word `warp`.
Warp read_warp(Reader& reader);

Point3d warped(const Warp& warp, Point3d p);
// Returns the point as `turbulence` outside of a warp moves it.
Point3d turbulent(const Pattern& pattern, Point3d p);

}  // namespace vitrail::pov
