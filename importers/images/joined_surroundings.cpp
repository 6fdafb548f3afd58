// SPDX-License-Identifier: Apache-2.0
#include "importers/images/joined_surroundings.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>

#include "images/texture_values.h"
#include "importers/images/environment_images.h"
#include "importers/images/sky_image.h"
#include "importers/writing/export_colors.h"
#include "importers/writing/mesh_files.h"
#include "scene/daylight/sky_model.h"
#include "scene/records/light_traits.h"
#include "scene/records/pixel_place.h"

namespace vitrail {

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
      const Vector3d direction = direction_of(map, pixel_point(map, image.width, height, x, y));
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

// What remains of lights from all around beside their sum.
struct Joined {
  LightModel sum;
  std::vector<LightModel> suns;
};

bool is_around(const Light& light) { return traits_of(light.model).surrounds; }

class Joiner {
 public:
  explicit Joiner(ConversionNotes& notes) : notes_(notes) {}

  void add(const InfiniteLight& light) { radiances_.push_back(radiance_of(light)); }

  void add(const SkyLight& light) {
    const SkyModel model(light);
    if (model.has_sky() || model.has_ground()) {
      radiances_.push_back(radiance_of(light));
      height_ = std::max(height_, sky_image_height);
    }
    if (!model.has_sun()) return;
    notes_.approximated("the sun of a sky beside other light from all around: parallel light");
    suns_.push_back(sun_of(light));
  }

  void add(const EnvironmentLight& light) {
    try {
      Image image = texture_values(image_of(light), read_stored_image(light.filename), ImageUse::light);
      height_ = std::max(height_, image.height);
      radiances_.push_back(radiance_of(light, std::move(image)));
    } catch (const Error& error) {
      notes_.dropped(fmt::format("an environment light: {}", error.what()));
    }
    if (*light.portal) notes_.dropped("the portal of an environment light: its light comes from everywhere");
  }

  void add(const auto&) {}  // not from all around

  Image sum() const { return summed(radiances_, height_); }
  std::vector<LightModel> suns() const { return suns_; }

 private:
  ConversionNotes& notes_;
  std::vector<Radiance> radiances_;
  std::vector<LightModel> suns_;
  int height_ = 1;
};

Joined joined_image(ConversionNotes& notes, const std::vector<Light>& lights, const std::string& format,
                    const ConvertedImages& images, const std::filesystem::path& directory) {
  Joiner joiner(notes);
  for (const Light& light : lights) {
    notes.begin(RecordKind::light, light.origin);
    std::visit([&](const auto& model) { joiner.add(model); }, light.model);
  }
  const std::filesystem::path file = std::filesystem::absolute(images.new_file());
  write_exr_image(file, joiner.sum());
  notes.begin(RecordKind::light, lights.front().origin);
  notes.approximated(fmt::format("{} takes one light from all around: the sum of {} is written as {}", format,
                                 lights.size(), relative_name(file.string(), directory)));
  EnvironmentLight sum;
  sum.projection = map;
  sum.filename = file.string();
  return {sum, joiner.suns()};
}

LightModel summed_constants(const std::vector<Light>& lights) {
  Spectrum sum = std::get<InfiniteLight>(lights.front().model).radiance;
  for (std::size_t i = 1; i < lights.size(); ++i)
    sum = weighted_sum(sum, 1, std::get<InfiniteLight>(lights[i].model).radiance, 1);
  return InfiniteLight{sum};
}

}  // namespace

void join_surroundings(ConversionNotes& notes, std::vector<Light>& lights, const std::string& format,
                       const ConvertedImages& images, const std::filesystem::path& directory) {
  std::vector<Light> around;
  std::ranges::copy_if(lights, std::back_inserter(around), is_around);
  if (around.size() < 2) return;
  const auto is_constant = [](const Light& l) { return std::holds_alternative<InfiniteLight>(l.model); };
  const Joined joined = std::ranges::all_of(around, is_constant)
                            ? Joined{summed_constants(around), {}}
                            : joined_image(notes, around, format, images, directory);
  std::ranges::find_if(lights, is_around)->model = joined.sum;
  bool first = true;
  std::erase_if(lights, [&](const Light& light) { return is_around(light) && !std::exchange(first, false); });
  for (const LightModel& sun : joined.suns) lights.push_back({sun, around.front().origin});
}

}  // namespace vitrail
