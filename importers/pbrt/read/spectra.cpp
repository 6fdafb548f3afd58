// SPDX-License-Identifier: Apache-2.0
#include "importers/pbrt/read/spectra.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "importers/spectra/spectrum_file.h"
#include "scene/spectra/color.h"
#include "scene/spectra/named_spectra.h"
#include "scene/spectra/rgb_to_spectrum.h"

namespace vitrail::pbrt {

namespace {

using Samples = std::vector<SpectrumSample>;

// A table whose values are all the same is a constant.
Spectrum simplified(TabulatedSpectrum table) {
  const float first = table.values.front();
  if (std::all_of(table.values.begin(), table.values.end(), [&](float v) { return v == first; }))
    return ConstantSpectrum{first};
  return table;
}

Samples pairs(const std::vector<double>& numbers, const Place& place) {
  if (numbers.empty() || numbers.size() % 2 != 0)
    fail(fmt::format("a spectrum needs pairs of wavelength and value, has {} numbers", numbers.size()),
         place);
  Samples samples;
  for (std::size_t i = 0; i < numbers.size(); i += 2) samples.push_back({numbers[i], numbers[i + 1]});
  return samples;
}

Spectrum from_file(const Parameter& parameter, bool hold_ends, Context& context) {
  const std::string& name = parameter.strings.front();
  const std::filesystem::path path = context.resolve(name);
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored))
    fail(fmt::format("\"{}\" is neither a spectrum that is known by name nor a file", name), parameter.place);
  const SpectrumFile file = read_spectrum_file(path);
  for (const std::string& repair : file.repairs)
    context.report.approximated(fmt::format("spectrum \"{}\": {}", name, repair), parameter.place);
  const bool is_k = parameter.name == "k" || parameter.name.ends_with(".k");
  try {
    return spectrum_of(file, is_k ? SpectrumPart::k : SpectrumPart::n, hold_ends);
  } catch (const Error& error) {
    fail(error.what(), parameter.place);
  }
}

// Samples become a table; v3 sorts them and holds the ends, v4 wants them sorted and is zero outside.
Spectrum sampled(Samples samples, bool hold_ends, const Context& context, const Place& place) {
  if (context.version == Version::v3) std::sort(samples.begin(), samples.end());
  try {
    return simplified(tabulate(samples, hold_ends));
  } catch (const Error& error) {
    fail(error.what(), place);
  }
}

Spectrum read_named(const Parameter& parameter, bool hold_ends, Context& context) {
  const std::string& name = parameter.strings.front();
  if (named_spectrum(name)) return NamedSpectrum{name};
  return from_file(parameter, hold_ends, context);
}

// Of parameters of type spectrum.
Spectrum read_spectrum(const Parameter& parameter, bool hold_ends, Context& context) {
  if (!parameter.strings.empty()) return read_named(parameter, hold_ends, context);
  return sampled(pairs(parameter.numbers, parameter.place), hold_ends, context, parameter.place);
}

void require(const Parameter& parameter, std::size_t least, std::size_t most) {
  if (parameter.numbers.size() >= least && parameter.numbers.size() <= most) return;
  fail(fmt::format("parameter \"{}\" needs {} value{}, has {}", parameter.name, least, least == 1 ? "" : "s",
                   parameter.numbers.size()),
       parameter.place);
}

// The linear sRGB colour of an rgb or xyz parameter; components outside [0, limit] are clamped and reported.
RGB read_color(const Parameter& parameter, double limit, SpectrumScope scope) {
  require(parameter, 3, 3);
  const std::vector<double>& v = parameter.numbers;
  const RGB color = parameter.type == ParameterType::xyz
                        ? xyz_to_srgb({v[0], v[1], v[2]})
                        : to_srgb({v[0], v[1], v[2]}, scope.color_space.c_str());
  constexpr double tolerance = 1e-6;  // of the conversion of whites and greys
  const auto clamped = [&](double x) {
    if (x < -tolerance || x > limit + tolerance)
      scope.context.report.approximated(
          fmt::format("colour \"{}\" is outside {} and clamped to it", parameter.name,
                      limit == 1 ? "[0,1] in linear sRGB" : "linear sRGB (a component is negative)"),
          parameter.place);
    return std::clamp(x, 0.0, limit);
  };
  return {clamped(color.r), clamped(color.g), clamped(color.b)};
}

