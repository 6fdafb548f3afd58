// SPDX-License-Identifier: Apache-2.0
#include "importers/images/mean_intensity.h"

#include <algorithm>
#include <numbers>

#include "images/image_files.h"
#include "images/texture_values.h"
#include "importers/images/environment_images.h"

namespace vitrail {

MeanIntensity mean_intensity(const GoniometricLight& light) {
  const auto projection = light.latitude_longitude ? EnvironmentProjection::latitude_longitude
                                                   : EnvironmentProjection::equal_area;
  const Image image = texture_values(image_of(light), read_stored_image(light.filename), ImageUse::number);
  constexpr double sphere = 4 * std::numbers::pi;
  const double flux = total_flux(image, projection);
  const double factor = light.power && flux > 0 ? static_cast<double>(*light.power) / flux : 1;
  const double greatest =
      image.values.empty() ? 0 : static_cast<double>(*std::ranges::max_element(image.values));
  return {factor * flux / sphere, factor * greatest};
}

}  // namespace vitrail
