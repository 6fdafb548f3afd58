// SPDX-License-Identifier: Apache-2.0
#include "importers/pbrt/read/image_power.h"

#include "images/texture_values.h"
#include "scene/spectra/color.h"
#include "scene/system/diagnostics.h"

namespace vitrail::pbrt {

std::optional<double> mean_luminance(const ImageTexture& image) {
  try {
    const Image values = texture_values(image, read_stored_image(image.filename), ImageUse::light);
    const auto channels = static_cast<std::size_t>(values.channels);
    double sum = 0;
    for (std::size_t i = 0; i < values.pixels(); ++i) {
      const float* const v = &values.values[i * channels];
      sum += srgb_to_xyz(channels < 3 ? RGB{v[0], v[0], v[0]} : RGB{v[0], v[1], v[2]}).y;
    }
    if (sum > 0) return sum / static_cast<double>(values.pixels());
  } catch (const Error&) {
    // Whoever needs the image says what is wrong with it.
  }
  return std::nullopt;
}

}  // namespace vitrail::pbrt
