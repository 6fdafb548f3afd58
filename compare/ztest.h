// SPDX-License-Identifier: Apache-2.0
// Is an image a sample of what the reference shows? A two-sided test of each value, corrected for the number
// of pixels after Šidák (1967); a small fraction of values may fail, since estimated variances miss rare
// bright paths. The rule is that of Mitsuba's renderer tests.
//
// A film estimates each pixel's variance from two groups of samples. With one degree of freedom Student's
// distribution has tails so long that one pixel of 10⁴ would have to be off by 10⁵ σ to be found; so
// estimates are pooled over a neighbourhood first (variance.h), which leaves about 49 and asks for 6 σ.
#pragma once

#include <cstddef>
#include <vector>

#include "scene/image.h"

namespace vitrail {

inline constexpr double ztest_significance = 0.01;
inline constexpr double ztest_tolerated = 0.0025;  // fraction of values that may fail

struct ZTestInput {
  const Image* image = nullptr;
  const Image* reference = nullptr;
  // Of image − reference: one value a pixel, of its luminance, or three, of its X, Y and Z.
  std::vector<double> variance;
  // z's distribution in each pixel: Student's with so many degrees of freedom, where the variance is an
  // estimate. Empty: the normal distribution, where the variances are known well.
  std::vector<int> degrees_of_freedom;
};

struct ZTest {
  std::vector<double> z;          // the greatest |z| of each pixel; NaN where either image is not finite
  std::size_t values = 0;         // tested: pixels × (1 or 3)
  std::size_t failed = 0;         // of them, the non-finite ones among them
  double value_significance = 0;  // after the correction
};

// z = (a − b)/√variance of luminance, or of X, of Y and of Z; 0 for equal values.
ZTest ztest(const ZTestInput& input);

// P(|T| > t) for Student's distribution with ν degrees of freedom (Abramowitz & Stegun 1964, 26.7.3
// and 26.7.4); the normal distribution for ν = 0.
double two_sided_p(double t, int degrees_of_freedom);

}  // namespace vitrail
