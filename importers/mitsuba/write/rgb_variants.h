// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "importers/mitsuba/write/write_context.h"

namespace vitrail::mitsuba_writer {

// The luminance of an emission in Mitsuba's rgb variants ÷ its own: they look at a written spectrum in 1000
// places, .47 nm apart, and cut a colour outside of sRGB at 0 (3.9.1). 1 of rgb and of what is black.
double luminance_in_rgb_variants(const Spectrum& emission);

// Says it where it is off by more than 1 %.
void report_rgb_variants(Context& context, const Spectrum& emission);

// Whether the item comes from a scene file of Mitsuba's.
bool is_mitsuba_file(const Scene& scene, const Origin& origin);

}  // namespace vitrail::mitsuba_writer
