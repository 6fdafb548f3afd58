// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cli/compare/compare_arguments.h"
#include "compare/comparison.h"
#include "film/develop.h"

namespace vitrail {

// Returns 1 for each pixel whose alpha differs, if both pictures have it; else empty.
std::vector<double> alpha_differences(const Picture& image, const Picture& reference);

// This is what `compare` takes beside the colours of each pixel: FLIP where that is the metric; for bitwise,
// 1 where alpha differs, if both pictures have it. Else it is empty.
std::vector<double> given_map(const CompareArguments& arguments, const Picture& image,
                              const Picture& reference);

// Writes what --heatmap, --signed-map and --html ask for. The comparison's map has a value a pixel.
void write_maps(const CompareArguments& arguments, const Comparison& comparison, const Picture& image,
                const Picture& reference);

}  // namespace vitrail
