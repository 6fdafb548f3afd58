// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "measure/session.h"

namespace vitrail {

// A bias that is too uncertain is measured again with 4 times the samples, up to this
// many times those of the axes.
constexpr int most_samples_factor = 16;

// A recommended setting was rendered with these samples, or so many times more or less, unless that would
// take longer than the whole measurement may.
constexpr double most_unrendered_factor = 1.25;

// Returns the most measurements that `recommend` makes, each of all seeds.
int most_searched(const MeasureOptions& options);

// Adds the recommendations that the options ask for, else those for the error, and for the time, of the
// scene's own setting and samples. The setting that looks best is measured before it is recommended, and
// joins `m.settings`. This is a search, best first, over all combinations of the axes that change the
// picture. It ends where the best was measured, its bias is known well enough beside the error, and it was
// rendered with the recommended samples. A setting is left out if it changes the picture's mean light by
// more than the options allow, or may.
void recommend(Measurement& m, Session& session, const MeasureOptions& options);

}  // namespace vitrail
