// SPDX-License-Identifier: Apache-2.0
// `render --quality`: what a picture is to be good for, as the options that get it there.
// docs/why/adaptive.md has the measurements that the numbers come from.
#pragma once

#include <string>
#include <vector>

#include "farm/plan/options.h"

namespace vitrail {

// Names, the quickest first.
std::vector<std::string> qualities();

// Fills in what is not asked for by itself: the error, the most samples a pixel, and, unless
// `adaptive_is_given`, whether samples are adaptive. `quality` is one of the names. Of a picture that is
// `denoised` afterwards the film may be noisier.
void apply_quality(const std::string& quality, bool adaptive_is_given, bool denoised, RenderOptions& options);

}  // namespace vitrail
