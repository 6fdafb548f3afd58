// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/write/write_media.h"

#include <algorithm>

#include "importers/writing/export_colors.h"
#include "scene/models/measured_media.h"

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
  if (!std::holds_alternative<std::monostate>(medium.density) || medium.temperature || medium.emission_scale)
    return std::nullopt;
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

}  // namespace

std::string media_text(Context& context, std::optional<Id<Medium>> id) {
  if (!id) return "";
  const auto [known, is_new] = context.media.try_emplace(id->value);
  if (!is_new) return known->second;
  const Medium& medium = context.scene.media.at(id->value);
  const std::optional<Colors> colors = colors_of(medium);
  if (!colors) {
    context.dropped(fmt::format("medium {}: its space is written as empty", medium.name), medium.origin);
    return "";
  }
  const double scale = static_cast<double>(medium.scale), per_unit = scale / context.units.scale;
  std::string text = fmt::format("absorption {}", color(colors->absorption * per_unit));
  if (largest(colors->scattering) > 0) {
    context.has_scattering = true;
    context.approximated(
        fmt::format("medium {}: POV-Ray's media scatter the light of its light sources, once", medium.name),
        medium.origin);
    // A lamp of colour c, which has π·c on a surface, shows c·s·d where σ_s = s would show a fourth of it.
    const std::string strength = color(colors->scattering * (per_unit / 4));
    text += medium.g == 0
                ? fmt::format(" scattering {{ 1, {} extinction 4 }}", strength)
                : fmt::format(" scattering {{ 5, {} eccentricity {} extinction 4 }}", strength, medium.g);
  }
  if (!colors->as_rgb)
    context.approximated(fmt::format("medium {}: its spectra are written as colours", medium.name),
                         medium.origin);
  if (medium.emission)
    text += fmt::format(" emission {}", color(emission_rgb(*medium.emission) * colors->absorption *
                                              (per_unit * static_cast<double>(medium.emission_factor))));
  return known->second = fmt::format("media {{ method 3 intervals 4 samples 16 {} }}", text);
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
