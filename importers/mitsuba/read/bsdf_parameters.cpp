// SPDX-License-Identifier: Apache-2.0
// What many BSDFs have: reflectances, roughness, and the BSDFs that are nested in them.
#include <fmt/format.h>

#include "importers/mitsuba/read/bsdf_models.h"

namespace vitrail::mitsuba {

Roughness roughness_of(Builder& b, const Object& o) {
  Roughness r;
  const std::string distribution = o.text("distribution", "beckmann", b.report);
  r.distribution = distribution == "ggx" ? Roughness::Distribution::ggx : Roughness::Distribution::beckmann;
  if (distribution != "ggx" && distribution != "beckmann")
    b.report.approximated(fmt::format("distribution \"{}\" becomes \"beckmann\"", distribution), o.origin);
  r.alpha_u = r.alpha_v = float_parameter(b, o, "alpha", 0.1);
  if (o.has("alpha_u")) r.alpha_u = float_parameter(b, o, "alpha_u", 0.1);
  if (o.has("alpha_v")) r.alpha_v = float_parameter(b, o, "alpha_v", 0.1);
  o.ignore({"sample_visible"});
  return r;
}

SpectrumParameter reflectance(Builder& b, const Object& o, const char* name, double otherwise) {
  return spectrum_parameter(b, o, name, Quantity::reflectance,
                            ConstantSpectrum{static_cast<float>(otherwise)});
}

SpectrumParameter factor(Builder& b, const Object& o, const char* name) {
  return spectrum_parameter(b, o, name, Quantity::unbounded, ConstantSpectrum{1});
}

SpectrumParameter times(Builder& b, const SpectrumParameter& value, const Spectrum& factor,
                        const Origin& origin) {
  if (const auto* spectrum = std::get_if<Spectrum>(&value)) return product(*spectrum, factor);
  b.scene.textures.push_back({ProductTexture{value, factor}, false, "", origin});
  return Id<Texture>{static_cast<std::uint32_t>(b.scene.textures.size() - 1)};
}

SpectrumParameter times(Builder& b, const SpectrumParameter& value, double factor, const Origin& origin) {
  return times(b, value, ConstantSpectrum{static_cast<float>(factor)}, origin);
}

std::vector<Id<Material>> nested_materials(Builder& b, const Object& o, std::size_t least, std::size_t most) {
  std::vector<Id<Material>> ids;
  for (const Property* child : o.children("bsdf"))
    ids.push_back(add_material(b, *std::get<ObjectPtr>(child->value)));
  if (ids.size() < least || ids.size() > most)
    b.report.fail(fmt::format("\"{}\" needs {} nested bsdf{}, has {}", o.type, least, least == 1 ? "" : "s",
                              ids.size()),
                  o.origin);
  return ids;
}

}  // namespace vitrail::mitsuba
