// SPDX-License-Identifier: Apache-2.0
#include "cli/compare/compare_maps.h"

#include "cli/compare/compare_variances.h"
#include "compare/comparison_page.h"
#include "compare/error_images.h"
#include "compare/web_page.h"
#include "film/image_io.h"

namespace vitrail {

namespace {

// Numbers in an .exr, colours with a legend in a .png.
void write_map(const std::filesystem::path& file, const Image& numbers, const Image& colors, double scale,
               Palette palette) {
  Picture picture;
  picture.rgb = file.extension() == ".exr" ? numbers : with_legend(colors, scale, palette);
  write_picture(file, picture);
}

}  // namespace

std::vector<double> flip_map(const CompareArguments& options, const Image& image, const Image& reference) {
  if (options.metric != "flip") return {};
  return of_low_range(options) ? ldr_flip(image, reference, options.pixels_per_degree)
                               : hdr_flip(image, reference, options.pixels_per_degree);
}

void write_maps(const CompareArguments& options, const Comparison& c, const Picture& image,
                const Picture& reference) {
  const Image &a = image.rgb, &b = reference.rgb;
  if (!options.heatmap.empty()) {
    const bool flip = c.metric == Metric::flip;
    const Palette palette = flip ? Palette::magma : Palette::heat;
    const double scale =
        options.map_scale.value_or(flip || c.metric == Metric::welch ? 1 : hottest(c.error_map));
    write_map(options.heatmap, error_image(c.error_map, a.width, a.height),
              heatmap(c.error_map, a.width, a.height, scale, palette), scale, palette);
  }
  if (!options.signed_map.empty()) {
    const Image difference = signed_difference(a, b);
    const double scale = options.map_scale.value_or(hottest(error_map(a, b, absolute_error)));
    write_map(options.signed_map, difference, signed_map(difference, scale), scale, Palette::sides);
  }
  if (!options.html.empty())
    write_whole(options.html, comparison_page({options.image, options.reference, &a, &b, image.window.x0,
                                               image.window.y0, options.pixels_per_degree,
                                               neighbours_of_mean(image, reference), of_low_range(options)}));
}

}  // namespace vitrail
