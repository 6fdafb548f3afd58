// SPDX-License-Identifier: Apache-2.0
// From the light of a scene to that of a screen by curves that need no library. Each takes three channels of
// linear sRGB and gives those that a screen shows, in [0,1], still linear; what is below 0 counts as 0.
#pragma once

#include "scene/records/image.h"

namespace vitrail {

// AgX (Sobotka 2022): colours go a fifth of the way to grey, so that bright ones pale; their logarithms, from
// 10 stops below 0.18 to 6.5 above, go through a sigmoid with slope 2 in the middle and powers 3 (toe) and
// 3.25 (shoulder), whose values are as encoded for a screen of gamma 2.2; and back from grey. 0.18 becomes
// 0.5 encoded, 16.3 white.
Image agx_tone_mapped(const Image& rgb);

// John Hable's curve of Uncharted 2 (GDC 2010, "Filmic"), each channel by itself, at twice the light, white
// being 11.2: highlights roll off, shadows have a toe. 5.6 becomes white.
Image filmic_tone_mapped(const Image& rgb);

// The stops that bring the picture's log-average luminance to 0.18 (Reinhard and others 2002, eq. 1 and 2),
// of the pixels that have any; 0 where none has.
double automatic_exposure_ev(const Image& rgb);

// The same where most of what is lit would be far above white (half of those pixels above 8), as pictures in
// cd/m² are; else 0, so that a picture stays as bright as its scene makes it.
double fitting_exposure_ev(const Image& rgb);

}  // namespace vitrail
