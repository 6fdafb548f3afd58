// SPDX-License-Identifier: Apache-2.0
#include "importers/pbrt/read/sphere_images.h"

#include <fmt/format.h>

#include <optional>

#include "images/image_files.h"

namespace vitrail::pbrt {

namespace {

std::optional<ImageLayout> layout_of(const std::string& filename) {
  try {
    return read_image_layout(filename);
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace

void expect_map_of_sphere(const std::string& filename, const Parameter& parameter, const Context& context) {
  if (context.version == Version::v3) return;
  const std::optional<ImageLayout> layout = layout_of(filename);
  if (!layout || layout->width == layout->height) return;
  fail(fmt::format("the image has {} × {} pixels, but pbrt-v4 takes square ones, by an equal-area map of the "
                   "sphere: of one by longitude and latitude, pbrt's `imgtool makeequiarea IN --outfile OUT` "
                   "makes it{}",
                   layout->width, layout->height,
                   context.version_is_certain
                       ? ""
                       : "; if the scene is of pbrt-v3, which takes longitude and latitude, end it with "
                         "WorldEnd to say so"),
       parameter.place);
}

}  // namespace vitrail::pbrt
