// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/write_lights.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "images/image_files.h"
#include "importers/images/environment_images.h"
#include "importers/mitsuba/write_surroundings.h"
#include "scene/flat_emission.h"

namespace vitrail::mitsuba_writer {

namespace {

// The colours of an image under D65: Mitsuba would take white for a flat spectrum.
void add_lit_image(Context& context, Element emitter, const char* name, const SpectrumParameter& image,
                   float scale) {
  Element lit = add(emitter, "texture", "d65", name);
  add_parameter(context, lit, "nested", image, Meaning::emission);
  add_float(lit, "scale", scale);
}

// The texture that shines by itself, without D65 (scene/flat_emission.h).
std::optional<SpectrumParameter> flat_image(const Scene& scene, const AreaLight& light) {
  const auto* id = std::get_if<Id<Texture>>(&light.radiance);
  const auto* product = id ? std::get_if<ProductTexture>(&scene.textures[id->value].model) : nullptr;
  const auto* factor = product ? std::get_if<Spectrum>(&product->second) : nullptr;
  if (!factor || light.scale != 1 || multiple_of_inverse_d65(*factor) != 1.0) return std::nullopt;
  return product->first;
}

constexpr const char* brightness = "the brightness of this light";

void write(Context&, Element root, const PointLight& light) {
  Element element = add(root, "emitter", "point");
  add_coordinates(element, "point", "position", light.position);
  add_spectrum(element, "intensity", light.intensity, Meaning::emission);
}

void write(Context& context, Element root, const SpotLight& light) {
  Element element = add(root, "emitter", "spot");
  add_transform(element, light.light_to_world);
  add_spectrum(element, "intensity", light.intensity, Meaning::emission);
  add_float(element, "cutoff_angle", light.cutoff_deg);
  add_float(element, "beam_width", light.beam_deg);
  if (light.falloff != SpotLight::Falloff::linear)
    context.approximated(
        "between beam and cutoff Mitsuba's spot falls linearly with the angle; the end angles agree");
  if (!light.texture) return;
  const SpectrumParameter texture = *light.texture;
  if (value_of(context, texture))
    return context.dropped("the texture of a spot light: Mitsuba takes an image");
  add_parameter(context, element, "texture", texture, Meaning::reflectance);
}

// Of the image's width; pbrt measures its shorter axis. An image that cannot be read counts as a square.
double fov_of_width(const Scene& scene, const ProjectionLight& light) {
  const double fov_deg = static_cast<double>(light.fov_deg);
  const auto* texture = std::get_if<Id<Texture>>(&light.image);
  const auto* image = texture ? std::get_if<ImageTexture>(&scene.textures[texture->value].model) : nullptr;
  if (light.irradiance || !image) return fov_deg;
  try {
    const ImageLayout layout = read_image_layout(image->filename);
    if (layout.width <= layout.height) return fov_deg;
    const double wide = static_cast<double>(layout.width) / layout.height;
    return 2 * std::atan(wide * std::tan(fov_deg * std::numbers::pi / 360)) * 180 / std::numbers::pi;
  } catch (const Error&) {
    return fov_deg;
  }
}

// Mitsuba's projector is a camera: u = 0 on the left, at +x, and v = 0 at the top, at +y. pbrt has u = 0 at
// −x, and the image's upper row at −y. The image times π is the irradiance at distance 1.
void write(Context& context, Element root, const ProjectionLight& light) {
  const bool is_image = !value_of(context, light.image);
  if (!light.irradiance && !is_image) return context.dropped("a projection light without an image");
  Element element = add(root, "emitter", "projector");
  add_transform(element, light.light_to_world * scale({-1, 1, 1}));
  const auto flat = multiple_of_inverse_d65(light.scale);
  if (is_image && !flat)
    add_lit_image(context, element, "irradiance", light.image, 1);
  else
    add_parameter(context, element, "irradiance", light.image, Meaning::emission);
  add_float(element, "fov", static_cast<float>(fov_of_width(context.scene, light)));
  add_string(element, "fov_axis", "x");
  const double factor = flat ? *flat : number_of(context, light.scale, brightness);
  add_float(element, "scale", static_cast<float>(light.irradiance ? factor : factor / std::numbers::pi));
  if (!light.irradiance)
    context.approximated(
        "the image of a projector is irradiance in Mitsuba: brighter off its axis by 1/cos³");
  if (light.power) context.dropped("the power of a projection light: its image counts as it is");
}

void write(Context& context, Element root, const GoniometricLight& light) {
  context.approximated("Mitsuba has no goniometric light: the same intensity in all directions");
  if (light.power) context.dropped("the power of a goniometric light");
  const auto& m = light.light_to_world.m;
  write(context, root, PointLight{{m[0][3], m[1][3], m[2][3]}, light.intensity});
}

void write(Context&, Element root, const DistantLight& light) {
  Element element = add(root, "emitter", "directional");
  add_coordinates(element, "vector", "direction", light.direction);
  add_spectrum(element, "irradiance", light.irradiance, Meaning::emission);
}

void write(Context&, Element root, const InfiniteLight& light) {
  add_spectrum(add(root, "emitter", "constant"), "radiance", light.radiance, Meaning::emission);
}

// Mitsuba looks at its map with y up and u = atan2(x, −z)/2π: a direction m of it is (−z, x, y) here.
Transform mitsuba_to_light() {
  Transform t;
  t.m[0] = {0, 0, -1, 0};
  t.m[1] = {1, 0, 0, 0};
  t.m[2] = {0, 1, 0, 0};
  return t;
}

bool is_grey(RGB c) { return c.r == c.g && c.g == c.b; }

struct WrittenEnvironment {
  std::string filename;
  double scale = 1;
};

// The map as it is where Mitsuba can read it so, else resampled and coloured.
WrittenEnvironment environment(Context& context, const EnvironmentLight& light) {
  using enum EnvironmentLight::Projection;
  const RGB color = color_of(light.scale);
  const ImageTexture texture = image_of(light);
  ImageTexture taken;
  taken.filename = light.filename;
  const bool decoded_alike = have_same_values(texture, taken, ImageUse::light);
  const bool as_is = light.projection == latitude_longitude && is_grey(color) && decoded_alike;
  if (as_is && !light.illuminance) return {context.relative(light.filename), color.r};
  Image image = texture_values(texture, read_stored_image(light.filename), ImageUse::light);
  double factor = is_grey(color) ? color.r : 1;
  if (light.illuminance) {
    const double natural = upward_illuminance(image, light.projection);
    if (natural > 0) factor *= static_cast<double>(*light.illuminance) / natural;
  }
  if (as_is) return {context.relative(light.filename), factor};
  if (light.projection == equal_area) {
    image = reproject(image, equal_area, latitude_longitude);
    context.approximated("the equal-area environment map is resampled to latitude and longitude");
  }
  if (!is_grey(color)) {
    image = with_three_channels(std::move(image));
    const std::array scale{color.r, color.g, color.b};
    for (std::size_t i = 0; i < image.values.size(); ++i)
      image.values[i] = static_cast<float>(static_cast<double>(image.values[i]) * scale[i % 3]);
    context.approximated("the colour of an environment light is multiplied into its image");
  }
  const std::string name = context.new_file("images", "exr", context.derived_images);
  if (!decoded_alike)
    context.approximated(
        fmt::format("Mitsuba takes other values from its image: they are written as {}", name));
  write_exr_image(context.file.parent_path() / name, image);
  return {name, factor};
}

void write(Context& context, Element root, const EnvironmentLight& light) {
  if (light.portal) context.dropped("the portal of an environment light: its light comes from everywhere");
  try {
    const WrittenEnvironment written = environment(context, light);
    Element element = add(root, "emitter", "envmap");
    add_transform(element, light.light_to_world * mitsuba_to_light());
    add_string(element, "filename", written.filename);
    add_float(element, "scale", static_cast<float>(written.scale));
  } catch (const Error& error) {
    context.dropped(fmt::format("an environment light: {}", error.what()));
  }
}

void write(Context&, Element root, const SkyLight& light) {
  Element element = add(root, "emitter", "sunsky");
  add_transform(element, light.light_to_world);
  add_coordinates(element, "vector", "sun_direction",
                  normalize(transform_vector(light.light_to_world, light.to_sun)));
  add_float(element, "turbidity", std::clamp(light.turbidity, 1.0f, 10.0f));
  add_spectrum(element, "albedo", light.albedo, Meaning::reflectance);
  add_float(element, "sky_scale", light.sky_scale);
  add_float(element, "sun_scale", light.sun_scale);
  add_float(element, "sun_aperture", light.sun_diameter_deg);
  add_boolean(element, "complex_sun", light.limb_darkening);
}

}  // namespace

void write_lights(Context& context, Element root) {
  const auto write_model = [&](const LightModel& light) {
    std::visit([&](const auto& model) { write(context, root, model); }, light);
  };
  std::optional<LightModel> around = joined_surroundings(context);
  const bool joined = around.has_value();
  for (const Light& light : context.scene.lights) {
    context.begin(RecordKind::light, light.origin);
    if (!joined || !is_around(light))
      write_model(light.model);
    else if (around)
      write_model(*std::exchange(around, std::nullopt));
  }
}

void write_area_light(Context& context, Element shape, const AreaLight& light) {
  context.begin(RecordKind::area_light, light.origin);
  Element element = add(shape, "emitter", light.directional ? "directionalarea" : "area");
  if (light.directional)
    context.approximated("Mitsuba's path tracers show nothing of a directionalarea; its ptracer does");
  if (const auto radiance = value_of(context, light.radiance))
    return add_spectrum(element, "radiance", scaled(*radiance, static_cast<double>(light.scale)),
                        Meaning::emission);
  if (const auto flat = flat_image(context.scene, light)) {
    add_parameter(context, element, "radiance", *flat, Meaning::emission);
  } else {
    add_lit_image(context, element, "radiance", light.radiance, light.scale);
  }
}

}  // namespace vitrail::mitsuba_writer
