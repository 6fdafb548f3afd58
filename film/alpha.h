// SPDX-License-Identifier: Apache-2.0
// How much of a pixel something covers: channel "A" of a picture, of films that keep the layer `alpha`.
#pragma once

#include "film/develop.h"

namespace vitrail {

// Null: the picture has none.
const PictureChannel* alpha_of(const Picture& picture);

// Colours as PNG has them: of what covers a pixel, not times how much it covers, as a film and OpenEXR have
// them. Black where nothing is. Coverage becomes 0 … 1. Nothing happens to a picture without alpha.
void make_straight(Picture& picture);

}  // namespace vitrail
