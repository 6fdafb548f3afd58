// SPDX-License-Identifier: Apache-2.0
// What shapes say of their materials, with and without light of their own.
#include "importers/export_colors.h"
#include "importers/povray/materials.h"
#include "importers/povray/pigments.h"

namespace vitrail::povray {

namespace {

bool is_black(const Scene& scene, Id<Material> material) {
  const auto* diffuse = std::get_if<DiffuseMaterial>(&scene.materials.at(material.value).model);
  const auto* reflectance = diffuse ? std::get_if<Spectrum>(&diffuse->reflectance) : nullptr;
  return is_invisible(scene, material) || (reflectance && largest(factor_rgb(*reflectance)) == 0);
}

}  // namespace

std::string use_of(const Context&, Id<Material> material, const Surface& surface) {
  std::string text = fmt::format("texture {{ Material_{} }}", material.value);
  if (!surface.back.empty()) text += fmt::format(" interior_texture {{ Back_{} }}", material.value);
  if (!surface.interior.empty()) text += fmt::format(" interior {{ Interior_{} }}", material.value);
  return text + "\n";
}

std::string emitter_of(Context& context, Id<Material> material, const Surface& surface,
                       const AreaLight& light) {
  if (light.directional)
    context.approximated("light along the normal only: shines in all directions", light.origin);
  const double factor = context.scene.film.imaging_ratio * light.scale;
  const Pigment radiance = pigment_of(context, light.radiance, light.origin, Colors::emissions);
  if (!radiance.filters.empty())
    context.approximated("product of textures that shines: its first factor", light.origin);
  // The emission of a pigment is multiplied by its colour.
  const std::string emission = fmt::format(
      "pigment {{ {} }} finish {{ diffuse 0 emission {} }}", radiance.is_constant ? "rgb 1" : radiance.text,
      color(radiance.is_constant ? radiance.constant * factor : RGB{1, 1, 1} * (factor * radiance.factor)));
  std::string text;
  if (is_black(context.scene, material)) {
    text = fmt::format("texture {{ {} }}\n", emission);
  } else {  // an average is the sum over the sum of its weights, which may be negative
    text = fmt::format("texture {{ average texture_map {{ [1 Material_{}] [1 {}] [-1 Black] }} }}\n",
                       material.value, emission);
    if (!surface.interior.empty()) text += fmt::format("interior {{ Interior_{} }}\n", material.value);
  }
  if (light.two_sided) return text;
  return text + fmt::format("interior_texture {{ {}_{} }}\n", surface.back.empty() ? "Material" : "Back",
                            material.value);
}

}  // namespace vitrail::povray
