// SPDX-License-Identifier: Apache-2.0
// vitrail compare: how far an image is from a reference, and whether that is too far.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "cli/main_guard.h"
#include "cli/rectangle.h"
#include "compare/comparison.h"
#include "compare/mask.h"
#include "compare/variance.h"
#include "film/image_io.h"
#include "scene/diagnostics.h"

using namespace vitrail;

namespace {

struct Options {
  std::string image, reference, metric = "relmse", variance, mask, heatmap;
  std::vector<std::string> ignored;
  std::optional<double> variance_samples, fail_above, mean_within;
  bool json = false;
};

// An image, or a film developed in memory.
Picture load(const std::string& file) {
  if (std::filesystem::path(file).extension() != ".film") return read_picture(file);
  try {
    return develop(read_film(file, nullptr));
  } catch (const Error& e) {
    throw Error(e.what(), {file});
  }
}

// A variance that was estimated from the groups of a film.
EstimatedVariance estimated_variance(const Picture& picture) {
  constexpr int most = sample_groups;
  const int groups = picture.samples_per_pixel == 0 ? most : std::min(picture.samples_per_pixel, most);
  if (groups < 2)
    throw Error("a film of one sample a pixel knows nothing of its variance; render it with at least 2");
  const std::vector<float>& values = picture.variance.values;
  if (std::any_of(values.begin(), values.end(), [](float v) { return !(v >= 0); }))
    throw Error("a variance is negative or not a number");
  return {&picture.variance, groups - 1};
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

void find_variances(ZTestInput& test, const Picture& image, const Picture& reference,
                    const Options& options) {
  const std::string& file = options.variance;
  if (image.variance.pixels() + reference.variance.pixels() == 0 && file.empty())
    throw UsageError("ztest needs a variance: give --variance, a film, or an image of develop --variance");
  Picture given;
  if (!file.empty()) {
    given = read_picture(file);
    require_same_size(given.rgb, reference.rgb);
    if (count_nonfinite(given.rgb) > 0) throw Error("a variance is not a number", {file});
    if (given.variance.pixels() == 0)
      return add_mitsuba_variance(test, given.rgb, image, options.variance_samples);
  }
  std::vector<EstimatedVariance> parts;
  for (const Picture* picture : {&image, file.empty() ? &reference : &given})
    if (picture->variance.pixels() > 0) parts.push_back(estimated_variance(*picture));
  PooledVariance known = pooled(parts);
  test.variance = std::move(known.variance);
  test.degrees_of_freedom = std::move(known.degrees_of_freedom);
  add_rounding(test.variance, reference.rgb);
}

Mask mask_of(const Options& options, const Image& image) {
  std::vector<PixelRect> ignored;
  for (const std::string& text : options.ignored) ignored.push_back(parse_rectangle("--ignore", text));
  return make_mask(image.width, image.height, ignored,
                   options.mask.empty() ? Image{} : read_picture(options.mask).rgb);
}

int run(const Options& options) {
  const std::optional<Metric> metric = metric_of(options.metric);
  if (metric == Metric::psnr && options.fail_above)
    throw UsageError("psnr grows as images get closer: use --metric mse with --fail-above");
  const Picture image = load(options.image), reference = load(options.reference);
  require_same_size(image.rgb, reference.rgb);
  const Mask mask = mask_of(options, image.rgb);
  ZTestInput test{&image.rgb, &reference.rgb, {}, {}};
  if (metric == Metric::ztest) find_variances(test, image, reference, options);
  const Image image_part = without(image.rgb, mask), reference_part = without(reference.rgb, mask);
  test = {&image_part, &reference_part, without(test.variance, mask), without(test.degrees_of_freedom, mask)};
  Comparison comparison = compare(test, *metric, options.fail_above, options.mean_within);
  fmt::print("{}", options.json ? to_json(comparison) : to_text(comparison));
  if (!options.heatmap.empty()) {
    comparison.error_map = spread(comparison.error_map, mask);
    Picture picture;
    picture.rgb = heatmap(comparison, image.rgb.width, image.rgb.height);
    write_picture(options.heatmap, picture);
  }
  return comparison.passed ? exit_done : exit_differs;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Compares an image with a reference; films are developed in memory.", "vitrail compare");
  Options options;
  app.add_option("IMAGE", options.image, "image or .film")->required();
  app.add_option("REFERENCE", options.reference, "image or .film")->required();
  app.add_option("--metric", options.metric, "relmse, mse, mae, psnr, smape, ztest or bitwise")
      ->check(CLI::IsMember(metric_names()))
      ->capture_default_str();
  app.add_option(
      "--variance", options.variance,
      "for ztest: the reference's Variance.Y of develop --variance, or the variances of one sample "
      "that Mitsuba's tests keep as NAME_var.exr: then X, Y and Z are tested apart");
  app.add_option("--variance-samples", options.variance_samples,
                 "samples a pixel that IMAGE has; default: as it says");
  app.add_option("--mean-within", options.mean_within,
                 "exit with 1 if the mean of X, Y or Z is off by more than this fraction");
  app.add_option("--ignore", options.ignored, "x0,x1,y0,y1 in pixels from the top left: left out")
      ->allow_extra_args(false);
  app.add_option("--mask", options.mask, "an image; pixels that are black in it are left out");
  app.add_option("--fail-above", options.fail_above, "exit with 1 if the value is greater");
  app.add_flag("--json", options.json, "print one flat JSON object");
  app.add_option("--heatmap", options.heatmap, "write the error of each pixel as an image");
  return run_guarded(app, argc, argv, [&] { return run(options); });
}
