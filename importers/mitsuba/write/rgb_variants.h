// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "importers/mitsuba/write/write_context.h"

namespace vitrail::mitsuba_writer {

// Returns the luminance of an emission in Mitsuba's rgb variants ÷ its own: they look at a written spectrum
// in 1000 places, .47 nm apart, and cut a colour outside of sRGB at 0 (3.9.1). It is 1 for rgb and for black.
double luminance_in_rgb_variants(const Spectrum& emission);

// Reports that luminance where it is off by more than 1 %.
void report_rgb_variants(Context& context, const Spectrum& emission);

// Returns the luminance to which Mitsuba's rgb variants weaken white light (D65) by a medium's extinction at
// the depth where the spectrum leaves a tenth of it: they weaken three numbers, each by its own.
double tenth_in_rgb_variants(const Spectrum& extinction);

// Reports, once a scene that is not Mitsuba's, how far the product of a light's and a surface's three numbers
// is off from that of their spectra, where it is by more than 2 %.
void report_products_in_rgb_variants(Context& context);

// Returns whether the item comes from a scene file of Mitsuba's.
bool is_mitsuba_file(const Scene& scene, const Origin& origin);

}  // namespace vitrail::mitsuba_writer
