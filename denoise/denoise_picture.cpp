// SPDX-License-Identifier: Apache-2.0
#include "denoise/denoise_picture.h"

#include <algorithm>

#include "scene/records/film_layers.h"

namespace vitrail {

namespace {

// 0 × 0 where the picture does not have all three.
Image layer_of(const Picture& picture, Layer layer) {
  Image image = black_image(picture.rgb.width, picture.rgb.height, 3);
  for (std::size_t c = 0; c < 3; ++c) {
    const auto found = std::ranges::find(picture.layers, kind_of(layer).channels[c], &PictureChannel::name);
    if (found == picture.layers.end()) return {};
    for (std::size_t p = 0; p < image.pixels(); ++p) image.values[3 * p + c] = found->values[p];
  }
  return image;
}

// Each bin by itself, as a grey picture: the bins at the ends of the spectrum have few samples, and their
// noise would be taken for light of their neighbours.
void denoise_spectrum(Image& spectrum, const Denoiser& denoiser, const DenoiserGuides& guides) {
  const auto bins = static_cast<std::size_t>(spectrum.channels);
  Image grey = black_image(spectrum.width, spectrum.height, 3);
  for (std::size_t bin = 0; bin < bins; ++bin) {
    for (std::size_t i = 0; i < grey.values.size(); ++i)
      grey.values[i] = spectrum.values[bins * (i / 3) + bin];
    const Image clean = denoiser.denoised(grey, guides);
    for (std::size_t p = 0; p < clean.pixels(); ++p) {
      const float* rgb = &clean.values[3 * p];
      spectrum.values[bins * p + bin] = (rgb[0] + rgb[1] + rgb[2]) / 3;
    }
  }
}

}  // namespace

DenoiserGuides guides_of(const Picture& picture) {
  DenoiserGuides guides{layer_of(picture, Layer::albedo), layer_of(picture, Layer::shading_normal)};
  if (guides.normals.pixels() == 0) guides.normals = layer_of(picture, Layer::geometric_normal);
  return guides;
}

void denoise(Picture& picture, const Denoiser& denoiser) {
  const DenoiserGuides guides = denoiser.denoised(guides_of(picture));
  picture.rgb = denoiser.denoised(picture.rgb, guides);
  if (picture.spectrum.pixels() > 0) denoise_spectrum(picture.spectrum, denoiser, guides);
  picture.variance = {};
  picture.shared_error = 0;
  picture.origin.denoiser = denoiser.name();
}

}  // namespace vitrail
