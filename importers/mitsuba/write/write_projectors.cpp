// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/write/write_projectors.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "images/image_files.h"
#include "importers/images/cube_faces.h"
#include "importers/mitsuba/write/write_spectra.h"
#include "importers/mitsuba/write/write_textures.h"
#include "importers/writing/export_colors.h"
#include "scene/spectra/flat_emission.h"

namespace vitrail::mitsuba_writer {

namespace {

constexpr const char* brightness = "the brightness of this light";

// The image of a light, its width ÷ height; 1 where it cannot be read.
double aspect_of(const TintedImage& image) {
  try {
    const ImageLayout layout = read_image_layout(image.image.filename);
    return static_cast<double>(layout.width) / layout.height;
  } catch (const Error&) {
    return 1;
  }
}

// Whose edges do not run into each other.
void add_bitmap(Element lit, const std::string& file) {
  const Element nested = add(lit, "texture", "bitmap", "nested");
  add_string(nested, "filename", file);
  add_string(nested, "wrap_mode", "clamp");
}

double greatest_value(const ImageTexture& texture) {
  const Image values = texture_values(texture, read_stored_image(texture.filename), ImageUse::light);
  return values.values.empty() ? 0 : static_cast<double>(*std::ranges::max_element(values.values));
}

// Mitsuba's projector is a camera: u = 0 on the left, at +x, and v = 0 at the top, at +y.
Element add_projector(Element root, const Transform& light_to_world, float fov_deg) {
  Element element = add(root, "emitter", "projector");
  add_transform(element, light_to_world * scale({-1, 1, 1}));
  add_float(element, "fov", fov_deg);
  add_string(element, "fov_axis", "x");
  return element;
}

// pbrt's: u = 0 at −x, and the image's upper row at +y. Mitsuba's image times π is the irradiance on a plane
// at distance 1: the intensity times cos³θ.
void write_intensity(Context& context, Element root, const ProjectionLight& light) {
  const auto* texture = std::get_if<Id<Texture>>(&*light.image);
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
    const Element element = add_projector(root, light.light_to_world, static_cast<float>(fov_deg));
    const Element lit = add(element, "texture", "d65", "irradiance");
    add_bitmap(lit, name);
    double factor = brightest / std::numbers::pi;
    if (light.power)
      if (const double flux = brightest * thrown_flux(read_linear_image(file), half); flux > 0)
        factor *= static_cast<double>(*light.power) * luminance(light.scale) / flux;
    add_float(element, "scale", static_cast<float>(factor));  // rgb variants know none of a d65
    context.approximated(
        fmt::format("Mitsuba's projector has an image of irradiance: it is written as {}", name));
  } catch (const Error& error) {
    context.dropped(fmt::format("a projection light: {}", error.what()));
  }
}

}  // namespace

void write_projector(Context& context, Element root, const ProjectionLight& light) {
  if (!light.irradiance) return write_intensity(context, root, light);
  const bool is_image = !value_of(context, light.image);
  Element element = add_projector(root, light.light_to_world, light.fov_deg);
  const auto flat = multiple_of_inverse_d65(light.scale);
  if (is_image && !flat)
    add_lit_image(context, element, "irradiance", light.image, 1);
  else
    add_parameter(context, element, "irradiance", light.image, Meaning::emission);
  add_float(element, "scale", static_cast<float>(flat ? *flat : number_of(context, light.scale, brightness)));
}

namespace {

void write_as_point(Element root, const GoniometricLight& light) {
  const auto& m = light.light_to_world->m;
  Element element = add(root, "emitter", "point");
  add_coordinates(element, "point", "position", Point3d{m[0][3], m[1][3], m[2][3]});
  add_spectrum(element, "intensity", light.intensity, Meaning::emission);
}

// The picture's +z is the light's +y.
Transform picture_to_light() {
  Transform t;
  t.m[1] = {0, 0, 1, 0};
  t.m[2] = {0, 1, 0, 0};
  return t;
}

void write_face(Context& context, Element root, const GoniometricLight& light, CubeFace face, double factor) {
  const float brightest = *std::ranges::max_element(face.image.values);
  for (float& value : face.image.values) value /= brightest;  // Mitsuba cuts images at 1
  const RGB color = emission_rgb(light.intensity);
  const double most = std::max({color.r, color.g, color.b});
  if (color.r != color.g || color.g != color.b) {
    face.image = with_three_channels(std::move(face.image));
    multiply(face.image, {color.r / most, color.g / most, color.b / most});
  }
  const std::filesystem::path file = context.images.new_file();
  write_exr_image(file, face.image);
  // An image of a projector has its left at −x: so has a face, seen from the light.
  const Element element =
      add_projector(root, light.light_to_world * picture_to_light() * face.to_picture, 90);
  add_bitmap(add(element, "texture", "d65", "irradiance"),
             context.relative(std::filesystem::absolute(file).string()));
  add_float(element, "scale",
            static_cast<float>(factor * most * static_cast<double>(brightest) / std::numbers::pi));
}

}  // namespace

void write_goniometric(Context& context, Element root, const GoniometricLight& light) {
  const auto projection = light.latitude_longitude ? EnvironmentProjection::latitude_longitude
                                                   : EnvironmentProjection::equal_area;
  try {
    const Image picture =
        texture_values(image_of(light), read_stored_image(light.filename), ImageUse::number);
    double factor = 1;
    if (light.power)
      if (const double flux = total_flux(picture, projection); flux > 0)
        factor = static_cast<double>(*light.power) / flux;
    std::vector<CubeFace> faces = cube_faces(picture, projection, 3);
    context.approximated(
        fmt::format("Mitsuba has no goniometric light: it is written as {} projectors on the faces of a cube",
                    faces.size()));
    if (!is_rgb(light.intensity)) context.approximated("its spectrum becomes a colour of three numbers");
    for (CubeFace& face : faces) write_face(context, root, light, std::move(face), factor);
  } catch (const Error& error) {
    context.approximated(
        fmt::format("a goniometric light shines the same in all directions: {}", error.what()));
    write_as_point(root, light);
  }
}

}  // namespace vitrail::mitsuba_writer
