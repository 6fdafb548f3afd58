// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/write/write_spectra.h"

#include <cmath>

#include "importers/writing/export_colors.h"
#include "scene/spectra/color.h"

namespace vitrail::mitsuba_writer {

namespace {

// W·m⁻²·sr⁻¹·nm⁻¹ of a blackbody at `lambda_nm` by Planck's law (CODATA 2018).
double planck(double kelvin, double lambda_nm) {
  constexpr double h = 6.62607015e-34, c = 2.99792458e8, k = 1.380649e-23;
  const double lambda_m = lambda_nm * 1e-9;
  return 2e-9 * h * c * c / (std::pow(lambda_m, 5) * std::expm1(h * c / (lambda_m * k * kelvin)));
}

// Mitsuba's blackbody has the brightness of the real one and no factor.
bool is_planck(const BlackbodySpectrum& s) {
  const double kelvin = static_cast<double>(s.kelvin);
  const double absolute = luminance(tabulated([&](double lambda) { return planck(kelvin, lambda); }));
  return std::abs(static_cast<double>(s.luminance) - absolute) <= 1e-5 * absolute;
}

void add_flat(Element parent, const std::string& name, float value) {
  add_value(parent, "spectrum", name, fmt::format("{}", value));
}

void add_rgb(Element parent, const std::string& name, const std::array<float, 3>& rgb) {
  add_value(parent, "rgb", name, fmt::format("{} {} {}", rgb[0], rgb[1], rgb[2]));
}

// What was read; else the fewest samples that lines through them give the same table back, or all of them
// where that is not exact.
std::vector<SpectrumSample> knots(const TabulatedSpectrum& table) {
  std::vector<SpectrumSample> all = samples_of(table);
  if (!table.samples.empty()) return all;
  std::vector<SpectrumSample> few;
  few.push_back(all.front());
  for (std::size_t i = 1; i + 1 < all.size(); ++i) {
    const double bend = all[i + 1][1] - 2 * all[i][1] + all[i - 1][1];
    const double noise = 2e-7 * (std::abs(all[i - 1][1]) + 2 * std::abs(all[i][1]) + std::abs(all[i + 1][1]));
    if (std::abs(bend) > noise) few.push_back(all[i]);
  }
  few.push_back(all.back());
  return tabulate(few, true) == table ? few : all;
}

void add_table(Element parent, const std::string& name, const TabulatedSpectrum& table) {
  bool black = true;
  for (const float value : table.values) black = black && value == 0;
  if (black) return add_flat(parent, name, 0);  // Mitsuba refuses tables without any energy
  std::string list;
  for (const auto& [lambda, value] : knots(table))
    list += fmt::format("{}{}:{}", list.empty() ? "" : ", ", lambda, digits_of(table, value));
  add_value(parent, "spectrum", name, list);
}

void add_values(Element parent, const std::string& name, const Spectrum& spectrum) {
  if (const auto* table = std::get_if<TabulatedSpectrum>(&spectrum)) return add_table(parent, name, *table);
  const Spectrum values = resolved(spectrum);
  const Spectrum table = tabulated([&](double lambda) { return evaluate(values, lambda); });
  add_table(parent, name, std::get<TabulatedSpectrum>(table));
}

// Mitsuba's <rgb> is a reflectance in [0,1] outside of emitters.
bool fits_reflectance(const std::array<float, 3>& rgb) {
  return rgb[0] >= 0 && rgb[1] >= 0 && rgb[2] >= 0 && rgb[0] <= 1 && rgb[1] <= 1 && rgb[2] <= 1;
}

}  // namespace

void add_spectrum(Element parent, const std::string& name, const Spectrum& spectrum, Meaning meaning) {
  const bool emission = meaning == Meaning::emission;
  if (const auto* s = std::get_if<ConstantSpectrum>(&spectrum)) return add_flat(parent, name, s->value);
  if (const auto* s = std::get_if<SigmoidSpectrum>(&spectrum); s && !emission && fits_reflectance(s->rgb))
    return add_rgb(parent, name, s->rgb);
  if (const auto* s = std::get_if<RgbUnboundedSpectrum>(&spectrum);
      s && !emission && fits_reflectance(s->rgb))
    return add_rgb(parent, name, s->rgb);
  if (const auto* s = std::get_if<RgbIlluminantSpectrum>(&spectrum); s && emission)
    return add_rgb(parent, name, s->rgb);
  if (const auto* s = std::get_if<BlackbodySpectrum>(&spectrum); s && s->kelvin > 0 && is_planck(*s)) {
    Element element = add(parent, "spectrum", "blackbody", name);
    return add_float(element, "temperature", s->kelvin);
  }
  if (const auto* s = std::get_if<NamedSpectrum>(&spectrum); s && emission && s->name == "stdillum-D65") {
    Element element = add(parent, "spectrum", "d65", name);
    return add_float(element, "scale", 1.0);
  }
  add_values(parent, name, spectrum);
}

RGB color_of(const Spectrum& spectrum) {
  if (const auto* s = std::get_if<SigmoidSpectrum>(&spectrum)) return {s->rgb[0], s->rgb[1], s->rgb[2]};
  if (const auto* s = std::get_if<RgbUnboundedSpectrum>(&spectrum)) return {s->rgb[0], s->rgb[1], s->rgb[2]};
  if (const auto* s = std::get_if<RgbIlluminantSpectrum>(&spectrum)) return {s->rgb[0], s->rgb[1], s->rgb[2]};
  if (const auto* s = std::get_if<ConstantSpectrum>(&spectrum)) return {s->value, s->value, s->value};
  const Spectrum values = resolved(spectrum);
  return xyz_to_srgb(to_xyz(tabulated([&](double lambda) {
    const auto i = static_cast<std::size_t>(lambda - lambda_min_nm);
    return evaluate(values, lambda) * static_cast<double>(cie_d65()[i]);
  })));
}

double number_of(Context& context, const Spectrum& spectrum, const char* what) {
  if (is_constant(spectrum)) return evaluate(spectrum, 550);
  const double value = luminance(resolved(spectrum));
  context.approximated(
      fmt::format("{} is a number in Mitsuba: the luminance of the spectrum, {:.6g}", what, value));
  return value;
}

double index_of_refraction(Context& context, const Spectrum& spectrum) {
  if (is_constant(spectrum)) return evaluate(spectrum, 550);
  constexpr double sodium_d_nm = 589.3;
  const double value = evaluate(resolved(spectrum), sodium_d_nm);
  context.approximated(fmt::format(
      "dispersion: Mitsuba's dielectrics have one index of refraction; {:.6g}, at 589.3 nm", value));
  return value;
}

}  // namespace vitrail::mitsuba_writer
