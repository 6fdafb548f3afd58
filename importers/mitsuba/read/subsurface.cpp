// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/read/subsurface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "importers/mitsuba/read/index_of_refraction.h"
#include "importers/reading/suggestion.h"
#include "scene/models/measured_media.h"

namespace vitrail::mitsuba {

namespace {

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

// As measured_medium knows it: 0.6 looks at no capitals, and spells two names in its own way.
std::string measured_name(Builder& b, const Object& o) {
  const std::string wanted = lower(o.text("material", "Skin1", b.report));
  if (wanted == "budweiser beder") return "Budweiser Beer";
  if (wanted == "orange juice powder") return "Orange Powder";
  const std::vector<std::string> names = measured_media();
  const auto found = std::ranges::find(names, wanted, lower);
  if (found == names.end())
    b.report.fail(
        fmt::format("no measured medium is known by the name \"{}\"{}", wanted, suggestion(wanted, names)),
        o.has("material") ? o.find("material")->origin : o.origin);
  return *found;
}

// The roughness of what lets light under a surface, and whether nothing else is in it.
struct Interface {
  Roughness roughness;
  bool is_alone = false;
};
Interface interface_of(const Material& material) {
  if (const auto* plastic = std::get_if<PlasticMaterial>(&material.model))
    return {plastic->roughness, plastic->diffuse_reflectance == SpectrumParameter{ConstantSpectrum{0}}};
  if (const auto* glass = std::get_if<DielectricMaterial>(&material.model)) return {glass->roughness, true};
  return {};
}

}  // namespace

AbsorptionScattering measured_coefficients(Builder& b, const Object& o) {
  constexpr double unit = 100;
  const std::string name = measured_name(b, o);
  AbsorptionScattering c = *measured_medium(name);
  for (VolumeParameter* v : {&c.sigma_a, &c.sigma_s}) *v = scaled(std::get<Spectrum>(*v), unit);
  return c;
}

std::optional<Id<Material>> subsurface_material(Builder& b, const Object& shape, Id<Material> surface) {
  const Object* o = shape.child("subsurface");
  if (!o) return std::nullopt;
  const Report::Item before = b.report.begin_item({o->origin, RecordKind::material});
  const Interface around = interface_of(b.scene.materials.at(surface.value));
  SubsurfaceMaterial m;
  m.roughness = around.roughness;
  AbsorptionScattering c;
  if (o->has("sigma_t") || o->has("albedo")) {
    const Spectrum sigma_t = spectrum_value(b, *o, "sigma_t", Quantity::unbounded, ConstantSpectrum{1}),
                   albedo = spectrum_value(b, *o, "albedo", Quantity::reflectance, ConstantSpectrum{0.75f});
    c.sigma_s = product(sigma_t, albedo);
    c.sigma_a = weighted_sum(sigma_t, 1, product(sigma_t, albedo), -1);
  } else {
    c = measured_coefficients(b, *o);
    for (const auto& [name, v] : {std::pair{"sigma_a", &c.sigma_a}, {"sigma_s", &c.sigma_s}})
      *v = spectrum_value(b, *o, name, Quantity::unbounded, std::get<Spectrum>(*v));
  }
  // A dipole knows the reduced scattering alone.
  const double forwards = o->number("g", 0, b.report);
  m.interior = SubsurfaceMaterial::Coefficients{std::get<Spectrum>(c.sigma_a),
                                                scaled(std::get<Spectrum>(c.sigma_s), 1 - forwards)};
  m.scale = static_cast<float>(o->number("scale", 1, b.report));
  m.eta = ConstantSpectrum{static_cast<float>(measured_medium_eta(measured_name(b, *o)))};
  if (o->has("int_ior") || o->has("ext_ior"))
    m.eta = ConstantSpectrum{index_of(b, *o, "int_ior", "bk7") / index_of(b, *o, "ext_ior", "air")};
  b.report.approximated(
      fmt::format("\"{}\" becomes transport in the interior: every order of scattering, in its own shape",
                  o->type),
      o->origin);
  if (!around.is_alone)
    b.report.approximated("the bsdf around an interior becomes a dielectric boundary", o->origin);
  o->ignore({"irr_samples", "irr_indirect", "quality", "sample_multiplier"});
  report_unused(*o, b.report,
                {"material", "sigma_s", "sigma_a", "sigma_t", "albedo", "scale", "int_ior", "ext_ior", "g"});
  Material material{std::move(m)};
  material.origin = o->origin;
  b.report.begin_item(before);
  return append(b, std::move(material));
}

}  // namespace vitrail::mitsuba
