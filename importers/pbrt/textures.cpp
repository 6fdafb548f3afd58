// SPDX-License-Identifier: Apache-2.0
#include "importers/pbrt/textures.h"

#include <fmt/format.h>

#include <algorithm>

namespace vitrail::pbrt {

namespace {

const Texture& find_texture(const Parameter& parameter, bool spectral, const Scope& scope) {
  if (parameter.strings.size() != 1)
    fail(fmt::format("texture parameter \"{}\" needs one name", parameter.name), parameter.place);
  const std::string& name = parameter.strings.front();
  const auto& first = spectral ? scope.textures.spectra : scope.textures.numbers;
  const auto& second = spectral ? scope.textures.numbers : scope.textures.spectra;
  if (const auto found = first.find(name); found != first.end()) return found->second;
  if (const auto found = second.find(name); found != second.end()) return found->second;
  std::vector<std::string> known;
  for (const auto& entry : first) known.push_back(entry.first);
  std::sort(known.begin(), known.end());
  const std::string closest = closest_word(name, known);
  fail(fmt::format("texture \"{}\" is not defined{}", name,
                   closest.empty() ? "" : fmt::format("; did you mean \"{}\"?", closest)),
       parameter.place);
}

const Spectrum& use_texture(const Parameter& parameter, bool spectral, const Scope& scope) {
  const Texture& texture = find_texture(parameter, spectral, scope);
  if (!texture.approximation.empty())
    scope.context.report.approximated(
        fmt::format("texture \"{}\": {}", parameter.strings.front(), texture.approximation), parameter.place);
  return texture.value;
}

// What the textures of a texture are made of.
struct Inputs {
  bool spectral;
  ParameterSet& parameters;
  const Scope& scope;
  bool constant = true;  // all that were read so far

  Spectrum value(std::string_view name, double otherwise) {
    const ConstantSpectrum fallback{static_cast<float>(otherwise)};
    if (const Parameter* texture = parameters.find(name, {ParameterType::texture})) {
      const Texture& found = find_texture(*texture, spectral, scope);
      constant = constant && found.approximation.empty();
      return found.value;
    }
    if (!spectral) return ConstantSpectrum{static_cast<float>(parameters.number(name, otherwise))};
    const Parameter* parameter = parameters.find_spectrum(name);
    return parameter ? read_reflectance(*parameter, scope) : Spectrum{fallback};
  }

  double number(std::string_view name, double otherwise) {
    if (const Parameter* texture = parameters.find(name, {ParameterType::texture})) {
      const Texture& found = find_texture(*texture, false, scope);
      constant = constant && found.approximation.empty();
      return luminance(found.value);
    }
    return parameters.number(name, otherwise);
  }
};

constexpr const char* mean_stands = "the mean of what it shows stands for it";

Texture mean_of(Inputs& inputs, std::string_view first, double first_default, std::string_view second,
                double second_default, double weight_of_second) {
  const Spectrum a = inputs.value(first, first_default), b = inputs.value(second, second_default);
  return {a == b ? a : weighted_sum(a, 1 - weight_of_second, b, weight_of_second),
          a == b && inputs.constant ? "" : mean_stands};
}

Texture bilinear_corners(Inputs& inputs) {
  const Spectrum left = weighted_sum(inputs.value("v00", 0), 0.5, inputs.value("v01", 1), 0.5);
  const Spectrum right = weighted_sum(inputs.value("v10", 0), 0.5, inputs.value("v11", 1), 0.5);
  return {weighted_sum(left, 0.5, right, 0.5), mean_stands};
}

// Dots of radius 0.35 in half of the unit cells of (u,v).
constexpr double dots_coverage = 0.5 * 3.14159265358979 * 0.35 * 0.35;

}  // namespace

Spectrum spectrum_value(ParameterSet& parameters, std::initializer_list<std::string_view> names,
                        Quantity quantity, const Spectrum& otherwise, const Scope& scope) {
  for (const std::string_view name : names) {
    if (const Parameter* texture = parameters.find(name, {ParameterType::texture}))
      return use_texture(*texture, true, scope);
    if (const Parameter* value = parameters.find_spectrum(name))
      return quantity == Quantity::reflectance ? read_reflectance(*value, scope)
                                               : read_refraction(*value, scope);
  }
  return otherwise;
}

double number_value(ParameterSet& parameters, std::string_view name, double otherwise, const Scope& scope) {
  if (const Parameter* texture = parameters.find(name, {ParameterType::texture}))
    return luminance(use_texture(*texture, false, scope));
  return parameters.number(name, otherwise);
}

bool textures_are_known(const ParameterSet& parameters, const TextureTable& textures) {
  return std::all_of(parameters.all().begin(), parameters.all().end(), [&](const Parameter& parameter) {
    return parameter.type != ParameterType::texture || parameter.strings.empty() ||
           textures.spectra.contains(parameter.strings.front()) ||
           textures.numbers.contains(parameter.strings.front());
  });
}

Texture make_texture(const std::string& kind, bool spectral, ParameterSet& parameters, const Scope& scope) {
  Inputs inputs{spectral, parameters, scope};
  const auto stands = [&] { return inputs.constant ? "" : mean_stands; };
  if (kind == "constant") {
    const Spectrum value = inputs.value("value", 1);
    return {value, stands()};
  }
  if (kind == "scale") {  // v4: tex · scale; v3: tex1 · tex2
    Spectrum value =
        product(inputs.value("tex", 1), product(inputs.value("tex1", 1), inputs.value("tex2", 1)));
    value = scaled(value, inputs.number("scale", 1));
    return {value, stands()};
  }
  if (kind == "mix") {
    const double amount = inputs.number("amount", 0.5);
    const Spectrum first = inputs.value("tex1", 0), second = inputs.value("tex2", 1);
    return {weighted_sum(first, 1 - amount, second, amount), stands()};
  }
  if (kind == "checkerboard" || kind == "directionmix") return mean_of(inputs, "tex1", 1, "tex2", 0, 0.5);
  if (kind == "dots") return mean_of(inputs, "outside", 0, "inside", 1, dots_coverage);
  if (kind == "bilerp") return bilinear_corners(inputs);
  const double grey = 0.5 * parameters.number("scale", 1);
  return {ConstantSpectrum{static_cast<float>(grey)},
          fmt::format("the constant {} stands for the {}", grey, kind)};
}

}  // namespace vitrail::pbrt
