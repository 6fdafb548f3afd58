// SPDX-License-Identifier: Apache-2.0
// These functions make a sky for formats that have none.
#pragma once

#include <filesystem>
#include <vector>

#include "scene/records/image.h"
#include "scene/records/light.h"

namespace vitrail {

inline constexpr int sky_image_height = 512;

// Returns an image of the sky without the sun, linear sRGB, in the light's frame. It is `height` pixels high,
// twice as wide by latitude and longitude, square by equal area.
Image sky_image(const SkyLight& light, EnvironmentLight::Projection projection, int height);

// Returns the sun alone as parallel light of its irradiance.
DistantLight sun_of(const SkyLight& light);

// Returns the sky as an image, which it writes to `file` (.exr), and the sun as parallel light of its
// irradiance; what is dark is left out.
std::vector<LightModel> sky_as_image(const SkyLight& light, EnvironmentLight::Projection projection,
                                     const std::filesystem::path& file);

}  // namespace vitrail
