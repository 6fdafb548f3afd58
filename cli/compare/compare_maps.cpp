// SPDX-License-Identifier: Apache-2.0
#include "cli/compare/compare_maps.h"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "cli/compare/compare_variances.h"
#include "compare/comparison_page.h"
#include "compare/error_images.h"
#include "compare/web_page.h"
#include "film/image_io.h"
#include "film/renderer_version.h"

namespace vitrail {

namespace {

// Numbers in an .exr, colours with a legend in a .png.
void write_map(const std::filesystem::path& file, const Image& numbers, const Image& colors, double scale,
               Palette palette) {
  Picture picture;
  picture.rgb = file.extension() == ".exr" ? numbers : with_legend(colors, scale, palette);
  picture.origin.software = to_string(this_renderer());
  write_picture(file, picture);
}

const std::vector<float>* alpha_of(const Picture& picture) {
  const auto found = std::ranges::find(picture.layers, "A", &PictureChannel::name);
  return found == picture.layers.end() ? nullptr : &found->values;
}

}  // namespace

std::vector<double> alpha_differences(const Picture& image, const Picture& reference) {
  const auto *a = alpha_of(image), *b = alpha_of(reference);
  if (!a || !b || a->size() != b->size()) return {};
  std::vector<double> differs(a->size());
  for (std::size_t p = 0; p < differs.size(); ++p)
    differs[p] = std::bit_cast<std::uint32_t>((*a)[p]) != std::bit_cast<std::uint32_t>((*b)[p]) ? 1 : 0;
  return differs;
}

std::vector<double> given_map(const CompareArguments& options, const Picture& image,
                              const Picture& reference) {
  if (options.metric == "bitwise") return alpha_differences(image, reference);
  if (options.metric != "flip") return {};
  return of_low_range(options) ? ldr_flip(image.rgb, reference.rgb, options.pixels_per_degree)
                               : hdr_flip(image.rgb, reference.rgb, options.pixels_per_degree);
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
