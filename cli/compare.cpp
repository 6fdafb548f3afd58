// SPDX-License-Identifier: Apache-2.0
// vitrail compare: how far an image is from a reference, and whether that is too far.
#include <fmt/format.h>

#include <filesystem>

#include "cli/compare_variances.h"
#include "cli/main_guard.h"
#include "cli/number_checks.h"
#include "cli/rectangle.h"
#include "compare/alignment.h"
#include "compare/comparison.h"
#include "compare/error_images.h"
#include "compare/mask.h"
#include "film/image_io.h"
#include "scene/diagnostics.h"
#include "scene/input_files.h"
#include "scene/output_place.h"

using namespace vitrail;

namespace {

struct Options {
  std::string image, reference, metric = "relmse", variance, mask, heatmap, signed_map;
  std::vector<std::string> ignored;
  std::optional<double> variance_samples, fail_above, mean_within, map_scale;
  std::size_t worst = 3;
  bool json = false, quiet = false, strict = false;
};

// An image, or a film developed in memory.
Picture load(const std::string& file, const Options& options) {
  if (std::filesystem::path(file).extension() != ".film") return read_picture(file);
  note_input(file);
  try {
    FilmProgress progress;
    const Film film = read_film(file, &progress);
    if (!progress.complete() && options.strict) throw Error("the film is not finished", {});
    if (!progress.complete() && !options.quiet)
      fmt::print(stderr, "vitrail: {}: the film is not finished\n", file);
    return develop(film);
  } catch (const Error& e) {
    throw Error(e.what(), {file});
  }
}

// "" where the whole pictures are compared.
std::string about_part(const Picture& image, std::size_t pixels) {
  const PixelRect& w = image.window;
  const std::size_t whole =
      static_cast<std::size_t>(image.full_width) * static_cast<std::size_t>(image.full_height);
  if (pixels == whole || whole == 0) return {};
  return fmt::format("compared {} pixels in {},{},{},{} of {} × {}\n", pixels, w.x0, w.x1, w.y0, w.y1,
                     image.full_width, image.full_height);
}

// Of the part of the whole picture that is compared.
Mask mask_of(const Options& options, const Picture& image) {
  const PixelRect& w = image.window;
  std::vector<PixelRect> ignored;
  for (const std::string& text : options.ignored) {
    const PixelRect r = parse_rectangle("--ignore", text);
    ignored.push_back({r.x0 - w.x0, r.x1 - w.x0, r.y0 - w.y0, r.y1 - w.y0});
  }
  Picture kept;
  if (!options.mask.empty()) kept = read_picture(options.mask);
  if (kept.full_width == image.full_width && kept.full_height == image.full_height) cut_to(kept, w);
  return make_mask(image.rgb.width, image.rgb.height, ignored, kept.rgb);
}

// Numbers in an .exr, colours with a legend in a .png.
void write_map(const std::string& file, const Image& numbers, const Image& colors, double scale,
               bool is_signed) {
  Picture picture;
  picture.rgb =
      std::filesystem::path(file).extension() == ".exr" ? numbers : with_legend(colors, scale, is_signed);
  write_picture(file, picture);
}

void write_maps(const Options& options, const Comparison& c, const Image& image, const Image& reference) {
  if (!options.heatmap.empty()) {
    const double scale = options.map_scale.value_or(hottest(c.error_map));
    write_map(options.heatmap, error_image(c.error_map, image.width, image.height),
              heatmap(c.error_map, image.width, image.height, scale), scale, false);
  }
  if (!options.signed_map.empty()) {
    const Image difference = signed_difference(image, reference);
    const double scale = options.map_scale.value_or(hottest(error_map(image, reference, absolute_error)));
    write_map(options.signed_map, difference, signed_map(difference, scale), scale, true);
  }
}

int run(const Options& options) {
  const std::optional<Metric> metric = metric_of(options.metric);
  if (metric == Metric::psnr && options.fail_above)
    throw UsageError("psnr grows as images get closer: use --metric mse with --fail-above");
  for (const std::string& file : {options.heatmap, options.signed_map})
    if (!file.empty()) require_place(file);
  Picture image = load(options.image, options), reference = load(options.reference, options);
  align(image, reference);
  const Mask mask = mask_of(options, image);
  ZTestInput test{&image.rgb, &reference.rgb, {}, {}};
  if (metric == Metric::ztest)
    find_variances(test, image, reference, options.variance, options.variance_samples);
  const Image image_part = without(image.rgb, mask), reference_part = without(reference.rgb, mask);
  test = {&image_part, &reference_part, without(test.variance, mask), without(test.degrees_of_freedom, mask)};
  Comparison comparison = compare(test, *metric, options.fail_above, options.mean_within);
  const std::size_t compared = comparison.error_map.size();
  const std::vector<double> map = spread(comparison.error_map, mask);
  comparison.worst =
      worst_pixels(map, image.rgb, reference.rgb, image.window.x0, image.window.y0, options.worst);
  if (options.json)
    fmt::print("{}", to_json(comparison));
  else if (!options.quiet)
    fmt::print("{}{}", about_part(image, compared), to_text(comparison));
  comparison.error_map = map;
  write_maps(options, comparison, image.rgb, reference.rgb);
  return comparison.passed ? exit_done : exit_differs;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Compares an image with a reference; films are developed in memory.", "vitrail compare");
  Options options;
  app.add_option("IMAGE", options.image, "image or .film")->required();
  app.add_option("REFERENCE", options.reference, "image or .film")->required();
  app.add_option("--metric", options.metric, "relmse, mse, rmse, mae, psnr, smape, ztest or bitwise")
      ->check(CLI::IsMember(metric_names()))
      ->capture_default_str();
  app.add_option(
      "--variance", options.variance,
      "for ztest: the reference's Variance.Y of develop --variance, or the variances of one sample "
      "that Mitsuba's tests keep as NAME_var.exr: then X, Y and Z are tested apart");
  app.add_option("--variance-samples", options.variance_samples,
                 "samples a pixel that IMAGE has; default: as it says");
  app.add_option("--mean-within", options.mean_within,
                 "exit with 1 if the mean of X, Y or Z is off by more than this fraction; without it, ztest "
                 "fails where the means differ by more than chance does once in 10,000 times");
  app.add_option("--ignore", options.ignored,
                 "x0,x1,y0,y1 in pixels from the whole picture's top left: left out")
      ->allow_extra_args(false);
  app.add_option("--mask", options.mask, "an image; pixels that are black in it are left out");
  app.add_option("--fail-above", options.fail_above, "exit with 1 if the value is greater");
  app.add_flag("--json", options.json, "print one JSON object");
  app.add_flag("--strict", options.strict, "refuse films that are not finished");
  app.add_flag("--quiet", options.quiet, "say nothing; the exit status does");
  app.add_option("--worst", options.worst, "name so many of the worst pixels")->capture_default_str();
  app.add_option(
      "--heatmap", options.heatmap,
      "write the error of each pixel: as numbers (.exr), or as colours from black (0) over red and "
      "yellow to white (.png)");
  app.add_option(
      "--signed-map", options.signed_map,
      "write image - reference: as numbers (.exr), or as colours, blue where the image is darker, red "
      "where it is brighter (.png)");
  app.add_option("--map-scale", options.map_scale,
                 "the error that is shown as white, or as full blue and red; default: the 99th percentile")
      ->check(more_than_0);
  return run_guarded(app, argc, argv, [&] { return run(options); });
}
