// SPDX-License-Identifier: Apache-2.0
#include "cli/compare/compare_variances.h"

#include <algorithm>
#include <cmath>

#include "compare/metrics.h"
#include "compare/variance.h"
#include "film/image_io.h"
#include "film/picture_extent.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

// A variance that was estimated from the groups of a film.
EstimatedVariance estimated_variance(const Picture& picture) {
  constexpr int most = sample_groups;
  const int groups = picture.samples_per_pixel == 0 ? most : std::min(picture.samples_per_pixel, most);
  if (groups < 2)
    throw Error("a film of one sample a pixel knows nothing of its variance; render it with at least 2");
  const std::vector<float>& values = picture.variance.values;
  if (std::any_of(values.begin(), values.end(), [](float v) { return !(v >= 0); }))
    throw Error("a variance is negative or not a number");
  return {&picture.variance, groups - 1, picture.neighbours.of_variances};
}

// Of the mean that a picture of `samples` has, after Mitsuba's image of the variance of one; the image's own,
// where it is known, counts where it is larger.
void add_mitsuba_variance(ZTestInput& test, const Image& of_sample, const Picture& image,
                          std::optional<double> samples) {
  if (!samples && image.samples_per_pixel > 0) samples = image.samples_per_pixel;
  if (!samples)
    throw UsageError("the image does not say how many samples a pixel has: give --variance-samples");
  test.variance = mitsuba_variance(of_sample, *samples);
  if (image.variance.pixels() == 0) return;
  const EstimatedVariance own = estimated_variance(image);
  widen(test.variance, pooled(std::span(&own, 1)).variance);
}

}  // namespace

double neighbours_of_mean(const Picture& image, const Picture& reference) {
  const auto noise = [](const Picture& picture) {
    double sum = 0;
    for (const float v : picture.variance.values)
      if (std::isfinite(v)) sum += static_cast<double>(v);
    return sum;
  };
  const double a = image.neighbours.of_mean, b = reference.neighbours.of_mean, of_a = noise(image),
               of_b = noise(reference);
  return of_a > 0 && of_b > 0 ? (a * of_a + b * of_b) / (of_a + of_b) : std::max(a, b);
}

WelchTest welch_test_of(const Picture& image, const Picture& reference) {
  const auto tested = [](const Picture& picture) {
    if (picture.variance.pixels() == 0)
      throw UsageError("welch needs the variances of both: give films, or images of develop --variance");
    const EstimatedVariance v = estimated_variance(picture);
    return WelchPicture{&picture.rgb, v.variance, picture.neighbours.of_mean, v.neighbours_of_variances};
  };
  return welch_test(tested(image), tested(reference));
}

void find_variances(ZTestInput& test, const Picture& image, const Picture& reference, const std::string& file,
                    std::optional<double> samples) {
  if (image.variance.pixels() + reference.variance.pixels() == 0 && file.empty())
    throw UsageError("ztest needs a variance: give --variance, a film, or an image of develop --variance");
  Picture given;
  if (!file.empty()) {
    given = read_picture(file);
    if (given.full_width == reference.full_width && given.full_height == reference.full_height)
      cut_to(given, reference.window);
    require_same_size(given.rgb, reference.rgb);
    if (count_nonfinite(given.rgb) > 0) throw Error("a variance is not a number", {file});
    if (given.variance.pixels() == 0) return add_mitsuba_variance(test, given.rgb, image, samples);
  }
  std::vector<EstimatedVariance> parts;
  for (const Picture* picture : {&image, file.empty() ? &reference : &given})
    if (picture->variance.pixels() > 0) parts.push_back(estimated_variance(*picture));
  PooledVariance known = pooled(parts);
  test.variance = std::move(known.variance);
  test.degrees_of_freedom = std::move(known.degrees_of_freedom);
  add_rounding(test.variance, reference.rgb);
}

}  // namespace vitrail
