// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/write/write_lights.h"

#include <algorithm>

#include "importers/images/mean_intensity.h"
#include "importers/images/sky_image.h"
#include "importers/povray/write/write_environment.h"
#include "importers/povray/write/write_image_lights.h"
#include "importers/writing/export_colors.h"
#include "scene/geometry/pi.h"
#include "scene/models/fading.h"

namespace vitrail::povray {

namespace {

// A diffuse surface of colour ρ that is lit by colour c shows ρ·c·cos θ·a(d): irradiance over π. With the
// attenuation a(d) = 2/(1 + (d/f)²) ≈ 2f²/d², an intensity I is c = I/(2πf²) where f is much less than d.
double fade_distance(const Context& context) { return 1e-4 * context.units.radius * context.units.scale; }

std::string fading(const Context& context) {
  return fmt::format("fade_distance {} fade_power 2", fade_distance(context));
}

// Intensities have the unit of an area.
std::string intensity_color(const Context& context, RGB intensity) {
  const double f = fade_distance(context), area = context.units.scale * context.units.scale;
  return color(intensity * (area / (2 * pi * f * f)));
}

std::string at(const Context& context, Point3d p) { return vector(transform_point(context.units.to_pov, p)); }

// Colour and fading of a point or spot light.
std::string strength(const Context& context, const auto& light) {
  const RGB intensity = signed_emission_rgb(light.intensity);
  if (!light.fading) return fmt::format("{} {}", intensity_color(context, intensity), fading(context));
  std::string shade = color(intensity * (1 / pi));
  if (!weakens(*light.fading)) return shade;
  return fmt::format("{} fade_distance {} fade_power {}", shade,
                     static_cast<double>(light.fading->fade_distance) * context.units.scale,
                     light.fading->fade_power);
}

// Of a light without extent: all lights shoot photons else.
const char* no_photons(const Context& context) {
  return context.has_caustics ? " photons { reflection off refraction off }" : "";
}

std::string point(const Context& context, Point3d position, RGB intensity, const std::string& words) {
  return fmt::format("light_source {{ {} {} {}{}{} }}\n", at(context, position),
                     intensity_color(context, intensity), words, fading(context), no_photons(context));
}

std::string text_of(Context& context, const PointLight& light, const Origin&) {
  return fmt::format("light_source {{ {} {}{} }}\n", at(context, light.position), strength(context, light),
                     no_photons(context));
}

std::string text_of(Context& context, const SpotLight& light, const Origin& origin) {
  if (light.falloff != SpotLight::Falloff::smoothstep)
    context.approximated("falloff of a spot light: smoothstep of the cosine between the same angles", origin);
  if (light.texture) context.approximated("texture of a spot light: without it", origin);
  const Point3d from = transform_point(light.light_to_world, {0, 0, 0});
  const Vector3d axis = normalize(transform_vector(light.light_to_world, {0, 0, 1}));
  if (light.cutoff_deg > 90)
    context.approximated("spot light of more than 90 degrees: POV-Ray's end there", origin);
  return fmt::format("light_source {{ {} {} spotlight radius {} falloff {} tightness {} point_at {}{} }}\n",
                     at(context, from), strength(context, light), std::min(light.beam_deg, 90.0f),
                     std::min(light.cutoff_deg, 90.0f), light.tightness,
                     at(context, from + axis * context.units.radius), no_photons(context));
}

std::string text_of(Context& context, const DistantLight& light, const Origin&) {
  const Point3d target = context.units.center;
  const Point3d from = target - normalize(light.direction) * (4 * context.units.radius);
  return fmt::format("light_source {{ {} {} parallel point_at {}{} }}\n", at(context, from),
                     color(signed_emission_rgb(light.irradiance) * (1 / pi)), at(context, target),
                     no_photons(context));
}

std::string text_of(Context& context, const ProjectionLight& light, const Origin& origin) {
  try {
    return shaded_light(context, light, point, origin);
  } catch (const Error& error) {
    context.dropped(fmt::format("projection light: {}", error.what()), origin);
    return "";
  }
}

std::string text_of(Context& context, const GoniometricLight& light, const Origin& origin) {
  try {
    return shaded_light(context, light, point, origin);
  } catch (const Error&) {
    const EvenLight even = even_light(light);
    context.approximated(even.note, origin);
    return point(context, transform_point(light.light_to_world, {0, 0, 0}),
                 signed_emission_rgb(even.intensity), "");
  }
}

std::string text_of(Context&, const InfiniteLight& light, const Origin&) {
  return fmt::format("background {{ {} }}\n", color(signed_emission_rgb(light.radiance)));
}

std::string text_of(Context& context, const EnvironmentLight& light, const Origin& origin) {
  return environment_text(context, light, origin);
}

std::string text_of(Context& context, const SkyLight& light, const Origin& origin) {
  const std::filesystem::path file = std::filesystem::absolute(context.images.new_file());
  context.approximated("sky: its image in linear sRGB, and the sun as parallel light", origin);
  std::string text;
  for (const LightModel& part : sky_as_image(light, EnvironmentLight::Projection::latitude_longitude, file))
    std::visit([&](const auto& model) { text += text_of(context, model, origin); }, part);
  return text;
}

bool is_rgb_light(const LightModel& model) {
  if (const auto* l = std::get_if<PointLight>(&model)) return is_rgb(l->intensity);
  if (const auto* l = std::get_if<SpotLight>(&model)) return is_rgb(l->intensity);
  if (const auto* l = std::get_if<DistantLight>(&model)) return is_rgb(l->irradiance);
  if (const auto* l = std::get_if<InfiniteLight>(&model)) return is_rgb(l->radiance);
  return true;
}

// One lamp; or with caustics four, each a quarter. POV-Ray shoots photons from the middle of a lamp. Its own
// `area_light` of photons has one pattern of few for each of its points: floors beside mirrors are 30 % dark
// and twice as bright.
std::string facing(const Context& context, const Rectangle& r, Vector3d front, RGB radiance) {
  const int parts = context.has_caustics ? 2 : 1, n = 16 / parts;
  const Vector3d u = r.edge_u * (1.0 / parts), v = r.edge_v * (1.0 / parts);
  const double f = fade_distance(context), area = length(u) * length(v);
  // A little in front: in its own plane POV-Ray lights the back of the mesh that shows it, without bounds.
  const double before = 1e-4 * std::min(length(r.edge_u), length(r.edge_v));
  // POV-Ray puts the first and the last light on the ends of the axes; samples belong in the middle of cells.
  const double inner = (n - 1.0) / n;
  // In media POV-Ray 3.7 sees neither the fading nor the cosine of area_illumination: all comes from the
  // middle.
  const char* const from_all = context.has_scattering ? "" : "area_illumination on ";
  const char* const photons = context.has_caustics ? " photons { reflection on refraction on }" : "";
  std::string text;
  for (int i = 0; i < parts * parts; ++i) {
    const int column = i % parts, row = i / parts;
    const Point3d middle = r.corner + u * (column + 0.5) + v * (row + 0.5) + front * before;
    text += fmt::format(
        "light_source {{ {} {} spotlight radius 90 falloff 90 tightness 1 point_at {}\n  area_light {}, {}, "
        "{}, {} adaptive {} {}{}{} }}\n",
        vector(middle), color(radiance * (area / (2 * pi * f * f))),
        vector(middle + front * length(r.edge_u)), vector(u * inner), vector(v * inner), n, n, 2 / parts,
        from_all, fading(context), photons);
  }
  return text;
}

}  // namespace

std::string light_text(Context& context, const Light& light) {
  if (!is_rgb_light(light.model))
    context.approximated("spectrum of a light: written as its colour in linear sRGB", light.origin);
  return std::visit([&](const auto& model) { return text_of(context, model, light.origin); }, light.model);
}

std::string rectangle_light_text(Context& context, const Rectangle& rectangle, const AreaLight& light) {
  const RGB radiance =
      signed_emission_rgb(std::get<Spectrum>(light.radiance)) * static_cast<double>(light.scale);
  std::string text = facing(context, rectangle, rectangle.front, radiance);
  if (light.two_sided) text += facing(context, rectangle, -rectangle.front, radiance);
  return text;
}

}  // namespace vitrail::povray
