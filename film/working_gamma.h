// SPDX-License-Identifier: Apache-2.0
// These functions turn sums of a film whose scene adds up a screen's colours (working_gamma) into light.
#pragma once

#include "scene/records/film_settings.h"
#include "scene/spectra/color.h"

namespace vitrail {

// Takes each component to the power of `gamma`, or decodes it as sRGB; odd, so that noise around 0 stays.
RGB light_of(RGB sum, double gamma);

// Returns the slope of that at a grey ≥ 0: how many times wider an error becomes.
double light_per_sum(double grey, double gamma);

}  // namespace vitrail
