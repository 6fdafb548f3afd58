// SPDX-License-Identifier: Apache-2.0
#include "scene/daylight/photometry.h"

#include <algorithm>
#include <cmath>

namespace vitrail {

namespace {

// ∫ S s_mel dλ, by the trapezoids of the table, whose ends are 0.
template <class F>
double melanopic_integral(F&& value) {
  double sum = 0;
  for (int i = 0; i < table_size; ++i)
    sum += value(i) * static_cast<double>(melanopic()[static_cast<std::size_t>(i)]);
  return sum;
}

// Of a lumen of D65, W.
double melanopic_of_daylight() {
  static const double value =
      melanopic_integral([](int i) { return static_cast<double>(cie_d65()[static_cast<std::size_t>(i)]); }) /
      photometric(1);
  return value;
}

// ∫ s_mel dλ from 360 nm on.
double melanopic_up_to(double nm) {
  const double x = std::clamp(nm - lambda_min_nm, 0.0, static_cast<double>(table_size - 1));
  double sum = 0;
  for (int i = 0; i + 1 < table_size && i < x; ++i) {
    const auto at = [](int k) { return static_cast<double>(melanopic()[static_cast<std::size_t>(k)]); };
    const double part = std::min(1.0, x - i), end = at(i) + (at(i + 1) - at(i)) * part;
    sum += (at(i) + end) / 2 * part;
  }
  return sum;
}

}  // namespace

double melanopic_edi(const Spectrum& irradiance) {
  return melanopic_integral([&](int i) { return evaluate(irradiance, lambda_min_nm + i); }) /
         melanopic_of_daylight();
}

double melanopic_edi_of_bin(double low_nm, double high_nm) {
  return (melanopic_up_to(high_nm) - melanopic_up_to(low_nm)) / melanopic_of_daylight();
}

double correlated_color_temperature(const XYZ& c) {
  const double sum = c.x + c.y + c.z;
  const double n = (c.x / sum - 0.3320) / (0.1858 - c.y / sum);
  return ((449 * n + 3525) * n + 6823.3) * n + 5520.33;
}

}  // namespace vitrail
