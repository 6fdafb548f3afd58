// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/write/write_image_lights.h"

#include <algorithm>
#include <cmath>

#include "importers/images/environment_images.h"
#include "importers/writing/export_colors.h"
#include "importers/writing/mesh_files.h"
#include "scene/geometry/pi.h"
#include "scene/spectra/flat_emission.h"

namespace vitrail::povray {

namespace {

// The light's frame, in which its shade is of size 1. Shades are as small as they may be, for other lamps'
// sake: POV-Ray sees no shadow of what is within 1e-3 of a light.
Transform shade_to_pov(const Context& context, const Transform& light_to_world) {
  Transform result = context.units.to_pov * light_to_world;
  const double size = std::cbrt(std::abs(determinant3(result)));
  if (!(size > 0)) throw Error("its transform has no inverse");
  const double wanted = std::max(1e-3 * context.units.radius * context.units.scale, 4e-3);
  return result * scale({wanted / size, wanted / size, wanted / size});
}

// Scales the values to at most 1, and gives what they have to be multiplied by.
double take_greatest(Image& image) {
  const float greatest = image.values.empty() ? 0 : *std::ranges::max_element(image.values);
  if (!(greatest > 0)) return 0;
  for (float& value : image.values) value /= greatest;
  return static_cast<double>(greatest);
}

std::string filter_of(Context& context, const Image& image, const char* words) {
  const std::filesystem::path file = context.images.new_file();
  write_exr_image(file, with_three_channels(image));
  return fmt::format("image_map {{ exr {} gamma 1.0 {} filter all 1 }}",
                     quoted(relative_name(file.string(), context.directory)), words);
}

std::string shade(const Context& context, const std::string& objects, const Transform& light_to_world) {
  return fmt::format(
      "union {{\n{}  finish {{ ambient 0 diffuse 0 }} {} no_image no_reflection no_radiosity }}\n", objects,
      matrix(shade_to_pov(context, light_to_world)));
}

// What a light throws into its frame: intensities, of the upper row at +y, with the left at −x.
struct Thrown {
  Image image;
  Point2d half;
  bool by_texels = false;  // as pbrt shows it, without interpolation
};

Image white_image() {
  constexpr int side = 512;
  Image image;
  image.width = image.height = side, image.channels = 3;
  image.values.assign(std::size_t{3} * side * side, 1);
  return image;
}

Thrown thrown(Context& context, const ProjectionLight& light) {
  // Mitsuba's image is a plane's radiance: it is less than the intensity by cos³.
  const int power = light.irradiance ? -3 : 0;
  if (const auto* spectrum = std::get_if<Spectrum>(&*light.image)) {
    Thrown result{white_image(), half_size(light, 1)};
    multiply(result.image, signed_emission_rgb(*spectrum));
    if (power) multiply_by_cosine(result.image, power, result.half);
    return result;
  }
  const auto image = tinted_image(context.scene, std::get<Id<Texture>>(*light.image));
  const auto* mapping = image ? std::get_if<UvMapping>(&image->image.mapping) : nullptr;
  if (!mapping) throw Error("it throws no image");
  const ImageLayout layout = read_image_layout(image->image.filename);
  const Point2d half = half_size(light, static_cast<double>(layout.width) / layout.height);
  // Mitsuba's textures count v from the top.
  const UvMapping upright = light.irradiance ? UvMapping{1, 0, 0, 0, -1, 1} : UvMapping{};
  const ImageChange change{image->tint, composed(*mapping, upright), true, power, half};
  return {read_linear_image(context.images.write(image->image, ImageUse::light, change)), half,
          image->image.filter == TextureFilter::nearest};
}

// The pixels of an equal-area map at the middles of those of a fine map that POV-Ray knows: its edges stay
// sharp.
Image by_latitude_and_longitude(const Image& picture) {
  using enum EnvironmentLight::Projection;
  constexpr int height = 1024, width = 2 * height;
  Image result;
  result.width = width, result.height = height, result.channels = picture.channels;
  result.values.reserve(static_cast<std::size_t>(width) * height *
                        static_cast<std::size_t>(picture.channels));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Vector3d d = direction_of(latitude_longitude, {(x + .5) / width, (y + .5) / height});
      for (int c = 0; c < picture.channels; ++c)
        result.values.push_back(
            static_cast<float>(environment_lookup(picture, equal_area, point_of(equal_area, d), c)));
    }
  return result;
}

}  // namespace

