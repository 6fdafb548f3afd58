// SPDX-License-Identifier: Apache-2.0
// The bands of a specfilm, each a spectrum of response. A channel of Mitsuba's is ∫ L·response dλ (measured
// with 3.9.1), one of ours the mean radiance of an interval.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "importers/mitsuba/read/film.h"

namespace vitrail::mitsuba {

namespace {

// Where a band responds, nm, and how much if it does so alike everywhere there.
struct Band {
  double min_nm, max_nm;
  std::optional<double> response;
};

Band band_of(const Spectrum& spectrum) {
  if (is_constant(spectrum)) return {lambda_min_nm, lambda_max_nm, evaluate(spectrum, lambda_min_nm)};
  const Spectrum values = resolved(spectrum);
  const auto* table = std::get_if<TabulatedSpectrum>(&values);
  if (!table) return {lambda_min_nm, lambda_max_nm, std::nullopt};
  const std::vector<SpectrumSample> samples = samples_of(*table);
  const double first = samples.front()[1];
  const bool is_box = std::ranges::all_of(samples, [&](const SpectrumSample& s) { return s[1] == first; });
  return {samples.front()[0], samples.back()[0], is_box ? std::optional(first) : std::nullopt};
}

// A spectrum within a film is a band, whatever its name.
std::vector<Band> read_all(Builder& builder, const Object& film) {
  std::vector<Band> bands;
  for (const Property& property : film.properties) {
    const auto* nested = std::get_if<ObjectPtr>(&property.value);
    if (!std::holds_alternative<SpectrumValue>(property.value) && !(nested && (*nested)->tag == "spectrum"))
      continue;
    bands.push_back(
        band_of(spectrum_value(builder, film, property.name, Quantity::unbounded, ConstantSpectrum{1})));
  }
  std::ranges::sort(bands, {}, &Band::min_nm);
  return bands;
}

// Whether they are boxes of one height that lie side by side, each as wide as the others.
bool are_bins(const std::vector<Band>& bands) {
  const double width = bands.front().max_nm - bands.front().min_nm;
  for (std::size_t i = 0; i < bands.size(); ++i) {
    const double begin = bands.front().min_nm + static_cast<double>(i) * width;
    if (!bands[i].response || bands[i].response != bands.front().response ||
        std::abs(bands[i].min_nm - begin) > 1e-3 || std::abs(bands[i].max_nm - begin - width) > 1e-3)
      return false;
  }
  return width > 0 && *bands.front().response > 0 && bands.size() <= max_spectral_bins;
}

}  // namespace

void read_bands(Builder& builder, const Object& film) {
  Report& report = builder.report;
  const std::vector<Band> bands = read_all(builder, film);
  if (bands.empty()) return report.approximated("a spectral film without bands: its colours", film.origin);
  const double min_nm = bands.front().min_nm, max_nm = std::ranges::max(bands, {}, &Band::max_nm).max_nm;
  if (!(min_nm < max_nm)) return report.dropped("bands of a spectral film without a width", film.origin);
  SpectralBins& bins = builder.scene.film.spectrum;
  if (are_bins(bands)) {
    bins = {static_cast<int>(bands.size()), min_nm, max_nm};
    if (const double factor = *bands.front().response * bins.width_nm(); std::abs(factor - 1) > 1e-4)
      report.approximated(fmt::format("bands of a spectral film hold their mean radiance: Mitsuba's value is "
                                      "{:.6g} times that",
                                      factor),
                          film.origin);
  } else {
    constexpr double widest_nm = 10;
    const double needed = std::ceil((max_nm - min_nm) / widest_nm);
    bins = {static_cast<int>(std::min<double>(needed, max_spectral_bins)), min_nm, max_nm};
    report.approximated(
        fmt::format("bands of a spectral film that are no equal intervals: {} intervals of {:.4g} nm "
                    "hold the light; a band is their sum, each times its response",
                    bins.count, bins.width_nm()),
        film.origin);
  }
  if (min_nm < lambda_min_nm || max_nm > lambda_max_nm)
    report.approximated(
        fmt::format("bands beyond {:g} … {:g} nm are kept in files, and black when they are rendered",
                    lambda_min_nm, lambda_max_nm),
        film.origin);
}

}  // namespace vitrail::mitsuba
