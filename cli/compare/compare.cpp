// SPDX-License-Identifier: Apache-2.0
// vitrail compare: how far an image is from a reference, and whether that is too far.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "cli/common/input_kind.h"
#include "cli/common/main_guard.h"
#include "cli/common/memory_budget.h"
#include "cli/common/own_output.h"
#include "cli/common/rectangle.h"
#include "cli/compare/compare_arguments.h"
#include "cli/compare/compare_maps.h"
#include "cli/compare/compare_variances.h"
#include "compare/alignment.h"
#include "compare/comparison.h"
#include "compare/mask.h"
#include "film/film_progress.h"
#include "film/image_io.h"
#include "film/own_picture.h"
#include "film/picture_extent.h"
#include "scene/system/diagnostics.h"
#include "scene/system/input_files.h"
#include "scene/system/output_place.h"
#include "scene/system/say.h"
#include "scene/system/within_memory.h"

using namespace vitrail;

namespace {

// An image, or a film that is developed.
Picture load(const std::string& file, const CompareArguments& options) {
  if (std::filesystem::path(file).extension() != ".film") return read_picture(file);
  note_input(file);
  try {
    FilmProgress progress;
    const FilmRows film(file, &progress);
    if (!progress.complete() && options.strict) throw Error("the film is not finished", {});
    if (!progress.complete() && !options.quiet) say("vitrail: {}: the film is not finished\n", file);
    Picture picture = develop(film);
    picture.neighbours = neighbours_of(progress.about);
    return picture;
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
Mask mask_of(const CompareArguments& options, const Picture& image) {
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

// In its place.
void resize_to(Picture& image, const Picture& reference) {
  const Image& size = reference.rgb;
  if (image.rgb.width != size.width || image.rgb.height != size.height)
    resize(image, size.width, size.height);
  image.window = reference.window;
  image.full_width = reference.full_width, image.full_height = reference.full_height;
}

int run(const CompareArguments& options) {
  const std::optional<Metric> metric = metric_of(options.metric);
  if ((metric == Metric::psnr || metric == Metric::ssim) && options.fail_above)
    throw UsageError(fmt::format("{} grows as images get closer: use --metric mse or flip with --fail-above",
                                 options.metric));
  if (metric == Metric::welch && (!options.ignored.empty() || !options.mask.empty()))
    throw UsageError("welch tests tiles of pixels that lie together: not with --ignore or --mask");
  for (const std::filesystem::path& file : {options.heatmap, options.signed_map, options.html})
    if (!file.empty()) require_place(file);
  require_own(options.heatmap, is_own_picture, options.force);
  require_own(options.signed_map, is_own_picture, options.force);
  require_own_texts({options.html}, options.force);
  for (const std::string* file : {&options.image, &options.reference})
    require_input(*file, {InputKind::picture, InputKind::film});
  Picture image = load(options.image, options), reference = load(options.reference, options);
  if (options.resized) resize_to(image, reference);
  align(image, reference);
  const Mask mask = mask_of(options, image);
  ZTestInput test{&image.rgb, &reference.rgb, {}, {}, 0, 1};
  if (metric == Metric::ztest)
    find_variances(test, image, reference, options.variance, options.variance_samples);
  const Image image_part = without(image.rgb, mask), reference_part = without(reference.rgb, mask);
  test = {&image_part,
          &reference_part,
          without(test.variance, mask),
          without(test.degrees_of_freedom, mask),
          std::hypot(image.shared_error, reference.shared_error),
          neighbours_of_mean(image, reference)};
  Comparison comparison =
      compare(test, *metric, options.fail_above, options.mean_within,
              without(given_map(options, image, reference), mask),
              metric == Metric::welch ? std::optional(welch_test_of(image, reference)) : std::nullopt);
  const std::vector<double> alphas = without(alpha_differences(image, reference), mask);
  comparison.other_alphas = static_cast<std::uint64_t>(std::ranges::count(alphas, 1.0));
  const std::size_t compared = comparison.error_map.size();
  const std::vector<double> map = spread(comparison.error_map, mask);
  comparison.worst =
      worst_pixels(map, image.rgb, reference.rgb, image.window.x0, image.window.y0, options.worst);
  if (options.json)
    show("{}", to_json(comparison));
  else if (!options.quiet)
    show("{}{}", about_part(image, compared), to_text(comparison));
  comparison.error_map = map;
  write_maps(options, comparison, image, reference);
  return comparison.passed ? exit_done : exit_differs;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Compares an image with a reference; films are developed in memory.", "vitrail compare");
  CompareArguments arguments;
  declare(app, arguments);
  return run_guarded(app, argc, argv, [&] {
    const std::uint64_t bytes = memory_budget(arguments.memory, arguments.quiet || arguments.json);
    return within_memory(bytes, {"comparing"}, [&] { return run(arguments); });
  });
}
