// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/write/write_lights.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "images/image_files.h"
#include "importers/images/environment_images.h"
#include "importers/images/joined_surroundings.h"
#include "importers/mitsuba/write/write_images.h"
#include "importers/writing/export_colors.h"
#include "importers/writing/physical_light.h"
#include "importers/writing/spot_falloff.h"
#include "scene/spectra/flat_emission.h"

namespace vitrail::mitsuba_writer {

namespace {

// The colours of an image under D65: Mitsuba would take white for a flat spectrum.
void add_lit_image(Context& context, Element emitter, const char* name, const SpectrumParameter& image,
                   float scale) {
  Element lit = add(emitter, "texture", "d65", name);
  add_parameter(context, lit, "nested", image, Meaning::emission);
  add_float(lit, "scale", scale);
}

// The texture that shines by itself, without D65 (scene/spectra/flat_emission.h).
std::optional<SpectrumParameter> flat_image(const Scene& scene, const AreaLight& light) {
  const auto* id = std::get_if<Id<Texture>>(&light.radiance);
  const auto* product = id ? std::get_if<ProductTexture>(&scene.textures[id->value].model) : nullptr;
  const auto* factor = product ? std::get_if<Spectrum>(&product->second) : nullptr;
  if (!factor || light.scale != 1 || multiple_of_inverse_d65(*factor) != 1.0) return std::nullopt;
  return product->first;
}

constexpr const char* brightness = "the brightness of this light";

Spectrum intensity_of(Context& context, const auto& light, Point3d position) {
  const PhysicalLight physical = physical_light(context.scene, light.fading, position);
  if (!physical.note.empty()) context.approximated(physical.note);
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
  if (light.tightness > 0) context.approximated(fmt::format("its tightness {} is left out", light.tightness));
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

// The image of a light, its width ÷ height; 1 where it cannot be read.
double aspect_of(const TintedImage& image) {
  try {
    const ImageLayout layout = read_image_layout(image.image.filename);
    return static_cast<double>(layout.width) / layout.height;
  } catch (const Error&) {
    return 1;
  }
}

double greatest_value(const ImageTexture& texture) {
  const Image values = texture_values(texture, read_stored_image(texture.filename), ImageUse::light);
  return values.values.empty() ? 0 : static_cast<double>(*std::ranges::max_element(values.values));
}

// ∫ Y dω of an image of cos³θ times the radiance, dω = cos³θ dA, over ±half at distance 1.
double flux_of(const std::filesystem::path& file, Point2d half) {
  const Image image = read_linear_image(file);
  double sum = 0;
  for (std::size_t i = 0; i + 2 < image.values.size(); i += 3)
    sum += srgb_to_xyz({image.values[i], image.values[i + 1], image.values[i + 2]}).y;
  return 4 * half.x * half.y * sum / static_cast<double>(std::max<std::size_t>(image.pixels(), 1));
}

// Mitsuba's projector is a camera: u = 0 on the left, at +x, and v = 0 at the top, at +y.
Element add_projector(Element root, const ProjectionLight& light, float fov_deg) {
  Element element = add(root, "emitter", "projector");
  add_transform(element, light.light_to_world * scale({-1, 1, 1}));
  add_float(element, "fov", fov_deg);
  add_string(element, "fov_axis", "x");
  return element;
}

// pbrt's: u = 0 at −x, and the image's upper row at +y. Mitsuba's image times π is the irradiance on a plane
// at distance 1: the intensity times cos³θ.
void write_intensity(Context& context, Element root, const ProjectionLight& light) {
  const auto* texture = std::get_if<Id<Texture>>(&light.image);
  const auto image = texture ? tinted_image(context.scene, *texture) : std::nullopt;
  const auto* mapping = image ? std::get_if<UvMapping>(&image->image.mapping) : nullptr;
  if (!mapping) return context.dropped("a projection light without an image");
  const Point2d half = half_size(light, aspect_of(*image));
  const RGB color = factor_rgb(light.scale);
  RGB tint{image->tint.r * color.r, image->tint.g * color.g, image->tint.b * color.b};
  try {
    // Mitsuba cuts images at 1.
    const double brightest = std::max({tint.r, tint.g, tint.b}) * greatest_value(image->image);
    if (!(brightest > 0)) return context.dropped("a projection light that is black");
    tint = {tint.r / brightest, tint.g / brightest, tint.b / brightest};
    const ImageChange change{tint, *mapping, true, 3, half};
    const std::filesystem::path file = context.images.write(image->image, ImageUse::light, change);
    const std::string name = context.relative(std::filesystem::absolute(file).string());
    const double fov_deg = std::atan(half.x) * 360 / std::numbers::pi;
    const Element element = add_projector(root, light, static_cast<float>(fov_deg));
    const Element lit = add(element, "texture", "d65", "irradiance");
    add_string(add(lit, "texture", "bitmap", "nested"), "filename", name);
    double factor = brightest / std::numbers::pi;
    if (light.power)
      if (const double flux = brightest * flux_of(file, half); flux > 0)
        factor *= static_cast<double>(*light.power) * luminance(light.scale) / flux;
    add_float(element, "scale", static_cast<float>(factor));  // rgb variants know none of a d65
    context.approximated(
        fmt::format("Mitsuba's projector has an image of irradiance: it is written as {}", name));
  } catch (const Error& error) {
    context.dropped(fmt::format("a projection light: {}", error.what()));
  }
}

void write(Context& context, Element root, const ProjectionLight& light) {
  if (!light.irradiance) return write_intensity(context, root, light);
  const bool is_image = !value_of(context, light.image);
  Element element = add_projector(root, light, light.fov_deg);
  const auto flat = multiple_of_inverse_d65(light.scale);
  if (is_image && !flat)
    add_lit_image(context, element, "irradiance", light.image, 1);
  else
    add_parameter(context, element, "irradiance", light.image, Meaning::emission);
  add_float(element, "scale", static_cast<float>(flat ? *flat : number_of(context, light.scale, brightness)));
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
  join_surroundings(context, context.exposed.lights, "Mitsuba", context.images, context.file.parent_path());
  for (const Light& light : context.exposed.lights) {
    context.begin(RecordKind::light, light.origin);
    std::visit([&](const auto& model) { write(context, root, model); }, light.model);
  }
}

void write_area_light(Context& context, Element shape, const AreaLight& light) {
  context.begin(RecordKind::area_light, light.origin);
  if (!light.sampled) context.approximated("it lights the scene: Mitsuba has none that shines and does not");
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
    if (light.scale != 1)
      context.approximated(fmt::format(
          "Mitsuba's rgb variants leave out the scale of a lamp's image: there it is 1/{:g} as bright",
          light.scale));
  }
}

}  // namespace vitrail::mitsuba_writer
