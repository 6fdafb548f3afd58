// SPDX-License-Identifier: Apache-2.0
#include "scene/spectra/spectrum.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "scene/spectra/color.h"
#include "scene/spectra/named_spectra.h"
#include "scene/spectra/rgb_to_spectrum.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

// Linear between the two nearest of 360, 361 … 830 nm; the end values beyond.
template <class Values>
double interpolate(const Values& values, double lambda_nm) {
  const double x = std::clamp(lambda_nm - lambda_min_nm, 0.0, lambda_max_nm - lambda_min_nm);
  const auto i = std::min(static_cast<std::size_t>(x), std::size_t{table_size - 2});
  const double f = x - static_cast<double>(i);
  return (1 - f) * static_cast<double>(values[i]) + f * static_cast<double>(values[i + 1]);
}

double sigmoid(const SigmoidSpectrum& s, double lambda_nm) {
  const double c0 = s.c0, c1 = s.c1, c2 = s.c2;
  if (std::isinf(c2)) return c2 > 0 ? 1 : 0;
  const double x = (c0 * lambda_nm + c1) * lambda_nm + c2;
  return 0.5 + x / (2 * std::sqrt(1 + x * x));
}

double sellmeier(const SellmeierSpectrum& s, double lambda_nm) {
  const double l2 = lambda_nm * lambda_nm * 1e-6;  // µm²
  double n2 = 1;
  for (std::size_t i = 0; i < 3; ++i) n2 += s.b[i] * l2 / (l2 - s.c_um2[i]);
  return std::sqrt(n2);
}

template <class F>
TabulatedSpectrum tabulate_each_nm(F&& value) {
  TabulatedSpectrum t;
  t.values.resize(table_size);
  for (std::size_t i = 0; i < table_size; ++i)
    t.values[i] = static_cast<float>(value(lambda_min_nm + static_cast<double>(i)));
  return t;
}

}  // namespace

double evaluate(const Spectrum& spectrum, double lambda_nm) {
  return std::visit(Overloaded{
                        [](const ConstantSpectrum& s) { return static_cast<double>(s.value); },
                        [&](const SigmoidSpectrum& s) { return sigmoid(s, lambda_nm); },
                        [&](const RgbIlluminantSpectrum& s) {
                          return static_cast<double>(s.scale) * sigmoid(s.shape, lambda_nm) *
                                 interpolate(cie_d65(), lambda_nm);
                        },
                        [&](const TabulatedSpectrum& s) { return interpolate(s.values, lambda_nm); },
                        [&](const SellmeierSpectrum& s) { return sellmeier(s, lambda_nm); },
                        [&](const RgbUnboundedSpectrum& s) {
                          return static_cast<double>(s.scale) * sigmoid(s.shape, lambda_nm);
                        },
                        [&](const BlackbodySpectrum&) { return evaluate(resolved(spectrum), lambda_nm); },
                        [&](const NamedSpectrum&) { return evaluate(resolved(spectrum), lambda_nm); },
                    },
                    spectrum);
}

Spectrum resolved(const Spectrum& spectrum) {
  if (const auto* s = std::get_if<BlackbodySpectrum>(&spectrum)) {
    const Spectrum shape = blackbody(static_cast<double>(s->kelvin));
    const double visible = luminance(shape);  // 0 where it is too cold to glow
    return visible > 0 ? scaled(shape, static_cast<double>(s->luminance) / visible) : ConstantSpectrum{0};
  }
  if (const auto* s = std::get_if<NamedSpectrum>(&spectrum)) {
    if (const auto known = named_spectrum(s->name)) return *known;
    throw Error(fmt::format("no spectrum is known by the name \"{}\"", s->name));
  }
  return spectrum;
}

bool is_constant(const Spectrum& spectrum) {
  return std::visit(Overloaded{
                        [](const ConstantSpectrum&) { return true; },
                        [](const SigmoidSpectrum& s) { return s.c0 == 0 && s.c1 == 0; },
                        [](const RgbIlluminantSpectrum& s) { return s.scale == 0; },
                        [](const TabulatedSpectrum& s) {
                          return std::adjacent_find(s.values.begin(), s.values.end(),
                                                    std::not_equal_to<>{}) == s.values.end();
                        },
                        [](const SellmeierSpectrum& s) { return s.b == std::array<double, 3>{}; },
                        [](const RgbUnboundedSpectrum& s) { return s.scale == 0 || is_constant(s.shape); },
                        [](const BlackbodySpectrum& s) { return s.luminance == 0; },
                        [](const NamedSpectrum&) { return false; },
                    },
                    spectrum);
}

