// SPDX-License-Identifier: Apache-2.0
// `render --quality` says what a picture is to be good for; these are the options that get it there.
// docs/why/adaptive.md has the measurements that the numbers come from.
#pragma once

#include <string>
#include <vector>

#include "farm/plan/options.h"

namespace vitrail {

// Returns the names, the quickest first.
std::vector<std::string> qualities();

// Fills in what the user does not give: the error, the most samples a pixel, and, unless `adaptive_is_given`,
// whether samples are adaptive. `quality` is one of the names. The film of a picture that is `denoised`
// afterwards may be noisier.
void apply_quality(const std::string& quality, bool adaptive_is_given, bool denoised, RenderOptions& options);

}  // namespace vitrail
