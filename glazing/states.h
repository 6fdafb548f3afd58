// SPDX-License-Identifier: Apache-2.0
// These states are those of glass that changes: by a voltage, by light, by warmth.
#pragma once

#include <optional>
#include <vector>

#include "glazing/optical_rows.h"

namespace vitrail {

// A StateRows is a measured state: `at` is the state in [0, 1] (0 clear), or a temperature in °C.
struct StateRows {
  double at = 0;
  OpticalRows rows;
};

// Mixes two states with absorbances linear, T = T₀^(1−s)·T₁^s. By Beer and Lambert's law s is then the
// part of the centres of colour that are there. Reflectances are linear. Values are held beyond the
// ends. `states` ascend, at least one.
OpticalRows rows_at(const std::vector<StateRows>& states, double at);

// A TintTarget asks for the clear state's light through two more absorptions that give T_vis and T_sol
// under NFRC 300-2003. One is a band, Gaussian over the photon's energy around `band_ev`, as narrow as can
// be. For NaₓWO₃ it is at 1.14 eV, near 1090 nm, so red goes first and the tint is blue. The other is free
// electrons in the infrared. If no band does, the first is the same at all wavelengths. The second then
// follows V(λ), for more of the sun, or 1 − V(λ), for less. So all within `solar_range` has a spectrum;
// elsewhere there is none. Reflectances are scaled to `visible_reflectance` if given. A clear state that
// reflects nothing cannot be scaled.
struct TintTarget {
  double visible_t = 0, solar_t = 0;
  std::optional<double> visible_reflectance;
  double band_ev = 1.14;
};
// A SolarRange is the T_sol that `tinted` can give a T_vis. There is none where the clear state has less
// light than that, or none is wanted.
struct SolarRange {
  double least = 0, greatest = 0;
};
std::optional<SolarRange> solar_range(const OpticalRows& clear, double visible_t);
std::optional<OpticalRows> tinted(const OpticalRows& clear, const TintTarget& target);

// The state follows ds/dt = k_d·E·(1−s) − k_f(T)·s: ultraviolet darkens, warmth fades (Arrhenius' law).
struct Photochromic {
  double k_d_m2_per_j = 0;  // by the irradiance E in W/m²
  double k_f_per_s = 0;     // at 20 °C
  double activation_j_per_mol = 0;
  bool operator==(const Photochromic&) const = default;
};
double fading_per_s(const Photochromic& p, double temperature_c);
double photochromic_equilibrium(const Photochromic& p, double uv_w_per_m2, double temperature_c);
// Returns s after so long under constant light and temperature: the equation's solution, whatever the time.
double photochromic_state(const Photochromic& p, double s, double uv_w_per_m2, double temperature_c,
                          double seconds);

// This is photochromic glass and where it stands: what light and warmth have made of `start`.
struct PhotochromicLight {
  Photochromic rates;
  double start = 0, uv_w_per_m2 = 0, temperature_c = 20;
  std::optional<double> seconds;  // none: the equilibrium, whatever the start
  bool operator==(const PhotochromicLight&) const = default;
};
double state_under(const PhotochromicLight& light);

}  // namespace vitrail