// B(λ,T)/B(λₘ,T) with B ∝ λ⁻⁵/(exp(c₂/λT) − 1), c₂ = hc/k (CODATA 2018), and λₘ = c₂/(w·T) the maximum by
// Wien's law.
TabulatedSpectrum blackbody(double kelvin) {
  if (!std::isfinite(kelvin) || kelvin <= 0)
    throw Error(fmt::format("a blackbody needs a temperature above 0 K, not {}", kelvin));
  constexpr double c2_nm_kelvin = 1.438776877e7;
  constexpr double w = 4.965114231744276;  // root of w = 5(1 − e⁻ʷ)
  return tabulate_each_nm([&](double lambda) {
    const double r = c2_nm_kelvin / (w * kelvin) / lambda;  // λₘ/λ
    return std::min(1.0, r * r * r * r * r * std::expm1(w) / std::expm1(w * r));
  });
}

Spectrum scaled(const Spectrum& spectrum, double factor) {
  const auto product = [factor](float v) { return static_cast<float>(static_cast<double>(v) * factor); };
  if (factor == 1) return spectrum;
  if (auto* s = std::get_if<ConstantSpectrum>(&spectrum)) return ConstantSpectrum{product(s->value)};
  const auto color = [factor](const std::array<float, 3>& c) {
    return RGB{factor * static_cast<double>(c[0]), factor * static_cast<double>(c[1]),
               factor * static_cast<double>(c[2])};
  };
  if (auto* s = std::get_if<RgbIlluminantSpectrum>(&spectrum); s && factor >= 0)
    return emission_from_rgb(color(s->rgb));
  if (auto* s = std::get_if<RgbUnboundedSpectrum>(&spectrum); s && factor >= 0)
    return unbounded_from_rgb(color(s->rgb));
  if (auto* s = std::get_if<BlackbodySpectrum>(&spectrum))
    return BlackbodySpectrum{s->kelvin, product(s->luminance)};
  if (is_constant(spectrum))
    return ConstantSpectrum{static_cast<float>(evaluate(spectrum, lambda_min_nm) * factor)};
  const Spectrum known = resolved(spectrum);
  // Of samples that were read, whatever they are multiplied by on the way is rounded once.
  if (const auto* s = std::get_if<TabulatedSpectrum>(&known); s && !s->samples.empty()) {
    TabulatedSpectrum table = tabulate(s->samples, false);
    table.sample_factor = s->sample_factor * factor;
    for (float& value : table.values)
      value = static_cast<float>(static_cast<double>(value) * table.sample_factor);
    return table;
  }
  return tabulate_each_nm([&](double lambda) { return evaluate(known, lambda) * factor; });
}

namespace {

// A table whose values are all the same is a constant.
Spectrum simplified(TabulatedSpectrum table) {
  if (is_constant(table)) return ConstantSpectrum{table.values.front()};
  return table;
}

}  // namespace

Spectrum weighted_sum(const Spectrum& a, double weight_a, const Spectrum& b, double weight_b) {
  if (weight_b == 0) return scaled(a, weight_a);
  if (weight_a == 0) return scaled(b, weight_b);
  const Spectrum first = resolved(a), second = resolved(b);
  return simplified(tabulate_each_nm(
      [&](double l) { return weight_a * evaluate(first, l) + weight_b * evaluate(second, l); }));
}

Spectrum product(const Spectrum& a, const Spectrum& b) {
  if (is_constant(a)) return scaled(b, evaluate(a, lambda_min_nm));
  if (is_constant(b)) return scaled(a, evaluate(b, lambda_min_nm));
  const Spectrum first = resolved(a), second = resolved(b);
  return simplified(tabulate_each_nm([&](double l) { return evaluate(first, l) * evaluate(second, l); }));
}

double luminance(const Spectrum& spectrum) { return to_xyz(spectrum).y; }

}  // namespace vitrail
