// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/write/write_surroundings.h"

#include <algorithm>
#include <functional>

#include "images/texture_values.h"
#include "importers/images/environment_images.h"
#include "importers/images/sky_image.h"
#include "importers/writing/export_colors.h"
#include "scene/daylight/sky_model.h"
#include "scene/records/light_traits.h"
#include "scene/records/pixel_place.h"

namespace vitrail::mitsuba_writer {

namespace {

constexpr auto map = EnvironmentLight::Projection::latitude_longitude;

// The radiance from a direction of the world.
using Radiance = std::function<RGB(Vector3d)>;

Radiance radiance_of(const InfiniteLight& light) {
  return [color = emission_rgb(light.radiance)](Vector3d) { return color; };
}

Radiance radiance_of(const EnvironmentLight& light, Image image) {
  double factor = 1;
  if (light.illuminance)
    if (const double natural = upward_illuminance(image, light.projection); natural > 0)
      factor = static_cast<double>(*light.illuminance) / natural;
  return [image = std::move(image), to_light = inverse(light.light_to_world), color = factor_rgb(light.scale),
          factor, projection = light.projection](Vector3d direction) {
    const Point2d point = point_of(projection, normalize(transform_vector(to_light, direction)));
    const auto value = [&](int c) {
      return factor * environment_lookup(image, projection, point, std::min(c, image.channels - 1));
    };
    return RGB{color.r * value(0), color.g * value(1), color.b * value(2)};
  };
}

Radiance radiance_of(const SkyLight& light) {
  const Image image = sky_image(light, map, sky_image_height);
  EnvironmentLight as_image;
  as_image.projection = map;
  as_image.light_to_world = light.light_to_world;
  return radiance_of(as_image, image);
}

Image summed(const std::vector<Radiance>& lights, int height) {
  Image image = black_image(2 * height, height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const Vector3d direction = direction_of(map, {(x + 0.5) / image.width, (y + 0.5) / height});
      float* pixel = &image.values[3 * pixel_place(x, y, image.width)];
      for (const Radiance& light : lights) {
        const RGB radiance = light(direction);
        pixel[0] += static_cast<float>(radiance.r);
        pixel[1] += static_cast<float>(radiance.g);
        pixel[2] += static_cast<float>(radiance.b);
      }
    }
  return image;
}

LightModel joined_image(Context& context, const std::vector<const Light*>& lights) {
  std::vector<Radiance> radiances;
  int height = 0;
  for (const Light* light : lights) {
    if (const auto* everywhere = std::get_if<InfiniteLight>(&light->model)) {
      radiances.push_back(radiance_of(*everywhere));
      continue;
    }
    if (const auto* sky = std::get_if<SkyLight>(&light->model)) {
      radiances.push_back(radiance_of(*sky));
      height = std::max(height, sky_image_height);
      if (SkyModel(*sky).has_sun()) context.dropped("the sun of a sky beside other light from all around");
      continue;
    }
    const auto& environment = std::get<EnvironmentLight>(light->model);
    context.begin(RecordKind::light, light->origin);
    try {
      Image image =
          texture_values(image_of(environment), read_stored_image(environment.filename), ImageUse::light);
      height = std::max(height, image.height);
      radiances.push_back(radiance_of(environment, std::move(image)));
    } catch (const Error& error) {
      context.dropped(fmt::format("an environment light: {}", error.what()));
    }
    if (environment.portal)
      context.dropped("the portal of an environment light: its light comes from everywhere");
  }
  EnvironmentLight joined;
  joined.projection = map;
  const std::string name = context.new_file("images", "exr", context.derived_images);
  const std::filesystem::path file = std::filesystem::absolute(context.file.parent_path() / name);
  write_exr_image(file, summed(radiances, std::max(height, 1)));
  joined.filename = file.string();
  context.approximated(fmt::format("Mitsuba takes one light from all around: the sum of {} is written as {}",
                                   lights.size(), name));
  return joined;
}

}  // namespace

bool is_around(const Light& light) { return traits_of(light.model).surrounds; }

std::optional<LightModel> joined_surroundings(Context& context) {
  std::vector<const Light*> lights;
  bool uniform = true;
  for (const Light& light : context.exposed.lights) {
    if (!is_around(light)) continue;
    lights.push_back(&light);
    uniform = uniform && std::holds_alternative<InfiniteLight>(light.model);
  }
  if (lights.size() < 2) return std::nullopt;
  context.begin(RecordKind::light, lights.front()->origin);
  if (!uniform) return joined_image(context, lights);
  Spectrum sum = std::get<InfiniteLight>(lights.front()->model).radiance;
  for (std::size_t i = 1; i < lights.size(); ++i)
    sum = weighted_sum(sum, 1, std::get<InfiniteLight>(lights[i]->model).radiance, 1);
  return InfiniteLight{sum};
}

}  // namespace vitrail::mitsuba_writer
