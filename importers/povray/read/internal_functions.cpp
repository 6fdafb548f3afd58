// SPDX-License-Identifier: Apache-2.0
// Formulas of functions.inc, as its comments and POV-Ray's documentation name them; signs are those that
// povray shows.
#include <algorithm>
#include <cmath>

#include "importers/povray/read/function.h"
#include "importers/povray/read/noise.h"

namespace vitrail::pov {

namespace {

double hypotenuse(double x, double y, double z) { return std::sqrt(x * x + y * y + z * z); }

struct Known {
  int number;
  std::size_t count;  // of arguments
  double (*value)(const double*);
};

double noise_of(const double* a) { return noise(a[0], a[1], a[2]); }

// Sums of octaves of noise (Musgrave 1994): P0 H, P1 lacunarity, P2 octaves.
double ridged_mf(const double* a) {  // P3 offset, P4 gain
  double sum = 0, weight = 1, frequency = 1;
  const int octaves = std::clamp(static_cast<int>(a[5]), 1, 32);
  for (int i = 0; i < octaves; ++i, frequency *= a[4]) {
    double signal = a[6] - std::abs(2 * noise(a[0] * frequency, a[1] * frequency, a[2] * frequency) - 1);
    signal *= signal * weight;
    sum += signal * std::pow(frequency, -a[3]);
    weight = std::clamp(signal * a[7], 0.0, 1.0);
  }
  return sum;
}
double hetero_mf(const double* a) {  // P3 offset, P4 T
  double sum = 2 * noise(a[0], a[1], a[2]) - 1 + a[6], frequency = a[4];
  const int octaves = std::clamp(static_cast<int>(a[5]), 1, 32);
  for (int i = 1; i < octaves; ++i, frequency *= a[4])
    sum += sum * std::pow(frequency, -a[3]) *
           (2 * noise(a[0] * frequency, a[1] * frequency, a[2] * frequency) - 1 + a[6]);
  return sum;
}

// a: x, y, z, and then the parameters.
constexpr Known known[] = {
    {17, 6,
     [](const double* a) { return hypotenuse(a[0] * a[3], a[1] * a[4], a[2] * a[5]); }},  // f_ellipsoid
    {29, 9, hetero_mf},
    {45, 4, [](const double* a) { return a[3] * (a[1] - a[0] * a[0] - a[2] * a[2]); }},  // f_paraboloid
    {47, 3, [](const double* a) { return std::atan2(std::sqrt(a[0] * a[0] + a[2] * a[2]), a[1]); }},  // f_ph
    {57, 3, [](const double* a) { return hypotenuse(a[0], a[1], a[2]); }},                            // f_r
    {59, 9, ridged_mf},
    {60, 7,
     [](const double* a) {  // f_rounded_box: P0 radius, P1 … P3 half sizes
       const auto beyond = [&](std::size_t i) { return std::max(0.0, std::abs(a[i]) - (a[4 + i] - a[3])); };
       return hypotenuse(beyond(0), beyond(1), beyond(2)) - a[3];
     }},
    {61, 4, [](const double* a) { return hypotenuse(a[0], a[1], a[2]) - a[3]; }},  // f_sphere
    {68, 5,
     [](const double* a) {  // f_superellipsoid
       const double e = 2 / a[3], n = a[3] / a[4];
       return 1 - std::pow(std::pow(std::pow(std::abs(a[0]), e) + std::pow(std::abs(a[1]), e), n) +
                               std::pow(std::abs(a[2]), 2 / a[4]),
                           a[4] * 0.5);
     }},
    {69, 3, [](const double* a) { return std::atan2(a[0], a[2]); }},  // f_th
    {70, 5,
     [](const double* a) {  // f_torus
       return std::hypot(std::hypot(a[0], a[2]) - a[3], a[1]) - a[4];
     }},
    {76, 3, noise_of},  // f_noise3d
    {78, 4, noise_of},  // f_noise_generator
};

}  // namespace

Shared<Function> internal_function(int number) {
  const auto* found =
      std::find_if(std::begin(known), std::end(known), [&](const Known& k) { return k.number == number; });
  if (found == std::end(known)) return nullptr;
  auto function = std::make_shared<Function>();
  function->built_in = found->value;
  function->count = found->count, function->number = number;
  function->noisy = function->notable =
      found->value == noise_of || found->value == hetero_mf || found->value == ridged_mf;
  return function;
}

}  // namespace vitrail::pov
