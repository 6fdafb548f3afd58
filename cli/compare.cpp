// SPDX-License-Identifier: Apache-2.0
// vitrail compare: how far an image is from a reference, and whether that is too far.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "cli/main_guard.h"
#include "compare/comparison.h"
#include "film/image_io.h"
#include "scene/diagnostics.h"

using namespace vitrail;

namespace {

struct Options {
  std::string image, reference, metric = "relmse", variance, heatmap;
  std::optional<double> fail_above;
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

// Adds a variance that was estimated from the groups of a film; their number bounds the degrees of freedom.
void add_estimated_variance(ZTestInput& test, const Picture& picture) {
  if (picture.variance.pixels() == 0) return;
  const int groups = picture.samples_per_pixel == 0 ? luminance_groups
                                                    : std::min(picture.samples_per_pixel, luminance_groups);
  if (groups < 2)
    throw Error("a film of one sample a pixel knows nothing of its variance; render it with at least 2");
  const std::vector<double> variance = luminance_variance(picture.variance);
  for (std::size_t p = 0; p < variance.size(); ++p) test.variance[p] += variance[p];
  test.degrees_of_freedom =
      test.degrees_of_freedom == 0 ? groups - 1 : std::min(test.degrees_of_freedom, groups - 1);
}

void find_variances(ZTestInput& test, const Picture& image, const Picture& reference,
                    const std::string& file) {
  if (image.variance.pixels() + reference.variance.pixels() == 0 && file.empty())
    throw UsageError("ztest needs a variance: give --variance, a film, or an image of develop --variance");
  test.variance.resize(image.rgb.pixels());
  add_estimated_variance(test, image);
  if (file.empty()) return add_estimated_variance(test, reference);
  const Picture given = read_picture(file);
  const Image& plane = given.variance.pixels() > 0 ? given.variance : given.rgb;
  require_same_size(plane, reference.rgb);
  const std::vector<double> variance = luminance_variance(plane);
  for (std::size_t p = 0; p < variance.size(); ++p) {
    if (!(variance[p] >= 0)) throw Error("a variance is negative or not a number", {file});
    test.variance[p] += variance[p];
  }
}

int run(const Options& options) {
  const std::optional<Metric> metric = metric_of(options.metric);
  if (metric == Metric::psnr && options.fail_above)
    throw UsageError("psnr grows as images get closer: use --metric mse with --fail-above");
  const Picture image = load(options.image), reference = load(options.reference);
  require_same_size(image.rgb, reference.rgb);
  ZTestInput test{&image.rgb, &reference.rgb, {}, 0};
  if (metric == Metric::ztest) find_variances(test, image, reference, options.variance);
  const Comparison comparison = compare(test, *metric, options.fail_above);
  fmt::print("{}", options.json ? to_json(comparison) : to_text(comparison));
  if (!options.heatmap.empty()) {
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
  app.add_option("--variance", options.variance,
                 "variances of the reference's pixels (of their means), for ztest");
  app.add_option("--fail-above", options.fail_above, "exit with 1 if the value is greater");
  app.add_flag("--json", options.json, "print one flat JSON object");
  app.add_option("--heatmap", options.heatmap, "write the error of each pixel as an image");
  return run_guarded(app, argc, argv, [&] { return run(options); });
}
