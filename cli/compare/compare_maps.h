// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cli/compare/compare_arguments.h"
#include "compare/comparison.h"
#include "film/develop.h"

namespace vitrail {

// FLIP of each pixel, where that is the metric; else empty.
std::vector<double> flip_map(const CompareArguments& arguments, const Image& image, const Image& reference);

// What --heatmap, --signed-map and --html ask for. The comparison's map has a value a pixel of the images.
void write_maps(const CompareArguments& arguments, const Comparison& comparison, const Picture& image,
                const Picture& reference);

}  // namespace vitrail
