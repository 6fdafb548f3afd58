// SPDX-License-Identifier: Apache-2.0
// Glass that changes: by a voltage, by light, by warmth.
#pragma once

#include <optional>
#include <vector>

#include "glazing/optical_rows.h"

namespace vitrail {

// A measured state: `at` is the state in [0, 1] (0 clear), or a temperature in °C.
struct StateRows {
  double at = 0;
  OpticalRows rows;
};

// Between two states absorbances are linear, T = T₀^(1−s)·T₁^s: by Beer and Lambert's law s is then the part
// of the centres of colour that are there. Reflectances are linear. Held beyond the ends. `states` ascend, at
// least one.
OpticalRows rows_at(const std::vector<StateRows>& states, double at);

// Light of the clear state through two more absorptions, such that T_vis and T_sol under NFRC 300-2003 are
// these: a band, Gaussian over the photon's energy around `band_ev` (NaₓWO₃: 1.14 eV, near 1090 nm, so red
// goes first and the tint is blue), as narrow as can be, and free electrons in the infrared. Where no band
// does, the second is absorption in proportion to V(λ), for more of the sun, or to 1 − V(λ), for less of it,
// and the first is the same at all wavelengths: so everything within `solar_range` has a spectrum.
// Reflectances are scaled to `visible_reflectance` where it is given. Empty outside of the range; a clear
// state that reflects nothing cannot be scaled.
struct TintTarget {
  double visible_t = 0, solar_t = 0;
  std::optional<double> visible_reflectance;
  double band_ev = 1.14;
};
// The T_sol that `tinted` can give a T_vis. Empty where the clear state has less light than that, or none is
// wanted.
struct SolarRange {
  double least = 0, greatest = 0;
};
std::optional<SolarRange> solar_range(const OpticalRows& clear, double visible_t);
std::optional<OpticalRows> tinted(const OpticalRows& clear, const TintTarget& target);

// ds/dt = k_d·E·(1−s) − k_f(T)·s: ultraviolet light darkens, warmth fades. k_f follows Arrhenius' law.
struct Photochromic {
  double k_d_m2_per_j = 0;  // by the irradiance E in W/m²
  double k_f_per_s = 0;     // at 20 °C
  double activation_j_per_mol = 0;
  bool operator==(const Photochromic&) const = default;
};
double fading_per_s(const Photochromic& p, double temperature_c);
double photochromic_equilibrium(const Photochromic& p, double uv_w_per_m2, double temperature_c);
// After so long under constant light and temperature: the equation's own solution, whatever the time.
double photochromic_state(const Photochromic& p, double s, double uv_w_per_m2, double temperature_c,
                          double seconds);

// Photochromic glass and where it stands: what light and warmth have made of `start`.
struct PhotochromicLight {
  Photochromic rates;
  double start = 0, uv_w_per_m2 = 0, temperature_c = 20;
  std::optional<double> seconds;  // none: the equilibrium, whatever the start
  bool operator==(const PhotochromicLight&) const = default;
};
double state_under(const PhotochromicLight& light);

}  // namespace vitrail
