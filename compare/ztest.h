// SPDX-License-Identifier: Apache-2.0
// The z-test asks whether an image is a sample of what the reference shows. It is a two-sided test of each
// value, corrected for the number of pixels after Šidák (1967). A small fraction of values may fail, since
// estimated variances miss rare bright paths. The rule is that of Mitsuba's renderer tests.
//
// A film estimates each pixel's variance from two groups of samples. With one degree of freedom Student's
// distribution has long tails: one pixel of 10⁴ would have to be off by 10⁵ σ to be found. So estimates are
// pooled over a neighbourhood first (variance.h). That leaves about 49 degrees of freedom and takes 6 σ.
#pragma once

#include <cstddef>
#include <vector>

#include "scene/records/image.h"

namespace vitrail {

inline constexpr double ztest_significance = 0.01;
inline constexpr double ztest_tolerated = 0.0025;  // fraction of values that may fail
// The mean of all pixels shows differences that the noise of each pixel hides. One of 10,000 equal pictures
// fails this test.
inline constexpr double ztest_mean_significance = 1e-4;

// A ZTestInput holds two images and the variances of the difference of their means.
struct ZTestInput {
  const Image* image = nullptr;
  const Image* reference = nullptr;
  // It is that of image − reference: one value a pixel, of its luminance, or three, of its X, Y and Z.
  std::vector<double> variance;
  // z of each pixel has Student's distribution with so many degrees of freedom, where the variance is an
  // estimate. Empty means the normal distribution, where the variances are known well.
  std::vector<int> degrees_of_freedom;
  // It is the standard error of the ratio of the means that all pixels have in common, of both images
  // together; 0 where pixels are independent.
  double shared_error = 0;
  // It is the variance of a mean over pixels, over that of independent pixels (film/neighbours.h).
  double neighbours_of_mean = 1;
};

// A ZTest holds what the test found.
struct ZTest {
  std::vector<double> z;          // the greatest |z| of each pixel; NaN where either image is not finite
  std::size_t values = 0;         // tested: pixels × (1 or 3)
  std::size_t failed = 0;         // of them, the non-finite ones among them
  double value_significance = 0;  // after the correction
  // It counts the standard errors by which the means differ, of luminance or the worst of X, Y
  // and Z. What rounding the reference to half floats can make is taken off first. means_differ
  // says whether it is too many.
  double mean_sigmas = 0;
  bool means_differ = false;
  double noise_rms = 0, difference_rms = 0;  // of luminance: expected of the variances, and found
};

// Tests z = (a − b)/√variance for luminance, or for X, Y and Z; z is 0 for equal values.
ZTest ztest(const ZTestInput& input);

// Returns P(|T| > t) for Student's distribution with ν degrees of freedom (Abramowitz & Stegun 1964, 26.7.3
// and 26.7.4); for the normal distribution where ν = 0.
double two_sided_p(double t, int degrees_of_freedom);

}  // namespace vitrail
