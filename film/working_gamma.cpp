// SPDX-License-Identifier: Apache-2.0
#include "film/working_gamma.h"

#include <algorithm>
#include <cmath>

namespace vitrail {

namespace {

double light(double sum, double gamma) {
  return gamma == srgb_gamma ? srgb_decode(sum) : std::pow(sum, gamma);
}

}  // namespace

RGB light_of(RGB sum, double gamma) {
  if (gamma == 1) return sum;
  const auto odd = [&](double v) { return std::copysign(light(std::abs(v), gamma), v); };
  return {odd(sum.r), odd(sum.g), odd(sum.b)};
}

double light_per_sum(double grey, double gamma) {
  if (gamma == 1) return 1;
  const double at = std::max(grey, 1e-6);
  if (gamma != srgb_gamma) return gamma * std::pow(at, gamma - 1);
  return at <= 0.04045 ? 1 / 12.92 : 2.4 / 1.055 * std::pow((at + 0.055) / 1.055, 1.4);
}

}  // namespace vitrail
