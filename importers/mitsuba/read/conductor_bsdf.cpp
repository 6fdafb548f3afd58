// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "importers/mitsuba/read/bsdf_models.h"
#include "importers/mitsuba/read/index_of_refraction.h"
#include "importers/reading/suggestion.h"
#include "scene/spectra/named_spectra.h"

namespace vitrail::mitsuba {

namespace {

// Mitsuba takes the number in its rgb variants; its spectral ones bring it into [0,1] as a reflectance.
void note_numbers_above_one(Builder& b, const Object& o, const char* name, const SpectrumParameter& value) {
  const auto* spectrum = std::get_if<Spectrum>(&value);
  const auto* colour = spectrum ? std::get_if<RgbUnboundedSpectrum>(spectrum) : nullptr;
  if (colour && std::ranges::max(colour->rgb) > 1)
    b.report.approximated(
        fmt::format("{} above 1 as an rgb: as it is, as in Mitsuba's rgb variants; its spectral ones take 1",
                    name),
        place_of(o, name));
}

SpectrumParameter index_part(Builder& b, const Object& o, const char* name, float otherwise) {
  SpectrumParameter value = spectrum_parameter(b, o, name, Quantity::unbounded, ConstantSpectrum{otherwise});
  note_numbers_above_one(b, o, name, value);
  return value;
}

Metal metal_of(Builder& b, const Object& o) {
  if (o.has("eta") || o.has("k")) return ComplexIndex{index_part(b, o, "eta", 0), index_part(b, o, "k", 1)};
  const std::string name = o.text("material", "none", b.report);
  if (name == "none") return PerfectReflector{};
  const std::string eta = fmt::format("metal-{}-eta", name), k = fmt::format("metal-{}-k", name);
  if (named_spectrum(eta) && named_spectrum(k)) return ComplexIndex{NamedSpectrum{eta}, NamedSpectrum{k}};
  std::vector<std::string> known{"none"};
  for (const std::string& other : spectrum_names())
    if (other.starts_with("metal-") && other.ends_with("-k"))
      known.push_back(other.substr(6, other.size() - 8));
  b.report.approximated(fmt::format("no metal is known by the name \"{}\": copper stands for it{}", name,
                                    suggestion(name, known)),
                        o.origin);
  return ComplexIndex{};
}

// 0.6: the index around a metal divides the metal's.
void divide_by_exterior(Builder& b, const Object& o, Metal& metal) {
  const char* const name = o.has("ext_eta") ? "ext_eta" : "ext_ior";
  if (!o.has(name)) return;
  const bool is_named = std::holds_alternative<std::string>(o.find(name)->value);
  const double around = is_named
                            ? static_cast<double>(index_of(b, o, name, "air"))
                            : luminance(spectrum_value(b, o, name, Quantity::unbounded, ConstantSpectrum{1}));
  auto* index = std::get_if<ComplexIndex>(&metal);
  if (!index || around == 1 || !(around > 0)) return;
  for (SpectrumParameter* part : {&index->eta, &index->k})
    if (auto* spectrum = std::get_if<Spectrum>(part))
      *spectrum = scaled(resolved(*spectrum), 1 / around);
    else
      b.report.approximated("the index around a metal becomes 1", o.origin);
}

}  // namespace

MaterialModel conductor(Builder& b, const Object& o) {
  ConductorMaterial m;
  m.metal = metal_of(b, o);
  divide_by_exterior(b, o, m.metal);
  if (o.type == "roughconductor") m.roughness = roughness_of(b, o);
  m.reflectance_factor = factor(b, o, "specular_reflectance");
  return m;
}

}  // namespace vitrail::mitsuba
