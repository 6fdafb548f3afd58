// SPDX-License-Identifier: Apache-2.0
// The makers of v3's and v4's materials share these functions.
#pragma once

#include <fmt/format.h>

#include "importers/pbrt/read/materials.h"

namespace vitrail::pbrt {

struct MaterialMaker {
  const std::string& kind;
  ParameterSet& parameters;
  const Scope& scope;
  const MaterialSlots& slots;

  bool v3() const { return scope.context.version == Version::v3; }
  SpectrumParameter reflectance(std::initializer_list<std::string_view> names, double otherwise) const {
    return spectrum_parameter(parameters, names, Quantity::reflectance, grey(otherwise), scope);
  }
  SpectrumParameter unbounded(std::initializer_list<std::string_view> names,
                              const Spectrum& otherwise) const {
    return spectrum_parameter(parameters, names, Quantity::unbounded, otherwise, scope);
  }
  FloatParameter number(std::string_view name, double otherwise) const {
    return float_parameter(parameters, {name}, otherwise, scope);
  }
  // Reads an index of refraction; v3 calls it index.
  Spectrum index(std::initializer_list<std::string_view> names, double otherwise) const {
    return spectrum_value(parameters, names, Quantity::refraction, grey(otherwise), scope);
  }
  // Reads "roughness", "uroughness", "vroughness" after `prefix`.
  Roughness roughness(double otherwise, const std::string& prefix = "") const;
  // Reads a metal by eta and k, or the reflectance, after `prefix`; it is copper where nothing is given.
  Metal metal(const std::string& prefix = "") const;
  CoatingVolume coating() const;

  void approximated(const std::string& how) const {
    scope.context.report.approximated(fmt::format("material \"{}\": {}", kind, how), parameters.place());
  }
  void dropped(const std::string& why) const {
    scope.context.report.dropped(fmt::format("material \"{}\": {}", kind, why), parameters.place());
  }

  static Spectrum grey(double value) { return ConstantSpectrum{static_cast<float>(value)}; }
};

// Makes the models of pbrt-v3; nothing where v3 has no such kind, or v4 has the same.
std::optional<MaterialModel> make_v3_material(const MaterialMaker& maker);

}  // namespace vitrail::pbrt
