// SPDX-License-Identifier: Apache-2.0
// Is an image a sample of what the reference shows? A two-sided test of each pixel's luminance, corrected for
// their number after Šidák (1967); a small fraction of pixels may fail, since estimated variances miss rare
// bright paths. The rule is that of Mitsuba's renderer tests.
#pragma once

#include <cstddef>
#include <vector>

#include "scene/image.h"

namespace vitrail {

inline constexpr double ztest_significance = 0.01;
inline constexpr double ztest_tolerated = 0.0025;  // fraction of pixels that may fail

// The distribution of z: Student's with this many degrees of freedom, since a film estimates its variance
// from a few groups of samples; 0 for the normal distribution, where the variances are known well.
struct ZTestInput {
  const Image* image = nullptr;
  const Image* reference = nullptr;
  std::vector<double> variance;  // of image − reference, one value a pixel
  int degrees_of_freedom = 0;
};

struct ZTest {
  std::vector<double> z;          // |z| of each pixel; NaN where either image is not finite
  std::size_t failed = 0;         // pixels, the non-finite ones among them
  double pixel_significance = 0;  // after the correction
};

// z = (Y_a − Y_b)/√(variance + r²), where r is the rounding of a half float of the reference's luminance, as
// many references are stored.
ZTest ztest(const ZTestInput& input);

// The luminance variance of a pixel from a variance image: its one channel, or, where only variances of R, G
// and B are known, the most they allow, (Σ wᵢσᵢ)² with the luminance weights wᵢ.
std::vector<double> luminance_variance(const Image& variance);

// P(|T| > t) for Student's distribution with ν degrees of freedom (Abramowitz & Stegun 1964, 26.7.3
// and 26.7.4); the normal distribution for ν = 0.
double two_sided_p(double t, int degrees_of_freedom);

}  // namespace vitrail