double read_kelvin(const Parameter& parameter) {
  require(parameter, 1, 2);
  if (!(parameter.numbers[0] > 0)) fail("a blackbody needs a temperature above 0 K", parameter.place);
  return parameter.numbers[0];
}

// With a maximum of 1, times v3's second value.
Spectrum read_blackbody(const Parameter& parameter, const Context& context) {
  const double kelvin = read_kelvin(parameter);
  const double scale =
      context.version == Version::v3 && parameter.numbers.size() == 2 ? parameter.numbers[1] : 1;
  return BlackbodySpectrum{static_cast<float>(kelvin),
                           static_cast<float>(luminance(blackbody(kelvin)) * scale)};
}

Spectrum constant(const Parameter& parameter) {
  require(parameter, 1, 1);
  return ConstantSpectrum{static_cast<float>(parameter.numbers[0])};
}

// One factor, so that a spectrum whose scale is its own luminance stays as it is, bit for bit.
Spectrum with_luminance(const Spectrum& spectrum, double y, const Place& place, Context& context) {
  const double own = luminance(spectrum);
  if (own > 0) return scaled(spectrum, y / own);
  if (y > 0)
    context.report.dropped("the spectrum of a light has no luminance to normalise: the light is black",
                           place);
  return ConstantSpectrum{0};
}

}  // namespace

Spectrum read_reflectance(const Parameter& parameter, SpectrumScope scope) {
  switch (parameter.type) {
    case ParameterType::rgb:
    case ParameterType::xyz:
      return reflectance_from_rgb(read_color(parameter, 1, scope));
    case ParameterType::blackbody:
      return read_blackbody(parameter, scope.context);
    case ParameterType::spectrum:
      return read_spectrum(parameter, scope.context.version == Version::v3, scope.context);
    default:
      return constant(parameter);
  }
}

Spectrum read_unbounded(const Parameter& parameter, SpectrumScope scope) {
  if (parameter.type != ParameterType::rgb && parameter.type != ParameterType::xyz)
    return read_reflectance(parameter, scope);
  return unbounded_from_rgb(read_color(parameter, std::numeric_limits<float>::max(), scope));
}

Spectrum read_emission(const Parameter& parameter, double factor, SpectrumScope scope) {
  const bool v4 = scope.context.version == Version::v4;
  switch (parameter.type) {
    case ParameterType::rgb:
    case ParameterType::xyz: {
      const RGB c = read_color(parameter, std::numeric_limits<float>::max(), scope);
      return emission_from_rgb({c.r * factor, c.g * factor, c.b * factor});
    }
    case ParameterType::blackbody:
      scope.context.note_version("the magnitude of a light's blackbody", parameter.place);
      if (v4)
        return BlackbodySpectrum{static_cast<float>(read_kelvin(parameter)), static_cast<float>(factor)};
      return scaled(read_blackbody(parameter, scope.context), factor);
    case ParameterType::spectrum: {
      scope.context.note_version("the magnitude of a light's spectrum", parameter.place);
      const Spectrum spectrum = read_spectrum(parameter, !v4, scope.context);
      return v4 ? with_luminance(spectrum, factor, parameter.place, scope.context) : scaled(spectrum, factor);
    }
    default:
      return scaled(constant(parameter), factor);
  }
}

Spectrum read_refraction(const Parameter& parameter, SpectrumScope scope) {
  if (parameter.type == ParameterType::number) return constant(parameter);
  if (parameter.type == ParameterType::spectrum) {
    Spectrum spectrum = read_spectrum(parameter, true, scope.context);
    const std::vector<double>& numbers = parameter.numbers;
    if (scope.context.version == Version::v4 && !numbers.empty() &&
        (numbers.front() > lambda_min_nm || numbers[numbers.size() - 2] < lambda_max_nm))
      scope.context.report.approximated(
          fmt::format("refractive index \"{}\" is held constant outside of its samples", parameter.name),
          parameter.place);
    return spectrum;
  }
  double sum = 0;
  for (const double value : parameter.numbers) sum += value;
  require(parameter, 3, 3);
  scope.context.report.approximated(
      fmt::format("refractive index \"{}\" is a colour: its mean stands for it", parameter.name),
      parameter.place);
  return ConstantSpectrum{static_cast<float>(sum / 3)};
}

std::string find_file(const Parameter& parameter, Context& context) {
  const std::filesystem::path path = std::filesystem::absolute(context.resolve(parameter.strings.front()));
  return path.lexically_normal().string();
}

}  // namespace vitrail::pbrt
