// SPDX-License-Identifier: Apache-2.0
#include "tracer/wavelengths.h"

#include <algorithm>

namespace vitrail {

namespace {

constexpr std::size_t bins = table_size - 1;  // one a nanometre
constexpr double floor_share = 0.02;          // of the density, uniform: every wavelength can be drawn

struct Density {
  static constexpr std::size_t cells = 1024;
  std::array<double, bins> pdf{};             // nm⁻¹
  std::array<double, bins + 1> cumulative{};  // 0 … 1
  // Where the search for v begins, by ⌊v·cells⌋: the bin that holds the cell's lower end (Chen & Asau 1974).
  std::array<std::uint16_t, cells> guide{};

  // The bin that holds v in [0,1).
  std::size_t bin_of(double v) const {
    std::size_t bin = guide[static_cast<std::size_t>(v * cells)];
    while (bin + 1 < bins && cumulative[bin + 1] <= v) ++bin;
    return bin;
  }
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
  std::size_t bin = 0;
  for (std::size_t cell = 0; cell < Density::cells; ++cell) {
    while (bin + 1 < bins && d.cumulative[bin + 1] <= static_cast<double>(cell) / Density::cells) ++bin;
    d.guide[cell] = static_cast<std::uint16_t>(bin);
  }
  return d;
}

const Density& density() {
  static const Density d = make_density();
  return d;
}

}  // namespace

SampledWavelengths sample_wavelengths(float u) {
  const Density& d = density();
  SampledWavelengths result;
  for (std::size_t i = 0; i < hero_count; ++i) {
    double v = static_cast<double>(u) + static_cast<double>(i) / hero_count;
    if (v >= 1) v -= 1;
    const std::size_t bin = d.bin_of(v);
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

SensorWeights sensor_weights(const SampledWavelengths& wavelengths, double scale, const SpectralBins& into) {
  SensorWeights w;
  if (into.count > 0) add_bins(w, wavelengths, scale, into);
  const auto& observer = cie_1931();
  for (std::size_t i = 0; i < hero_count; ++i) {
    const double at =
        std::clamp(static_cast<double>(wavelengths.lambda_nm[i]) - lambda_min_nm, 0.0, bins - 1e-9);
    const auto bin = static_cast<std::size_t>(at);
    const double f = at - static_cast<double>(bin);
    const double each = scale / (hero_count * static_cast<double>(wavelengths.pdf[i]) * cie_y_integral_nm);
    const auto value = [&](std::size_t c) {
      return static_cast<float>(((1 - f) * observer[bin][c] + f * observer[bin + 1][c]) * each);
    };
    w.x[i] = value(0);
    w.y[i] = value(1);
    w.z[i] = value(2);
  }
  return w;
}

}  // namespace vitrail
