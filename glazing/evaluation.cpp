// SPDX-License-Identifier: Apache-2.0
#include "glazing/evaluation.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "glazing/text_file.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

PaneValues value_at(const SystemSpectrum& spectrum, double nm) {
  const auto above = std::upper_bound(spectrum.nm.begin(), spectrum.nm.end(), nm);
  if (above == spectrum.nm.begin()) return spectrum.values.front();
  if (above == spectrum.nm.end()) return spectrum.values.back();
  const auto i = static_cast<std::size_t>(above - spectrum.nm.begin());
  const double w = (nm - spectrum.nm[i - 1]) / (spectrum.nm[i] - spectrum.nm[i - 1]);
  const PaneValues &a = spectrum.values[i - 1], &b = spectrum.values[i];
  return {a.t + w * (b.t - a.t), a.rf + w * (b.rf - a.rf), a.rb + w * (b.rb - a.rb)};
}

namespace {

double weight_at(const Method& method, double nm) {
  const double source = vitrail::weight_at(method.source, nm);
  if (method.action) return source * std::exp(method.action->a - method.action->b * nm / 1000);
  return source * vitrail::weight_at(method.detector, nm);
}

// Of each wavelength of a set that the sum takes in.
std::vector<double> weights(const Method& method, const std::vector<double>& set) {
  constexpr double same_nm = 1e-3;
  std::vector<double> result(set.size(), 0.0);
  const auto inside = [&](double nm) {
    return nm >= method.min_nm - same_nm && nm <= method.max_nm + same_nm;
  };
  for (std::size_t i = 0; i < set.size(); ++i) {
    if (!inside(set[i])) continue;
    if (method.rule == IntegrationRule::pre_weighted) result[i] += weight_at(method, set[i]);
    if (method.rule == IntegrationRule::pre_weighted || i + 1 == set.size() || !inside(set[i + 1])) continue;
    const double step = set[i + 1] - set[i];
    if (method.rule == IntegrationRule::rectangular) {
      result[i] += step * weight_at(method, set[i]);
    } else {
      result[i] += step / 2 * weight_at(method, set[i]);
      result[i + 1] += step / 2 * weight_at(method, set[i + 1]);
    }
  }
  return result;
}

PaneValues average_over(const SystemSpectrum& spectrum, const Method& method,
                        const std::vector<double>& set) {
  const std::vector<double> weight = weights(method, set);
  PaneValues sum;
  double total = 0;
  for (std::size_t i = 0; i < set.size(); ++i) {
    if (weight[i] == 0) continue;
    const PaneValues v = value_at(spectrum, set[i]);
    sum.t += weight[i] * v.t;
    sum.rf += weight[i] * v.rf;
    sum.rb += weight[i] * v.rb;
    total += weight[i];
  }
  if (!(total > 0))
    throw Error("the weights of " + method.name + " sum to nothing where the glazing is measured");
  return {sum.t / total, sum.rf / total, sum.rb / total};
}

bool is_color(const Method& method) { return lower(method.name).starts_with("color_tristim"); }

// WinCalc's condensed set: 5 visible and 10 infrared bands. The lower end of the visible stands three times,
// which only its white, a plain sum, feels: found by what it expects.
std::vector<double> condensed_set() {
  std::vector<double> nm{300, 380 - 2e-3, 380, 380 + 2e-3};
  for (int i = 1; i < 5; ++i) nm.push_back(380 + 80 * i);
  for (int i = 0; i < 10; ++i) nm.push_back(780 + 172 * i);
  nm.push_back(2500);
  return nm;
}

// Steps of at most 10 nm in the visible: observers are not to be sampled with fewer.
bool is_fine(const std::vector<double>& nm) {
  double last = 380;
  for (const double x : nm) {
    if (x <= 380) continue;
    if (x - last > 10.01) return false;
    last = x;
    if (x >= 780) return true;
  }
  return false;
}

class Evaluator {
 public:
  Evaluator(const SpectrumOf& spectrum, const std::vector<double>& wavelengths, Sampling sampling)
      : spectrum_(spectrum), wavelengths_(wavelengths), sampling_(sampling), full_(spectrum(wavelengths)) {
    if (sampling == Sampling::condensed) condensed_ = spectrum(condensed_set());
    fine_ = is_fine(wavelengths);
  }

  PaneValues average_of(const Method& method) const {
    if (sampling_ == Sampling::standard && !method.wavelengths_nm.empty())
      return average_over(spectrum_(method.wavelengths_nm), method, method.wavelengths_nm);
    const std::string name = lower(method.name);
    if (sampling_ == Sampling::condensed && (name == "solar" || name == "photopic"))
      return average_over(condensed_, method, condensed_.nm);
    return average(full_, method);
  }

  // T, Rf and Rb relative to the white, and the white: X, Y, Z.
  struct Tristimulus {
    std::array<std::array<double, 3>, 3> relative{};
    std::array<double, 3> white{};
  };

  Tristimulus tristimulus(const std::array<const Method*, 3>& methods) const {
    Tristimulus result;
    for (std::size_t c = 0; c < 3; ++c) {
      Method method = *methods[c];
      std::vector<double> set = method.wavelengths_nm.empty() ? wavelengths_ : method.wavelengths_nm;
      SystemSpectrum own;
      if (sampling_ == Sampling::condensed || (sampling_ == Sampling::full && fine_)) {
        // WinCalc weights colours at all wavelengths of the data, with weights held beyond their ends.
        method.min_nm = 0;
        method.max_nm = 1e9;
        own = sampling_ == Sampling::full ? full_ : condensed_;
        set = own.nm;
      } else {
        own = spectrum_(set);
      }
      const PaneValues v = average_over(own, method, set);
      result.relative[0][c] = v.t;
      result.relative[1][c] = v.rf;
      result.relative[2][c] = v.rb;
      for (const double nm : set)
        if (nm >= method.min_nm && nm <= method.max_nm) result.white[c] += weight_at(method, nm);
    }
    const double y = result.white[1];
    for (double& w : result.white) w /= y;
    return result;
  }

 private:
  const SpectrumOf& spectrum_;
  const std::vector<double>& wavelengths_;
  Sampling sampling_;
  SystemSpectrum full_, condensed_;
  bool fine_ = false;
};

}  // namespace

PaneValues average(const SystemSpectrum& spectrum, const Method& method) {
  return average_over(spectrum, method, method.wavelengths_nm.empty() ? spectrum.nm : method.wavelengths_nm);
}

Evaluation evaluate(const SpectrumOf& spectrum, const std::vector<double>& wavelengths,
                    const Standard& standard, Sampling sampling) {
  const Evaluator evaluator(spectrum, wavelengths, sampling);
  Evaluation result;
  for (const Method& method : standard.methods)
    if (!is_color(method)) result.averages[lower(method.name)] = evaluator.average_of(method);
  const std::array<const Method*, 3> xyz{find_method(standard, "COLOR_TRISTIMX"),
                                         find_method(standard, "COLOR_TRISTIMY"),
                                         find_method(standard, "COLOR_TRISTIMZ")};
  result.has_color = xyz[0] && xyz[1] && xyz[2];
  if (!result.has_color) return result;
  const auto [relative, white] = evaluator.tristimulus(xyz);
  // The observers' ȳ at 500 nm are 0.32 and 0.46.
  const Observer observer =
      vitrail::weight_at(xyz[1]->detector, 500) > 0.39 ? Observer::cie_1964 : Observer::cie_1931;
  result.t = color_values(relative[0], white, observer);
  result.rf = color_values(relative[1], white, observer);
  result.rb = color_values(relative[2], white, observer);
  return result;
}

}  // namespace vitrail
