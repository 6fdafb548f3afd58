// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/write/write_lights.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "images/image_files.h"
#include "importers/images/environment_images.h"
#include "importers/images/joined_surroundings.h"
#include "importers/images/sky_image.h"
#include "importers/mitsuba/write/lamp_images.h"
#include "importers/mitsuba/write/rgb_variants.h"
#include "importers/mitsuba/write/write_images.h"
#include "importers/mitsuba/write/write_projectors.h"
#include "importers/writing/export_colors.h"
#include "importers/writing/physical_light.h"
#include "importers/writing/spot_falloff.h"
#include "scene/spectra/flat_emission.h"

namespace vitrail::mitsuba_writer {

namespace {

// The texture that shines by itself, without D65 (scene/spectra/flat_emission.h).
std::optional<SpectrumParameter> flat_image(const Scene& scene, const AreaLight& light) {
  const auto* id = std::get_if<Id<Texture>>(&light.radiance);
  const auto* product = id ? std::get_if<ProductTexture>(&scene.textures[id->value].model) : nullptr;
  const auto* factor = product ? std::get_if<Spectrum>(&product->second) : nullptr;
  if (!factor || light.scale != 1 || multiple_of_inverse_d65(*factor) != 1.0) return std::nullopt;
  return product->first;
}

Spectrum intensity_of(Context& context, const auto& light, Point3d position) {
  const PhysicalLight physical = physical_light(context.scene, light.fading, position);
  if (!physical.note.empty()) context.approximated(physical.note);
  report_rgb_variants(context, light.intensity);
  return physical.factor == 1 ? light.intensity : scaled(light.intensity, physical.factor);
}

void write(Context& context, Element root, const PointLight& light) {
  Element element = add(root, "emitter", "point");
  add_coordinates(element, "point", "position", light.position);
  add_spectrum(element, "intensity", intensity_of(context, light, light.position), Meaning::emission);
}

void write(Context& context, Element root, const SpotLight& light) {
  Element element = add(root, "emitter", "spot");
  add_transform(element, light.light_to_world);
  const Point3d position = transform_point(light.light_to_world, {0, 0, 0});
  add_spectrum(element, "intensity", intensity_of(context, light, position), Meaning::emission);
  if (light.tightness != 0)
    context.approximated(fmt::format("its tightness {} is left out", light.tightness));
  const MatchedSpot spot = matched_spot(light, SpotLight::Falloff::linear);
  add_float(element, "cutoff_angle", static_cast<float>(spot.cutoff_deg));
  add_float(element, "beam_width", static_cast<float>(spot.beam_deg));
  if (spot.difference > 0)
    context.approximated(fmt::format(
        "towards the edge Mitsuba's spot falls linearly with the angle: of the same flux, its intensity "
        "is within {:.2g} of the greatest",
        spot.difference));
  if (!light.texture) return;
  const SpectrumParameter texture = *light.texture;
  if (value_of(context, texture))
    return context.dropped("the texture of a spot light: Mitsuba takes an image");
  add_parameter(context, element, "texture", texture, Meaning::reflectance);
}

void write(Context& context, Element root, const ProjectionLight& light) {
  write_projector(context, root, light);
}

void write(Context& context, Element root, const GoniometricLight& light) {
  write_goniometric(context, root, light);
}

void write(Context& context, Element root, const DistantLight& light) {
  report_rgb_variants(context, light.irradiance);
  Element element = add(root, "emitter", "directional");
  add_coordinates(element, "vector", "direction", light.direction);
  add_spectrum(element, "irradiance", light.irradiance, Meaning::emission);
}

void write(Context& context, Element root, const InfiniteLight& light) {
  report_rgb_variants(context, light.radiance);
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

// Takes the size out of a transform: directions have none, and Mitsuba distorts an image by it.
Transform scale_of_one(const Transform& t) {
  const double size = std::cbrt(std::abs(determinant3(t)));
  if (!(size > 0) || std::abs(size - 1) < 1e-6) return {};
  return scale({1 / size, 1 / size, 1 / size});
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
  const bool decoded_alike =
      is_read_by_mitsuba(light.filename) && have_same_values(texture, taken, ImageUse::light);
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
  if (*light.portal) context.dropped("the portal of an environment light: its light comes from everywhere");
  try {
    const WrittenEnvironment written = environment(context, light);
    Element element = add(root, "emitter", "envmap");
    const Transform to_world = light.light_to_world * mitsuba_to_light();
    // The scale that a file of Mitsuba's gives distorts its image, and does so in what is written.
    add_transform(element, is_mitsuba_file(context.scene, context.origin)
                               ? to_world
                               : to_world * scale_of_one(to_world));
    add_string(element, "filename", written.filename);
    add_float(element, "scale", static_cast<float>(written.scale));
  } catch (const Error& error) {
    context.dropped(fmt::format("an environment light: {}", error.what()));
  }
}

void write(Context& context, Element root, const SkyLight& light) {
  if (*light.distribution || light.ground > 0) {
    context.approximated(
        "Mitsuba's sky is clear and without a ground: this one is an image in linear sRGB, and its sun "
        "parallel light");
    for (const LightModel& part :
         sky_as_image(light, EnvironmentLight::Projection::latitude_longitude, context.images.new_file()))
      std::visit([&](const auto& model) { write(context, root, model); }, part);
    return;
  }
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
  join_surroundings(context, context.exposed.lights, "Mitsuba", context.images, context.file.parent_path());
  for (std::size_t i = 0; i < context.exposed.lights.size(); ++i) {
    const Light& light = context.exposed.lights[i];
    context.begin(RecordKind::light, light.origin);
    const Element before = root.last_child();
    std::visit([&](const auto& model) { write(context, root, model); }, light.model);
    if (Element made = before.next_sibling("emitter"); made && !light.name.empty())
      made.append_attribute("id") = context.new_id(light.name, "light", i).c_str();
  }
}

void write_area_light(Context& context, Element element, const AreaLight& light, const Shape& shape) {
  context.begin(RecordKind::area_light, light.origin);
  if (!light.sampled) context.approximated("it lights the scene: Mitsuba has none that shines and does not");
  Element emitter = add(element, "emitter", light.directional ? "directionalarea" : "area", "",
                        light.name.empty() ? "" : context.new_id(light.name, "area", 0));
  if (light.directional)
    context.approximated("Mitsuba's path tracers show nothing of a directionalarea; its ptracer does");
  if (const auto radiance = value_of(context, light.radiance)) {
    report_rgb_variants(context, *radiance);
    return add_spectrum(emitter, "radiance", scaled(*radiance, static_cast<double>(light.scale)),
                        Meaning::emission);
  }
  if (const auto flat = flat_image(context.scene, light)) {
    add_parameter(context, emitter, "radiance", *flat, Meaning::emission);
  } else {
    add_lamp_image(context, emitter, light, shape);
  }
}

}  // namespace vitrail::mitsuba_writer
