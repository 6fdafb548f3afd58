// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/write/write_media.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "images/texture_values.h"
#include "importers/images/environment_images.h"
#include "importers/povray/write/density_files.h"
#include "importers/writing/export_colors.h"
#include "importers/writing/medium_grids.h"
#include "scene/models/measured_media.h"
#include "scene/system/diagnostics.h"

namespace vitrail::povray {

namespace {

// Per unit of the scene's length.
struct Colors {
  RGB absorption, scattering;
  bool as_rgb = true;  // whether no spectrum was lost
};

std::optional<Colors> colors_of(const VolumeParameter& first, const VolumeParameter& second,
                                bool are_extinction_and_albedo) {
  const auto* const a = std::get_if<Spectrum>(&first);
  const auto* const b = std::get_if<Spectrum>(&second);
  if (!a || !b) return std::nullopt;
  const RGB x = factor_rgb(*a), y = factor_rgb(*b);
  const bool as_rgb = is_rgb(*a) && is_rgb(*b);
  if (!are_extinction_and_albedo) return Colors{x, y, as_rgb};
  return Colors{x * RGB{1 - y.r, 1 - y.g, 1 - y.b}, x * y, as_rgb};
}

std::optional<Colors> colors_of(const Medium& medium) {
  if (const auto* m = std::get_if<AbsorptionScattering>(&medium.coefficients))
    return colors_of(m->sigma_a, m->sigma_s, false);
  if (const auto* m = std::get_if<ExtinctionAlbedo>(&medium.coefficients))
    return colors_of(m->sigma_t, m->albedo, true);
  const auto measured = measured_medium(std::get<NamedMedium>(medium.coefficients).name);
  return measured ? colors_of(measured->sigma_a, measured->sigma_s, false) : std::nullopt;
}

bool holds(const Scene& scene, Id<Medium> medium) {
  const auto among = [&](const std::vector<Shape>& shapes) {
    return std::ranges::any_of(shapes, [&](const Shape& shape) { return shape.interior == medium; });
  };
  return among(scene.shapes) || std::ranges::any_of(scene.prototypes, [&](const Prototype& prototype) {
           return among(prototype.shapes);
         });
}

// What one "media" says: coefficients, and the density that multiplies both.
struct Part {
  std::string density;
  RGB absorption, scattering;
};
struct Parts {
  std::vector<Part> parts;
  bool as_rgb = true;  // whether no spectrum was lost
};

// Of colours, times a density where there is one.
Parts of_colors(Context& context, const Medium& medium, const Colors& colors) {
  const auto* density = std::get_if<Grid>(&medium.density);
  if (!density) return {{{"", colors.absorption, colors.scattering}}, colors.as_rgb};
  Parts result{{}, colors.as_rgb};
  for (const DensityPart& part : density_parts(context, *density, medium.medium_to_world))
    result.parts.push_back({part.density, part.color * colors.absorption, part.color * colors.scattering});
  return result;
}

VolumeParameter times_density(const Medium& medium, const VolumeParameter& value) {
  const auto* density = std::get_if<Grid>(&medium.density);
  return density ? combined_cells(*density, value, std::multiplies<>()) : value;
}

// A coefficient as parts, of which `member` has its colour.
void add_parts(Context& context, const Medium& medium, const VolumeParameter& value, RGB Part::*member,
               std::vector<Part>& parts) {
  const VolumeParameter whole = times_density(medium, value);
  std::vector<DensityPart> found;
  if (const auto* grid = std::get_if<Grid>(&whole))
    found = density_parts(context, *grid, medium.medium_to_world);
  else
    found = {{"", factor_rgb(std::get<Spectrum>(whole))}};
  for (const DensityPart& part : found) {
    if (!(largest(part.color) > 0)) continue;
    parts.push_back({part.density, {}, {}});
    parts.back().*member = part.color;
  }
}

// Where the coefficients are grids themselves.
Parts of_grids(Context& context, const Medium& medium) {
  Parts result;
  const auto add = [&](const VolumeParameter& absorption, const VolumeParameter& scattering) {
    add_parts(context, medium, absorption, &Part::absorption, result.parts);
    add_parts(context, medium, scattering, &Part::scattering, result.parts);
  };
  if (const auto* m = std::get_if<AbsorptionScattering>(&medium.coefficients)) {
    add(m->sigma_a, m->sigma_s);
    result.as_rgb = !becomes_color(m->sigma_a) && !becomes_color(m->sigma_s);
  } else {
    const auto& of = std::get<ExtinctionAlbedo>(medium.coefficients);
    const auto cells = [&](auto&& f) { return combined_cells(of.sigma_t, of.albedo, f); };
    add(cells([](double t, double a) { return t * (1 - a); }), cells(std::multiplies<>()));
    result.as_rgb = !becomes_color(of.sigma_t) && !becomes_color(of.albedo);
  }
  return result;
}

std::optional<Parts> parts_of(Context& context, const Medium& medium) {
  if (std::holds_alternative<CloudDensity>(medium.density) || medium.temperature || medium.emission_scale)
    return std::nullopt;
  try {
    if (const std::optional<Colors> colors = colors_of(medium)) return of_colors(context, medium, *colors);
    if (std::holds_alternative<NamedMedium>(medium.coefficients)) return std::nullopt;
    return of_grids(context, medium);
  } catch (const Error& error) {
    context.approximated(fmt::format("medium {}: {}", medium.name, error.what()), medium.origin);
    return std::nullopt;
  }
}

// The mean radiance that comes from all around.
RGB light_from_around(const Context& context) {
  RGB sum{0, 0, 0};
  const auto add = [&](RGB c) { sum = {sum.r + c.r, sum.g + c.g, sum.b + c.b}; };
  for (const Light& light : context.exposed.lights) {
    if (const auto* l = std::get_if<InfiniteLight>(&light.model)) add(signed_emission_rgb(l->radiance));
    if (const auto* l = std::get_if<EnvironmentLight>(&light.model)) try {
        const Image image = texture_values(image_of(*l), read_stored_image(l->filename), ImageUse::light);
        const double up = l->illuminance ? upward_illuminance(image, l->projection) : 0;
        const double factor = up > 0 ? static_cast<double>(*l->illuminance) / up : 1;
        add(factor_rgb(l->scale) * (factor * total_flux(image, l->projection) / (4 * std::numbers::pi)));
      } catch (const Error&) {  // which the light says
      }
  }
  return sum;
}

// Of light from all around that a medium scatters, as a share of what it would without absorption: between
// thin, 1, and half of all space, whose spherical albedo is van de Hulst's (1980, "Multiple Light
// Scattering"), by its reduced albedo. A third of the scene's radius stands for its size.
double scattered_share(const Context& context, const Medium& medium, double absorption, double scattering) {
  if (!(scattering > 0)) return 1;
  const double reduced = scattering * (1 - static_cast<double>(medium.g)),
               albedo = reduced / (reduced + absorption);
  const double s = std::sqrt(1 - albedo), whole = (1 - s) * (1 - 0.139 * s) / (1 + 1.17 * s);
  const double size = static_cast<double>(medium.scale) * context.units.radius / 3;
  return std::lerp(whole / albedo, 1.0, std::exp(-(absorption + scattering) * size));
}

// What shines in it, with the light from all around that it scatters: POV-Ray's scatter that of sources
// alone.
RGB glow_of(const Context& context, const Medium& medium, const Part& part) {
  const auto share = [&](double a, double b) { return scattered_share(context, medium, a, b); };
  const RGB a = part.absorption, b = part.scattering;
  const RGB scattered =
      RGB{share(a.r, b.r), share(a.g, b.g), share(a.b, b.b)} * b * light_from_around(context);
  if (!medium.emission) return scattered;
  const RGB own =
      signed_emission_rgb(*medium.emission) * part.absorption * static_cast<double>(medium.emission_factor);
  return {scattered.r + own.r, scattered.g + own.g, scattered.b + own.b};
}

std::string text_of(const Context& context, const Medium& medium, const Part& part) {
  const double per_unit = static_cast<double>(medium.scale) / context.units.scale;
  std::string text = fmt::format("absorption {}", color(part.absorption * per_unit));
  if (largest(part.scattering) > 0) {
    // A lamp of colour c, which has π·c on a surface, shows c·s·d where σ_s = s would show a fourth of it.
    const std::string strength = color(part.scattering * (per_unit / 4));
    text += medium.g == 0
                ? fmt::format(" scattering {{ 1, {} extinction 4 }}", strength)
                : fmt::format(" scattering {{ 5, {} eccentricity {} extinction 4 }}", strength, medium.g);
  }
  if (const RGB glow = glow_of(context, medium, part) * per_unit; largest(glow) > 0)
    text += fmt::format(" emission {}", color(glow));
  // POV-Ray takes each of its steps by what comes from the step's near end: 8 % too bright of optical depth
  // .1 a step (measured). 32 steps cost a camera within a thin medium no time; dense ones need 64.
  const double depth = (largest(part.absorption) + largest(part.scattering)) *
                       static_cast<double>(medium.scale) * context.units.radius;
  const int samples = std::clamp(static_cast<int>(40 * depth), 32, 64);
  return fmt::format("media {{ method 3 intervals 1 samples {} {}{} }}", samples, text,
                     part.density.empty() ? "" : "\n  " + part.density);
}

// Of light that scatters again and again, an albedo of a brings back up to a/(1 - a) times what scatters
// once.
std::string lost_in(const Medium& medium) {
  const std::optional<Colors> colors = colors_of(medium);
  if (!colors) return "";
  const double scattered = mean(colors->scattering), all = scattered + mean(colors->absorption);
  return all > 0 ? fmt::format("; its albedo is {:.3g}", scattered / all) : "";
}

}  // namespace

std::string media_text(Context& context, std::optional<Id<Medium>> id) {
  if (!id) return "";
  const auto [known, is_new] = context.media.try_emplace(id->value);
  if (!is_new) return known->second;
  const Medium& medium = context.scene.media.at(id->value);
  const std::optional<Parts> parts = parts_of(context, medium);
  if (!parts) {
    context.dropped(fmt::format("medium {}: its space is written as empty", medium.name), medium.origin);
    return "";
  }
  std::vector<std::string> all;  // POV-Ray adds up the media of an interior
  bool scatters = false;
  for (const Part& part : parts->parts) {
    scatters |= largest(part.scattering) > 0;
    all.push_back(text_of(context, medium, part));
  }
  if (scatters) {
    context.has_scattering = true;
    context.approximated(
        fmt::format(
            "medium {}: POV-Ray's media scatter the light of its light sources, once; of the light from "
            "all around they shine alike everywhere, as if none were hidden{}",
            medium.name, lost_in(medium)),
        medium.origin);
  }
  if (!parts->as_rgb)
    context.approximated(fmt::format("medium {}: its spectra are written as colours", medium.name),
                         medium.origin);
  return known->second = fmt::format("{}", fmt::join(all, "\n"));
}

std::optional<Id<Medium>> medium_inside(const Scene& scene, const Shape& shape, const MeshText& mesh) {
  if (shape.interior == shape.exterior) return std::nullopt;  // of a surface within it
  const auto inside = is_inside_out(mesh) ? shape.exterior : shape.interior;
  return inside == medium_around(scene) ? std::nullopt : inside;
}

std::optional<Id<Medium>> medium_around(const Scene& scene) {
  const auto medium = scene.camera_medium;
  return medium && !holds(scene, *medium) ? medium : std::nullopt;
}

}  // namespace vitrail::povray
