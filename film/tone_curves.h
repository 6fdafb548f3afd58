// SPDX-License-Identifier: Apache-2.0
// These curves turn the light of a scene into that of a screen without a library. Each takes three channels
// of linear sRGB and gives those that a screen shows, in [0,1], still linear; light below 0 counts as 0.
#pragma once

#include "scene/records/image.h"

namespace vitrail {

// AgX (Sobotka 2022) first takes colours a fifth of the way to grey, so that bright ones pale. Their
// logarithms, from 10 stops below 0.18 to 6.5 above, go through a sigmoid with slope 2 in the middle and
// powers 3 (toe) and 3.25 (shoulder). Its values are as encoded for a screen of gamma 2.2; colours then come
// back from grey. 0.18 becomes 0.5 encoded, 16.3 white.
Image agx_tone_mapped(const Image& rgb);

// John Hable's curve of Uncharted 2 (GDC 2010, "Filmic") takes each channel by itself, at twice the light,
// with white at 11.2. Highlights roll off, shadows have a toe. 5.6 becomes white.
Image filmic_tone_mapped(const Image& rgb);

// Returns the stops that bring the log-average luminance of the pixels that have any to 0.18 (Reinhard and
// others 2002, eq. 1 and 2); 0 where none has.
double automatic_exposure_ev(const Image& rgb);

// Returns the same where most lit pixels would be far above white (half of them above 8), as in pictures in
// cd/m². Else it returns 0, so that a picture stays as bright as its scene makes it.
double fitting_exposure_ev(const Image& rgb);

}  // namespace vitrail
