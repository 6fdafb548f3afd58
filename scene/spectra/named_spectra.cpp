// SPDX-License-Identifier: Apache-2.0
#include "scene/spectra/named_spectra.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "scene/spectra/color.h"
#include "scene/spectra/illuminant_tables.h"
#include "scene/spectra/metal_tables.h"

namespace vitrail {

namespace {

// Coefficients B and C (µm²) of the Schott catalogue's data sheets. pbrt's F5, F10 and F11 are Schott's SF5,
// SF10, SF11.
const std::map<std::string, SellmeierSpectrum>& glasses() {
  static const SellmeierSpectrum sf5{{1.46141885, 0.247713019, 0.949995832},
                                     {0.0111826126, 0.0508594669, 112.041888}};
  static const SellmeierSpectrum sf10{{1.61625977, 0.259229334, 1.07762317},
                                      {0.0127534559, 0.0581983954, 116.60768}};
  static const SellmeierSpectrum sf11{{1.73848403, 0.311168974, 1.17490871},
                                      {0.0136068604, 0.0615960463, 121.922711}};
  static const std::map<std::string, SellmeierSpectrum> table{
      {"BK7", bk7()},
      {"bk7", bk7()},
      {"glass-BK7", bk7()},
      {"glass-BAF10", {{1.5851495, 0.143559385, 1.08521269}, {0.00926681282, 0.0424489805, 105.613573}}},
      {"glass-FK51A", {{0.971247817, 0.216901417, 0.904651666}, {0.00472301995, 0.0153575612, 168.68133}}},
      {"glass-LASF9", {{2.00029547, 0.298926886, 1.80691843}, {0.0121426017, 0.0538736236, 156.530829}}},
      {"glass-F5", sf5},
      {"glass-SF5", sf5},
      {"glass-F10", sf10},
      {"glass-SF10", sf10},
      {"glass-F11", sf11},
      {"glass-SF11", sf11},
  };
  return table;
}

// CIE illuminant A: S ∝ λ⁻⁵/(exp(1.435·10⁷/(2848 λ)) − 1), λ in nm (CIE 15:2018, 4.1.1), scaled to
// luminance 1.
Spectrum illuminant_a() {
  std::vector<SpectrumSample> samples;
  for (double lambda = lambda_min_nm; lambda <= lambda_max_nm; ++lambda)
    samples.push_back({lambda, std::pow(560 / lambda, 5) / std::expm1(1.435e7 / (2848 * lambda))});
  const Spectrum s = tabulate(samples, true);
  return scaled(s, 1 / luminance(s));
}

// The values beyond a table are those at its ends. Of luminance 1.
Spectrum tabulated(const IlluminantTable& table) {
  std::vector<SpectrumSample> samples;
  for (std::size_t i = 0; i < table.values.size(); ++i)
    samples.push_back({table.first_nm + 5 * static_cast<double>(i), table.values[i]});
  const Spectrum s = tabulate(samples, true);
  return scaled(s, 1 / luminance(s));
}

// A column beside the wavelengths.
Spectrum tabulated(const NumberTable<float>& table, std::size_t column) {
  std::vector<SpectrumSample> samples;
  for (std::size_t row = 0; row < table.values.size(); row += table.columns)
    samples.push_back({table.values[row], table.values[row + column]});
  return tabulate(samples, true);
}

}  // namespace

std::optional<Spectrum> named_spectrum(const std::string& name) {
  if (name == "stdillum-D65") return TabulatedSpectrum{{cie_d65().begin(), cie_d65().end()}};
  if (name == "stdillum-A") return illuminant_a();
  if (name == "stdillum-E") return ConstantSpectrum{1};
  for (const IlluminantTable& illuminant : illuminant_tables())
    if (name == illuminant.name) return tabulated(illuminant);
  if (const auto glass = glasses().find(name); glass != glasses().end()) return glass->second;
  for (const NumberTable<float>& metal : metal_tables()) {
    if (name == fmt::format("metal-{}-eta", metal.name)) return tabulated(metal, 1);
    if (name == fmt::format("metal-{}-k", metal.name)) return tabulated(metal, 2);
  }
  return std::nullopt;
}

std::vector<std::string> spectrum_names() {
  std::vector<std::string> names{"stdillum-D65", "stdillum-A", "stdillum-E"};
  for (const IlluminantTable& illuminant : illuminant_tables()) names.emplace_back(illuminant.name);
  for (const auto& glass : glasses()) names.push_back(glass.first);
  for (const NumberTable<float>& metal : metal_tables())
    for (const char* part : {"eta", "k"}) names.push_back(fmt::format("metal-{}-{}", metal.name, part));
  std::sort(names.begin(), names.end());
  return names;
}

SellmeierSpectrum bk7() {
  return {{1.03961212, 0.231792344, 1.01046945}, {0.00600069867, 0.0200179144, 103.560653}};
}

}  // namespace vitrail
