// SPDX-License-Identifier: Apache-2.0
#include "importers/images/mean_intensity.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "images/image_files.h"
#include "images/texture_values.h"
#include "importers/images/environment_images.h"
#include "scene/spectra/spectrum.h"
#include "scene/system/diagnostics.h"

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

EvenLight even_light(const GoniometricLight& light) {
  try {
    const MeanIntensity intensity = mean_intensity(light);
    return {scaled(light.intensity, intensity.mean),
            fmt::format("a goniometric light: of the same flux, equal in all directions; its brightest "
                        "direction has {:.3g} times that",
                        intensity.mean > 0 ? intensity.greatest / intensity.mean : 0)};
  } catch (const Error& error) {
    return {light.intensity, fmt::format("a goniometric light: equal in all directions: {}", error.what())};
  }
}

}  // namespace vitrail
