// SPDX-License-Identifier: Apache-2.0
// What shapes say of their materials, with and without light of their own.
#include <algorithm>

#include "importers/povray/materials.h"
#include "importers/povray/pigments.h"

namespace vitrail::povray {

namespace {

// The emission K·pigment of a surface that also reflects the pigment.
std::string shining(const std::string& pigment, RGB factor, const char* diffuse) {
  return fmt::format("texture {{ pigment {{ {} }} finish {{ {}emission {} }} }}\n", pigment, diffuse,
                     color(factor));
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
  const double factor = context.scene.film.imaging_ratio * light.scale;
  const Pigment radiance = pigment_of(context, light.radiance, light.origin, Colors::emissions);
  const auto* diffuse = std::get_if<DiffuseMaterial>(&context.scene.materials.at(material.value).model);
  const Pigment base = diffuse ? pigment_of(context, diffuse->reflectance, light.origin) : Pigment{};
  std::string front;
  if (radiance.is_constant && base.is_constant &&
      std::min({base.constant.r, base.constant.g, base.constant.b}) > 0) {
    const RGB l = radiance.constant * factor, k = base.constant;
    front = shining(base.text, {l.r / k.r, l.g / k.g, l.b / k.b}, "");
  } else {
    const bool is_black = base.is_constant && largest(base.constant) == 0;
    if (!is_black)
      context.approximated("light of a surface that reflects: without the reflection", light.origin);
    front = radiance.is_constant
                ? shining("rgb 1", radiance.constant * factor, "diffuse 0 ")
                : shining(radiance.text, RGB{1, 1, 1} * (factor * radiance.factor), "diffuse 0 ");
  }
  if (light.directional)
    context.approximated("light along the normal only: shines in all directions", light.origin);
  if (light.two_sided) return front;
  return front + fmt::format("interior_texture {{ {}_{} }}\n", surface.back.empty() ? "Material" : "Back",
                             material.value);
}

}  // namespace vitrail::povray
