// SPDX-License-Identifier: Apache-2.0
// Parts of a picture, and a picture in another size.
#pragma once

#include "film/develop.h"

namespace vitrail {

// The part of a picture in `window`, pixels of the whole, which lies within its own.
void cut_to(Picture& picture, const PixelRect& window);

// Adds rows below those of `picture`, which is to have `height` of them. The first ones make it.
void append_rows(Picture& picture, Picture rows, int height);

// Each pixel is a mean of those about it, weighted by a tent of one pixel's radius, of the new ones where
// these are larger; ids are those of the nearest pixel. The new picture is a whole of its own. Variances are
// left out: its pixels share samples.
void resize(Picture& picture, int width, int height);

}  // namespace vitrail
