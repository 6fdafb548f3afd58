// SPDX-License-Identifier: Apache-2.0
// These functions cut out a part of a picture, or give it another size.
#pragma once

#include "film/develop.h"

namespace vitrail {

// Cuts to the part of a picture in `window`, pixels of the whole, which lies within its own window.
void cut_to(Picture& picture, const PixelRect& window);

// Adds rows below those of `picture`, which is to have `height` of them. The first ones make it.
void append_rows(Picture& picture, Picture rows, int height);

// Makes each pixel a mean of those about it, weighted by a tent of one pixel's radius, of the new pixels
// where these are larger. Ids are those of the nearest pixel. The new picture is a whole of its own.
// Variances are left out: its pixels share samples.
void resize(Picture& picture, int width, int height);

}  // namespace vitrail
