// SPDX-License-Identifier: Apache-2.0
// These functions read what stands behind the words of fractals and slopes.
#pragma once

#include "importers/povray/read/surface.h"

namespace vitrail::pov {

// Reads behind mandel, julia or magnet: its kind, its seed and the number of iterations.
void read_fractal(Reader& reader, Word word, Pattern& pattern);
// Reads behind `exterior` or `interior`: how points are numbered, and a factor.
void read_fractal_color(Reader& reader, PatternFractal::Color& color, double& factor);
// Reads behind `slope`, in braces or without.
void read_slope(Reader& reader, Pattern::Slope& slope);

}  // namespace vitrail::pov
