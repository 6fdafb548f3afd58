// SPDX-License-Identifier: Apache-2.0
#include "cli/compare/compare_arguments.h"

#include <algorithm>
#include <iterator>

#include "cli/common/memory_budget.h"
#include "cli/common/number_checks.h"
#include "compare/comparison.h"

namespace vitrail {

void declare(CLI::App& app, CompareArguments& o) {
  app.add_option("IMAGE", o.image, "image or .film")->required();
  app.add_option("REFERENCE", o.reference, "image or .film")->required();
  app.add_option("--metric", o.metric,
                 "relmse, mse, rmse, mae, psnr, smape, flip, ssim, ztest or bitwise; welch: whether two "
                 "films could have the same expectation, by t-tests of tiles")
      ->check(CLI::IsMember(metric_names()))
      ->capture_default_str();
  app.add_option(
      "--variance", o.variance,
      "for ztest: the reference's variances. Either Variance.Y of develop --variance, or NAME_var.exr of "
      "Mitsuba's tests, the variances of one sample: X, Y and Z are then tested apart");
  app.add_option("--variance-samples", o.variance_samples,
                 "samples a pixel of IMAGE; default: as the file says");
  app.add_option(
      "--mean-within", o.mean_within,
      "exit with 1 if the mean of X, Y or Z is off by more than this fraction. Without this option, ztest "
      "fails where chance explains the difference of the means less than once in 10,000 times");
  app.add_option("--ignore", o.ignored,
                 "leave out this rectangle: x0,x1,y0,y1 in pixels from the whole picture's top left")
      ->allow_extra_args(false);
  app.add_option("--mask", o.mask, "leave out the pixels that are black in this image");
  app.add_option("--fail-above", o.fail_above, "exit with 1 if the value is greater");
  app.add_flag("--resize", o.resized, "resize IMAGE to the size of REFERENCE");
  app.add_flag("--json", o.json, "print one JSON object");
  declare_memory(app, o.memory);
  app.add_flag("--strict", o.strict, "refuse films that are not finished");
  app.add_flag("--quiet", o.quiet, "say nothing; the exit status does");
  app.add_option("--worst", o.worst, "list this many of the worst pixels")->capture_default_str();
  app.add_option(
      "--heatmap", o.heatmap,
      "write the error of each pixel: as numbers (.exr), or as colours (.png) from black (0) over red and "
      "yellow to white, for flip by magma. For ssim the error is 1 - ssim, for welch 1 - p");
  app.add_flag("--force", o.force, "replace files that vitrail did not make");
  app.add_option("--html", o.html,
                 "write one page for a browser: both images and their errors, to flip, split, zoom and "
                 "expose, with all metrics");
  app.add_option("--flip-range", o.flip_range,
                 "how FLIP sees the images: ldr: as a screen shows them; hdr: at all exposures that show "
                 "something; auto: ldr where both files have 8 or 16 bits")
      ->check(CLI::IsMember({"auto", "ldr", "hdr"}))
      ->capture_default_str();
  app.add_option("--pixels-per-degree", o.pixels_per_degree,
                 "of flip: pixels a degree of the viewer's field of vision; default: a screen 0.7 m wide of "
                 "3840 pixels, 0.7 m away")
      ->check(more_than_0)
      ->capture_default_str();
  app.add_option(
      "--signed-map", o.signed_map,
      "write image - reference: as numbers (.exr), or as colours, blue where the image is darker, red "
      "where it is brighter (.png)");
  app.add_option(
         "--map-scale", o.map_scale,
         "the error that is white, or full blue and red; default: the 99th percentile, for flip and welch 1")
      ->check(more_than_0);
}

bool of_low_range(const CompareArguments& o) {
  if (o.flip_range != "auto") return o.flip_range == "ldr";
  constexpr const char* of_integers[] = {".png", ".jpg", ".jpeg", ".tif", ".tiff", ".bmp", ".tga"};
  const auto shown = [&](const std::filesystem::path& file) {
    return std::ranges::find(of_integers, file.extension().string()) != std::end(of_integers);
  };
  return shown(o.image) && shown(o.reference);
}

}  // namespace vitrail