std::string shaded_light(Context& context, const ProjectionLight& light, WritePoint point,
                         const Origin& origin) {
  Thrown all = thrown(context, light);
  double factor = take_greatest(all.image) * (light.irradiance ? pi : 1);
  if (!(factor > 0)) return "";
  if (light.power) {
    Image on_plane = all.image;
    multiply_by_cosine(on_plane, 3, all.half);
    if (const double flux = thrown_flux(on_plane, all.half); flux > 0)
      factor = static_cast<double>(*light.power) / flux;
  }
  const auto flat = multiple_of_inverse_d65(light.scale);
  const RGB color = flat ? RGB{1, 1, 1} * static_cast<double>(*flat) : factor_rgb(light.scale);
  const auto [x, y] = all.half;
  const double corner = std::sqrt(x * x + y * y), outer = 1.01 * corner;
  // The image, and black around it as far as the lamp's cone reaches.
  const std::string rectangle =
      fmt::format("<{0},{1},1>, <{2},{1},1>, <{2},{3},1>, <{0},{3},1>, <{0},{1},1>", -x, -y, x, y);
  const std::string objects = fmt::format(
      "  polygon {{ 5, {0}\n    pigment {{ {1} scale <{2},{3},1> translate <{4},{5},0> }} }}\n"
      "  polygon {{ 10, <{6},{6},1>, <{7},{6},1>, <{7},{7},1>, <{6},{7},1>, <{6},{6},1>,\n    {0}\n"
      "    pigment {{ rgb 0 }} }}\n",
      rectangle, filter_of(context, all.image, all.by_texels ? "once" : "once interpolate 2"), 2 * x, 2 * y,
      -x, -y, -outer, outer);
  const double cone_deg = std::atan(corner) * 180 / pi;
  const Point3d from = transform_point(light.light_to_world, {0, 0, 0});
  const Vector3d axis = normalize(transform_vector(light.light_to_world, {0, 0, 1}));
  const Point3d to = transform_point(context.units.to_pov, from + axis * context.units.radius);
  context.approximated("projection light: a tiny shade before a lamp filters its light by the image", origin);
  return point(context, from, color * factor,
               fmt::format("spotlight radius {0} falloff {0} tightness 0 point_at {1} ", cone_deg,
                           vector(to))) +
         shade(context, objects, light.light_to_world);
}

std::string shaded_light(Context& context, const GoniometricLight& light, WritePoint point,
                         const Origin& origin) {
  using enum EnvironmentLight::Projection;
  Image picture = texture_values(image_of(light), read_stored_image(light.filename), ImageUse::number);
  const auto projection = light.latitude_longitude ? latitude_longitude : equal_area;
  double factor = 1;
  if (light.power)
    if (const double flux = total_flux(picture, projection); flux > 0)
      factor = static_cast<double>(*light.power) / flux;
  if (!light.latitude_longitude) picture = by_latitude_and_longitude(picture);
  factor *= take_greatest(picture);
  if (!(factor > 0)) return "";
  // The picture's +z is the light's +y, as is the axis of POV-Ray's map_type 1.
  const std::string objects = fmt::format(
      "  sphere {{ 0, 1 pigment {{ {} }} }}\n",
      filter_of(context, picture, light.latitude_longitude ? "map_type 1 interpolate 2" : "map_type 1"));
  context.approximated("goniometric light: a tiny shade around a lamp filters its light by the image",
                       origin);
  return point(context, transform_point(light.light_to_world, {0, 0, 0}),
               signed_emission_rgb(light.intensity) * factor, "") +
         shade(context, objects, light.light_to_world);
}

}  // namespace vitrail::povray
