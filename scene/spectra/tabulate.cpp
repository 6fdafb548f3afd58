// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/spectra/spectrum.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

using Samples = std::vector<SpectrumSample>;

void check(const Samples& samples) {
  if (samples.empty())
    throw Error("a spectrum needs at least one sample: give pairs of wavelength in nm and value");
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto [lambda, value] = samples[i];
    if (!std::isfinite(lambda) || !std::isfinite(value))
      throw Error(fmt::format("sample {} of a spectrum is not finite: {} nm, {}", i + 1, lambda, value));
    if (i > 0 && !(samples[i - 1][0] < lambda))
      throw Error(fmt::format("the wavelengths of a spectrum must ascend, but {} nm follows {} nm", lambda,
                              samples[i - 1][0]));
  }
}

bool is_visible(double lambda) { return lambda > lambda_min_nm && lambda < lambda_max_nm; }

bool is_between_whole_nm(const SpectrumSample& sample) {
  return is_visible(sample[0]) && sample[0] != std::floor(sample[0]);
}

// The samples with ends that are held as far as the table reaches.
Samples with_ends(const Samples& samples, bool extend) {
  Samples all = samples;
  if (extend && all.front()[0] > lambda_min_nm) all.insert(all.begin(), {lambda_min_nm, samples.front()[1]});
  if (extend && all.back()[0] < lambda_max_nm) all.push_back({lambda_max_nm, samples.back()[1]});
  return all;
}

double linear(const SpectrumSample& a, const SpectrumSample& b, double lambda) {
  return a[1] + (b[1] - a[1]) * ((lambda - a[0]) / (b[0] - a[0]));
}

double value_at(const Samples& samples, double lambda) {
  if (lambda < samples.front()[0] || lambda > samples.back()[0]) return 0;
  const auto above = std::upper_bound(samples.begin(), samples.end(), lambda,
                                      [](double l, const SpectrumSample& s) { return l < s[0]; });
  return above == samples.end() ? samples.back()[1] : linear(*(above - 1), *above, lambda);
}

// Adds what lies on the line from a to b to the sums of the tents at the two whole nanometres beside it.
void add_between(double from, const SpectrumSample& a, const SpectrumSample& b, double sums[2]) {
  const double width = b[0] - a[0], x0 = a[0] - from, x1 = b[0] - from;
  const double middle = (a[1] + b[1]) / 2, x = (x0 + x1) / 2;
  const double first_moment =
      width * (a[1] * x0 + 4 * middle * x + b[1] * x1) / 6;  // Simpson's rule is exact
  sums[1] += first_moment;
  sums[0] += width * middle - first_moment;
}

// ∫ S(λ) tent(λ − i) dλ / ∫ tent(λ − i) dλ over the visible range, for each whole nanometre i.
std::vector<float> means(const Samples& samples) {
  std::vector<double> sums(table_size, 0);
  for (std::size_t k = 0; k + 1 < samples.size(); ++k) {
    const SpectrumSample &a = samples[k], &b = samples[k + 1];
    const double end = std::min(b[0], lambda_max_nm);
    SpectrumSample at{std::max(a[0], lambda_min_nm), 0};
    at[1] = linear(a, b, at[0]);
    while (at[0] < end) {
      const double whole = std::floor(at[0]);
      SpectrumSample next{std::min(end, whole + 1), 0};
      next[1] = linear(a, b, next[0]);
      add_between(whole, at, next, &sums[static_cast<std::size_t>(whole - lambda_min_nm)]);
      at = next;
    }
  }
  std::vector<float> values;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const bool at_end = i == 0 || i + 1 == sums.size();  // half a tent
    values.push_back(static_cast<float>(at_end ? 2 * sums[i] : sums[i]));
  }
  return values;
}

}  // namespace

TabulatedSpectrum tabulate(const Samples& samples, bool extend) {
  check(samples);
  TabulatedSpectrum table;
  table.samples = with_ends(samples, extend);
  if (std::ranges::any_of(samples, is_between_whole_nm))
    table.values = means(table.samples);
  else
    for (int i = 0; i < table_size; ++i)
      table.values.push_back(static_cast<float>(value_at(table.samples, lambda_min_nm + i)));
  if (samples.size() < 2) table.samples.clear();  // no other program draws a line through one
  return table;
}

Samples samples_of(const TabulatedSpectrum& table) {
  Samples all = table.samples;
  for (auto& [lambda, value] : all) value *= table.sample_factor;
  if (!all.empty()) return all;
  for (std::size_t i = 0; i < table.values.size(); ++i)
    all.push_back({lambda_min_nm + static_cast<double>(i), static_cast<double>(table.values[i])});
  return all;
}

}  // namespace vitrail
