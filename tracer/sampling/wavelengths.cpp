// SPDX-License-Identifier: Apache-2.0
#include "tracer/sampling/wavelengths.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "scene/spectra/rgb_bands.h"
#include "tracer/sampling/guide_table.h"

namespace vitrail {

namespace {

constexpr std::size_t bins = table_size - 1;  // one a nanometre
constexpr double floor_share = 0.02;          // of the density, uniform: every wavelength can be drawn

struct Density {
  std::array<double, bins> pdf{};             // nm⁻¹
  std::array<double, bins + 1> cumulative{};  // 0 … 1
  GuideTable guide;
  std::vector<std::uint32_t> first;  // as of WavelengthTables
};

Density make_density() {
  Density d;
  double total = 0;
  for (std::size_t i = 0; i < bins; ++i) {
    for (std::size_t c = 0; c < 3; ++c) d.pdf[i] += 0.5 * (cie_1931()[i][c] + cie_1931()[i + 1][c]);
    total += d.pdf[i];
  }
  for (std::size_t i = 0; i < bins; ++i) {
    d.pdf[i] = (1 - floor_share) * d.pdf[i] / total + floor_share / bins;
    d.cumulative[i + 1] = d.cumulative[i] + d.pdf[i];
  }
  d.cumulative[bins] = 1;
  d.guide = GuideTable(d.cumulative, 4096);
  const auto cells = d.guide.first();
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    const double end = static_cast<double>(cell + 1) / static_cast<double>(cells.size());
    const bool several = cells[cell] + 2 < d.cumulative.size() && d.cumulative[cells[cell] + 2] < end;
    d.first.push_back(cells[cell] | (several ? std::uint32_t{WavelengthTables::several} : 0));
  }
  return d;
}

const Density& density() {
  static const Density d = make_density();
  return d;
}

// Between the two nearest of 360, 361 … 830 nm.
struct TablePlace {
  explicit TablePlace(float lambda_nm) {
    const float x = std::clamp(lambda_nm - static_cast<float>(lambda_min_nm), 0.0f, static_cast<float>(bins));
    below = static_cast<std::size_t>(std::min(static_cast<int>(x), static_cast<int>(bins) - 1));
    f = x - static_cast<float>(below);
  }
  float between(float a, float b) const { return (1 - f) * a + f * b; }
  std::size_t below;
  float f;
};

std::array<SampledWavelengths, 4> make_luminance_wavelengths() {
  constexpr std::size_t count = std::size_t{4} * hero_count;
  std::array<SampledWavelengths, 4> result{};
  double below = 0;
  std::size_t next = 0;
  for (std::size_t i = 0; i < table_size && next < count; ++i) {
    const double here = static_cast<double>(cie_1931()[i][1]) / cie_y_integral_nm;
    const auto middle = [&] { return (static_cast<double>(next) + 0.5) / count; };
    for (; next < count && middle() < below + here; ++next)
      result[next / hero_count].lambda_nm[next % hero_count] =
          static_cast<float>(lambda_min_nm + static_cast<double>(i) - 0.5 + (middle() - below) / here);
    below += here;
  }
  return result;
}

}  // namespace

const std::array<SampledWavelengths, 4>& luminance_wavelengths() {
  static const auto wavelengths = make_luminance_wavelengths();
  return wavelengths;
}

WavelengthTables wavelength_tables() {
  const Density& d = density();
  return {d.pdf.data(), d.cumulative.data(), d.first.data(), static_cast<double>(d.first.size())};
}

const Observer& band_observer() {
  static const Observer observer = [] {
    const auto& pdf = density().pdf;
    const auto is_edge = [](int nm) {
      return nm == blue_ends_nm || nm == green_begins_nm || nm == green_ends_nm || nm == red_begins_nm;
    };
    std::array<double, table_size> share{};  // of a nanometre's middle values, linear in between
    std::array<double, 3> sums{};
    for (std::size_t i = 0; i < table_size; ++i) {
      const int nm = static_cast<int>(lambda_min_nm) + static_cast<int>(i);
      if (is_edge(nm)) continue;
      const bool is_end = i == 0 || i == bins;
      share[i] = (pdf[i == 0 ? 0 : i - 1] + pdf[std::min(i, bins - 1)]) / 2;
      sums[band_of(static_cast<float>(nm))] += share[i] * (is_end ? 0.5 : 1);
    }
    constexpr std::array<RGB, 3> primaries{RGB{1, 0, 0}, RGB{0, 1, 0}, RGB{0, 0, 1}};
    Observer table{};
    for (std::size_t i = 0; i < table_size; ++i) {
      const std::size_t band = band_of(static_cast<float>(lambda_min_nm) + static_cast<float>(i));
      const double part = share[i] * cie_y_integral_nm / sums[band];
      const XYZ seen = srgb_to_xyz(primaries[band]);
      table[i] = {static_cast<float>(part * seen.x), static_cast<float>(part * seen.y),
                  static_cast<float>(part * seen.z)};
    }
    return table;
  }();
  return observer;
}

