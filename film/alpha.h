// SPDX-License-Identifier: Apache-2.0
// Alpha is how much of a pixel something covers: channel "A" of a picture, of films that keep layer `alpha`.
#pragma once

#include "film/develop.h"

namespace vitrail {

// Returns the channel, or null where the picture has none.
const PictureChannel* alpha_of(const Picture& picture);

// Turns colours from those of a film and OpenEXR, times coverage, into those of PNG, which are of what covers
// a pixel. They are black where nothing is. Coverage becomes 0 … 1. A picture without alpha stays as it is.
void make_straight(Picture& picture);

}  // namespace vitrail
