// SPDX-License-Identifier: Apache-2.0
// Properties that are spectra or numbers, or textures where a builder allows them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "importers/mitsuba/read/builder.h"
#include "importers/mitsuba/read/values.h"
#include "importers/reading/suggestion.h"
#include "importers/spectra/spectrum_file.h"
#include "scene/spectra/named_spectra.h"
#include "scene/spectra/rgb_to_spectrum.h"

namespace vitrail::mitsuba {

namespace {

Spectrum from_color(RGB c, Quantity quantity, const Origin& place, Report& report) {
  if (std::min({c.r, c.g, c.b}) < 0)
    report.approximated("a colour has a negative component, which becomes 0", place);
  if (quantity == Quantity::emission) return emission_from_rgb(c);
  if (quantity == Quantity::unbounded) return unbounded_from_rgb(c);
  if (std::max({c.r, c.g, c.b}) > 1) report.approximated("a reflectance is above 1 and clamped to it", place);
  return reflectance_from_rgb(c);
}

// A number stands for its colour where it is emission, as in Mitsuba's spectral variants.
Spectrum from_number(double v, Quantity quantity, const Origin& place, Report& report) {
  if (quantity == Quantity::emission) return from_color({v, v, v}, quantity, place, report);
  return ConstantSpectrum{static_cast<float>(v)};
}

// Zero outside of the samples.
Spectrum from_samples(const std::vector<SpectrumSample>& samples, const Origin& place, const Report& report) {
  try {
    return tabulate(samples, false);
  } catch (const Error& error) {
    report.fail(error.what(), place);
  }
}

Spectrum from_file(const std::string& name, SpectrumPart part, const Origin& place, Report& report) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(name, ignored))
    report.fail(fmt::format("cannot find the file \"{}\"", name), place);
  const SpectrumFile file = read_spectrum_file(name);
  for (const std::string& repair : file.repairs)
    report.approximated(fmt::format("spectrum \"{}\": {}", name, repair), place);
  try {
    return spectrum_of(file, part, false);
  } catch (const Error& error) {
    report.fail(error.what(), place);
  }
}

Spectrum from_value(const SpectrumValue& value, SpectrumPart part, const Origin& place, Report& report) {
  if (!value.filename.empty()) return from_file(value.filename, part, place, report);
  if (!value.samples.empty()) return from_samples(value.samples, place, report);
  return ConstantSpectrum{static_cast<float>(value.constant)};
}

// Planck's law in W·m⁻²·sr⁻¹·nm⁻¹: 2hc²/(λ⁵(exp(hc/λkT) − 1)) (CODATA 2018).
BlackbodySpectrum physical_blackbody(double kelvin) {
  TabulatedSpectrum table;
  for (double nm = lambda_min_nm; nm <= lambda_max_nm; ++nm) {
    constexpr double h = 6.62607015e-34, c = 2.99792458e8, k = 1.380649e-23;
    const double m = nm * 1e-9;
    table.values.push_back(
        static_cast<float>(2e-9 * h * c * c / (std::pow(m, 5) * std::expm1(h * c / (m * k * kelvin)))));
  }
  return {static_cast<float>(kelvin), static_cast<float>(luminance(table))};
}

std::vector<double> list(const Object& object, std::string_view name, const Report& report) {
  const Property* property = object.find(name);
  if (!property) return {};
  const Fail fail = [&](const std::string& message) { report.fail(message, property->origin); };
  if (const auto* text = std::get_if<std::string>(&property->value)) return parse_numbers(*text, fail);
  if (const auto* number = std::get_if<double>(&property->value)) return {*number};
  report.fail(fmt::format("\"{}\" has to be a list of numbers", name), property->origin);
}

Spectrum regular_or_irregular(const Object& object, const Report& report) {
  const std::vector<double> values = list(object, "values", report);
  std::vector<double> wavelengths = list(object, "wavelengths", report);
  if (object.type == "regular" && values.size() > 1) {
    const double first =
        object.number("wavelength_min", object.number("lambda_min", lambda_min_nm, report), report);
    const double last =
        object.number("wavelength_max", object.number("lambda_max", lambda_max_nm, report), report);
    wavelengths.clear();
    for (std::size_t i = 0; i < values.size(); ++i)
      wavelengths.push_back(first +
                            (last - first) * static_cast<double>(i) / static_cast<double>(values.size() - 1));
  }
  if (values.empty() || values.size() != wavelengths.size())
    report.fail(fmt::format("a spectrum has {} wavelengths and {} values", wavelengths.size(), values.size()),
                object.origin);
  std::vector<SpectrumSample> samples;
  for (std::size_t i = 0; i < values.size(); ++i) samples.push_back({wavelengths[i], values[i]});
  return from_samples(samples, object.origin, report);
}

