// SPDX-License-Identifier: Apache-2.0
// Sums of a film whose scene adds up colours of a screen (FilmSettings::working_gamma), as light.
#pragma once

#include "scene/records/film_settings.h"
#include "scene/spectra/color.h"

namespace vitrail {

// Each component to the power of `gamma`, or decoded as sRGB; an odd function, so that noise around 0 stays.
RGB light_of(RGB sum, double gamma);

// The slope of that at a grey ≥ 0: how many times wider an error becomes.
double light_per_sum(double grey, double gamma);

}  // namespace vitrail
