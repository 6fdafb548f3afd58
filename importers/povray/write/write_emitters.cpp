// SPDX-License-Identifier: Apache-2.0
// What shapes say of their materials, with and without light of their own.
#include "importers/povray/write/write_materials.h"
#include "importers/povray/write/write_pigments.h"
#include "importers/writing/export_colors.h"
#include "scene/records/curve_uses.h"

namespace vitrail::povray {

namespace {

bool is_black(const Scene& scene, Id<Material> material) {
  const auto* diffuse = std::get_if<DiffuseMaterial>(&scene.materials.at(material.value).model);
  const auto* reflectance = diffuse ? std::get_if<Spectrum>(&diffuse->reflectance) : nullptr;
  return reflectance && largest(factor_rgb(*reflectance)) == 0;
}

}  // namespace

std::string weighted(Context& context, const FloatParameter& amount, const std::string& at_0,
                     const std::string& at_1, const Origin& user) {
  if (const auto* id = std::get_if<Id<Texture>>(&amount))
    if (const auto pattern = pattern_of(context, *id, user))
      return fmt::format("texture {{ {} texture_map {{ [0 {}] [1 {}] }}{} }}\n", pattern->text, at_0, at_1,
                         pattern->transform);
  const double weight = std::clamp(constant_of(context, amount, "amount of a blend", user), 0.0, 1.0);
  if (weight == 0 || weight == 1) return fmt::format("texture {{ {} }}\n", weight == 0 ? at_0 : at_1);
  return fmt::format("texture {{ average texture_map {{ [{} {}] [{} {}] }} }}\n", 1 - weight, at_0, weight,
                     at_1);
}

std::string use_of(Context& context, const Shape& shape, const Surface& surface, bool inside_out,
                   const std::string& media) {
  const auto there = [&](const char* name) {
    return weighted(context, shape.opacity, "Clear", fmt::format("{}_{}", name, shape.material.value),
                    shape.origin);
  };
  std::string text = there("Material");
  // A ray meets a curve once, and the tube in its place where it comes in and where it leaves.
  if (shape.opacity != FloatParameter{1.0f} && is_of_curves(context.scene, shape))
    text += "interior_texture { Clear }\n";
  else if (!surface.back.empty())
    text += "interior_" + there("Back");
  const std::string interior =
      surface.interior.empty()
          ? ""
          : fmt::format("{}_{} ", inside_out ? "Turned" : "Interior", shape.material.value);
  if (!interior.empty() || !media.empty()) text += fmt::format("interior {{ {}{} }}\n", interior, media);
  return media.empty() ? text : text + "hollow ";  // POV-Ray's media fill nothing else
}

std::string emitter_of(Context& context, const Shape& shape, const Surface& surface, const AreaLight& light) {
  if (light.directional)
    context.approximated("light along the normal only: shines in all directions", light.origin);
  const std::uint32_t material = shape.material.value;
  const double factor = static_cast<double>(light.scale);
  const Pigment radiance = pigment_of(context, light.radiance, light.origin, Colors::emissions);
  if (!radiance.filters.empty())
    context.approximated("product of textures that shines: its first factor", light.origin);
  // The emission of a pigment is multiplied by its colour.
  const std::string emission = fmt::format(
      "pigment {{ {} }} finish {{ diffuse 0 emission {} }}", radiance.is_constant ? "rgb 1" : radiance.text,
      color(radiance.is_constant ? radiance.constant * factor : RGB{1, 1, 1} * (factor * radiance.factor)));
  const auto there = [&](const std::string& texture) {
    return weighted(context, shape.opacity, "Clear", texture, shape.origin);
  };
  std::string text;
  if (is_black(context.scene, shape.material)) {
    text = there(emission);
  } else {  // an average is the sum over the sum of its weights, which may be negative
    text =
        there(fmt::format("average texture_map {{ [1 Material_{}] [1 {}] [-1 Black] }}", material, emission));
    if (!surface.interior.empty()) text += fmt::format("interior {{ Interior_{} }}\n", material);
  }
  if (light.two_sided) return text;
  const bool has_back = !surface.back.empty() && !is_invisible(context.scene, shape.material);
  return text + "interior_" + there(fmt::format("{}_{}", has_back ? "Back" : "Material", material));
}

}  // namespace vitrail::povray