// <spectrum type="…">.
Spectrum from_plugin(Builder& b, const Object& object, Quantity quantity) {
  if (object.type == "uniform")
    return ConstantSpectrum{static_cast<float>(object.number("value", 1, b.report))};
  if (object.type == "regular" || object.type == "irregular") return regular_or_irregular(object, b.report);
  if (object.type == "d65") {
    const double scale = object.number("scale", 1, b.report);
    const Spectrum d65 = NamedSpectrum{"stdillum-D65"};
    if (!object.has("color")) return scaled(d65, scale);
    const Spectrum color = spectrum_value(b, object, "color", Quantity::unbounded, ConstantSpectrum{1});
    return scaled(product(color, d65), scale);
  }
  if (object.type == "blackbody") {
    const double kelvin = object.number("temperature", 5000, b.report);
    if (!(kelvin > 0)) b.report.fail("a blackbody needs a temperature above 0 K", object.origin);
    return scaled(physical_blackbody(kelvin), object.number("scale", 1, b.report));
  }
  if (object.type == "srgb" || object.type == "rgb")
    return spectrum_value(b, object, object.has("color") ? "color" : "value", quantity, ConstantSpectrum{1});
  if (object.type == "rawconstant") {
    const auto v = object.vector("value", b.report);
    return v ? from_color({v->x, v->y, v->z}, quantity, object.origin, b.report)
             : from_number(object.number("value", 1, b.report), quantity, object.origin, b.report);
  }
  b.report.approximated(fmt::format("spectrum \"{}\" is not known and becomes 1{}", object.type,
                                    suggestion(object.type, {"uniform", "regular", "irregular", "d65",
                                                             "blackbody", "srgb", "rawconstant"})),
                        object.origin);
  return ConstantSpectrum{1};
}

bool is_spectrum_plugin(const Object& object) {
  return object.tag == "spectrum" || object.type == "srgb" || object.type == "rawconstant" ||
         object.type == "d65";
}

}  // namespace

SpectrumParameter spectrum_parameter(Builder& b, const Object& object, std::string_view name,
                                     Quantity quantity, const Spectrum& otherwise) {
  const Property* property = object.find(name);
  if (!property) return otherwise;
  const Origin& place = property->origin;
  if (const auto* v = std::get_if<double>(&property->value))
    return from_number(*v, quantity, place, b.report);
  if (const auto* v = std::get_if<long long>(&property->value))
    return from_number(static_cast<double>(*v), quantity, place, b.report);
  if (const auto* v = std::get_if<RgbValue>(&property->value))
    return from_color(v->color, quantity, place, b.report);
  if (const auto* v = std::get_if<SpectrumValue>(&property->value))
    return from_value(*v, name == "k" ? SpectrumPart::k : SpectrumPart::n, place, b.report);
  if (const auto* nested = std::get_if<ObjectPtr>(&property->value)) {
    if (is_spectrum_plugin(**nested)) {
      const Spectrum spectrum = from_plugin(b, **nested, quantity);
      report_unused(**nested, b.report);
      return spectrum;
    }
    if ((*nested)->tag == "texture") return add_texture(b, **nested, false);
  }
  b.report.fail(fmt::format("\"{}\" of {} \"{}\" has to be a colour, spectrum or texture", name, object.tag,
                            object.type),
                place);
}

FloatParameter float_parameter(Builder& b, const Object& object, std::string_view name, double otherwise) {
  const Property* property = object.find(name);
  if (!property) return static_cast<float>(otherwise);
  if (const auto* v = std::get_if<double>(&property->value)) return static_cast<float>(*v);
  if (const auto* v = std::get_if<long long>(&property->value)) return static_cast<float>(*v);
  if (const auto* nested = std::get_if<ObjectPtr>(&property->value);
      nested && (*nested)->tag == "texture" && !is_spectrum_plugin(**nested))
    return add_texture(b, **nested, true);
  const SpectrumParameter value =
      spectrum_parameter(b, object, name, Quantity::unbounded, ConstantSpectrum{0});
  const auto* spectrum = std::get_if<Spectrum>(&value);
  if (spectrum && is_constant(*spectrum)) return static_cast<float>(evaluate(*spectrum, lambda_min_nm));
  b.report.approximated(fmt::format("\"{}\" is a number: the luminance of the colour stands for it", name),
                        property->origin);
  return static_cast<float>(spectrum ? luminance(*spectrum) : otherwise);
}

Spectrum spectrum_value(Builder& b, const Object& object, std::string_view name, Quantity quantity,
                        const Spectrum& otherwise) {
  const SpectrumParameter value = spectrum_parameter(b, object, name, quantity, otherwise);
  if (const auto* spectrum = std::get_if<Spectrum>(&value)) return *spectrum;
  b.report.approximated(
      fmt::format("\"{}\" of {} \"{}\" is a texture: 0.5 stands for it", name, object.tag, object.type),
      object.origin);
  return from_number(0.5, quantity, object.origin, b.report);
}

}  // namespace vitrail::mitsuba