SampledWavelengths sample_wavelengths(float u) {
  const Density& d = density();
  SampledWavelengths result;
  for (std::size_t i = 0; i < hero_count; ++i) {
    double v = static_cast<double>(u) + static_cast<double>(i) / hero_count;
    if (v >= 1) v -= 1;
    const std::size_t bin = d.guide.bin(d.cumulative, v);
    const double within = std::clamp((v - d.cumulative[bin]) / d.pdf[bin], 0.0, 1.0);
    result.lambda_nm[i] = static_cast<float>(lambda_min_nm + static_cast<double>(bin) + within);
    result.pdf[i] = static_cast<float>(d.pdf[bin]);
  }
  return result;
}

namespace {

// 1/(N · pdf · width) for N wavelengths.
void add_bins(SensorWeights& w, const SampledWavelengths& wavelengths, double scale,
              const SpectralBins& into) {
  for (std::size_t i = 0; i < hero_count; ++i) {
    const double at = (static_cast<double>(wavelengths.lambda_nm[i]) - into.min_nm) / into.width_nm();
    if (!(at >= 0 && at < into.count)) continue;
    w.bin[i] = static_cast<std::uint16_t>(at);
    w.spectral[i] =
        static_cast<float>(scale / (hero_count * static_cast<double>(wavelengths.pdf[i]) * into.width_nm()));
  }
}

}  // namespace

double greatest_bin_weight(const SpectralBins& into) {
  return bins / (floor_share * hero_count * into.width_nm());
}

SensorWeights sensor_weights(const SampledWavelengths& wavelengths, double scale, const SpectralBins& into,
                             const Observer& observer) {
  SensorWeights w;
  if (into.count > 0) add_bins(w, wavelengths, scale, into);
  const auto all = static_cast<float>(scale / (hero_count * cie_y_integral_nm));
  for (std::size_t i = 0; i < hero_count; ++i) {
    const TablePlace at(wavelengths.lambda_nm[i]);
    const float each = all / wavelengths.pdf[i];
    w.x[i] = each * at.between(observer[at.below][0], observer[at.below + 1][0]);
    w.y[i] = each * at.between(observer[at.below][1], observer[at.below + 1][1]);
    w.z[i] = each * at.between(observer[at.below][2], observer[at.below + 1][2]);
  }
  return w;
}

namespace {

// ½ + x/(2√(1 + x²)), x = (c₀λ + c₁)λ + c₂: by ½/(√(1 + x²)(√(1 + x²) + |x|)), which is that from its nearer
// end and does not cancel.
SampledSpectrum sigmoid(const SigmoidSpectrum& s, const SampledWavelengths& wavelengths) {
  if (std::isinf(s.c2)) return filled(s.c2 > 0 ? 1 : 0);
  const double c0 = s.c0, c1 = s.c1, c2 = s.c2;
  std::array<float, hero_count> x;
  for (std::size_t i = 0; i < hero_count; ++i) {
    const auto l = static_cast<double>(wavelengths.lambda_nm[i]);
    const double y = (c0 * l + c1) * l + c2;
    const double above = y < -1e18 ? -1e18 : y;
    x[i] = static_cast<float>(above > 1e18 ? 1e18 : above);
  }
  SampledSpectrum result;
  for (std::size_t i = 0; i < hero_count; ++i) {
    const float root = std::sqrt(1 + x[i] * x[i]);
    const float rest = 0.5f / (root * (root + std::abs(x[i])));
    const float other = 1 - rest;
    result.v[i] = x[i] < 0 ? rest : other;
  }
  return result;
}

SampledSpectrum table_values(const float* values, const SampledWavelengths& wavelengths) {
  SampledSpectrum result;
  for (std::size_t i = 0; i < hero_count; ++i) {
    const TablePlace at(wavelengths.lambda_nm[i]);
    result.v[i] = at.between(values[at.below], values[at.below + 1]);
  }
  return result;
}

}  // namespace

SampledSpectrum evaluate(const Spectrum& spectrum, const SampledWavelengths& wavelengths) {
  if (const auto* s = std::get_if<ConstantSpectrum>(&spectrum)) return filled(s->value);
  if (const auto* s = std::get_if<SigmoidSpectrum>(&spectrum)) return sigmoid(*s, wavelengths);
  if (const auto* s = std::get_if<RgbUnboundedSpectrum>(&spectrum))
    return sigmoid(s->shape, wavelengths) * s->scale;
  if (const auto* s = std::get_if<RgbIlluminantSpectrum>(&spectrum))
    return sigmoid(s->shape, wavelengths) * table_values(cie_d65().data(), wavelengths) * s->scale;
  if (const auto* s = std::get_if<TabulatedSpectrum>(&spectrum))
    return table_values(s->values.data(), wavelengths);
  SampledSpectrum result;
  for (std::size_t i = 0; i < hero_count; ++i)
    result.v[i] = static_cast<float>(evaluate(spectrum, static_cast<double>(wavelengths.lambda_nm[i])));
  return result;
}

}  // namespace vitrail
