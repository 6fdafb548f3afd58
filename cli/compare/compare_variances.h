// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "compare/welch.h"
#include "compare/ztest.h"
#include "film/develop.h"

namespace vitrail {

// Finds the variances of a z-test: those that the pictures know of themselves, or those of a file ("": none).
// A file has the reference's of develop --variance, or Mitsuba's of one sample. For that, IMAGE has to say or
// `samples` to be how many samples a pixel it has. Throws UsageError and Error.
void find_variances(ZTestInput& test, const Picture& image, const Picture& reference, const std::string& file,
                    std::optional<double> samples);

// Returns of_mean of the pictures' difference: by the noise of each where both know it, else the greater.
double neighbours_of_mean(const Picture& image, const Picture& reference);

// Throws UsageError unless both know the variances of their pixels.
WelchTest welch_test_of(const Picture& image, const Picture& reference);

}  // namespace vitrail
