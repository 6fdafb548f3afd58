// SPDX-License-Identifier: Apache-2.0
#include "importers/images/sky_image.h"

#include "images/image_files.h"
#include "importers/images/environment_images.h"
#include "scene/daylight/sky_model.h"
#include "scene/records/pixel_place.h"
#include "scene/spectra/color.h"

namespace vitrail {

namespace {

// The colours of the bands' hat functions: one of a spectrum is their sum.
std::array<XYZ, sky_bands> colors_of_bands() {
  std::array<XYZ, sky_bands> colors;
  for (std::size_t b = 0; b < sky_bands; ++b) {
    std::array<double, sky_bands> one{};
    one[b] = 1;
    colors[b] = to_xyz(spectrum_of_bands(one));
  }
  return colors;
}

}  // namespace

Image sky_image(const SkyLight& light, EnvironmentLight::Projection projection, int height) {
  const SkyModel model(light);
  const auto colors = colors_of_bands();
  const int width = projection == EnvironmentLight::Projection::equal_area ? height : 2 * height;
  Image image = black_image(width, height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto bands = model.sky(direction_of(projection, pixel_point(projection, width, height, x, y)));
      XYZ sum;
      for (std::size_t b = 0; b < sky_bands; ++b) {
        sum.x += bands[b] * colors[b].x;
        sum.y += bands[b] * colors[b].y;
        sum.z += bands[b] * colors[b].z;
      }
      const RGB rgb = xyz_to_srgb(sum);
      float* pixel = &image.values[3 * pixel_place(x, y, width)];
      pixel[0] = static_cast<float>(rgb.r), pixel[1] = static_cast<float>(rgb.g);
      pixel[2] = static_cast<float>(rgb.b);
    }
  return image;
}

DistantLight sun_of(const SkyLight& light) {
  const SkyModel model(light);
  return {normalize(transform_vector(light.light_to_world, light.to_sun)) * -1.0,
          spectrum_of_bands(model.sun_irradiance(model.to_sun()))};
}

std::vector<LightModel> sky_as_image(const SkyLight& light, EnvironmentLight::Projection projection,
                                     const std::filesystem::path& file) {
  const SkyModel model(light);
  std::vector<LightModel> parts;
  if (model.has_sky() || model.has_ground()) {
    write_exr_image(file, sky_image(light, projection, sky_image_height));
    EnvironmentLight sky;
    sky.filename = file.string();
    sky.light_to_world = light.light_to_world;
    sky.projection = projection;
    parts.push_back(sky);
  }
  if (model.has_sun()) parts.push_back(sun_of(light));
  return parts;
}

}  // namespace vitrail
