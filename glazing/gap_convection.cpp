// SPDX-License-Identifier: Apache-2.0
#include "glazing/gap_convection.h"

#include <algorithm>
#include <cmath>

namespace vitrail {

namespace {

constexpr double gravity_m_s2 = 9.81;

// ρ² l³ g cp ΔT / (µ λ T)
double rayleigh(const GasProperties& gas, double length_m, double difference_k, double kelvin) {
  return gas.density_kg_m3 * gas.density_kg_m3 * length_m * length_m * length_m * gravity_m_s2 *
         gas.heat_j_kgk * std::abs(difference_k) / (gas.viscosity_pa_s * gas.conductivity_w_mk * kelvin);
}

}  // namespace

double iso_15099_gap(const GasMixture& gas, double width_m, double height_m, double kelvin_a,
                     double kelvin_b) {
  const double mean = (kelvin_a + kelvin_b) / 2;
  const GasProperties properties = iso_15099_gas(gas, mean);
  const double ra = rayleigh(properties, width_m, kelvin_a - kelvin_b, mean);
  const double of_number = ra > 5e4   ? 0.0673838 * std::cbrt(ra)
                           : ra > 1e4 ? 0.028154 * std::pow(ra, 0.4134)
                                      : 1 + 1.7596678e-10 * std::pow(ra, 2.2984755);
  const double of_shape = 0.242 * std::pow(ra * width_m / height_m, 0.272);
  return std::max(of_number, of_shape) * properties.conductivity_w_mk / width_m;
}

double iso_15099_room(double height_m, double kelvin_surface, double kelvin_air) {
  const double film = kelvin_air + (kelvin_surface - kelvin_air) / 4;
  const GasProperties air = iso_15099_gas({}, film);
  const double ra = rayleigh(air, height_m, kelvin_surface - kelvin_air, film);
  const double turbulent = 2.5e5 * std::pow(std::exp(0.72 * 90), 0.2);
  const double laminar = 0.56 * std::pow(std::min(ra, turbulent), 0.25);
  const double more = ra > turbulent ? 0.13 * (std::cbrt(ra) - std::cbrt(turbulent)) : 0;
  return (laminar + more) * air.conductivity_w_mk / height_m;
}

double en_673_gap(const GasMixture& gas, double width_m, double difference_k) {
  const GasProperties properties = en_673_gas(gas);
  const double nusselt = 0.035 * std::pow(rayleigh(properties, width_m, difference_k, 283), 0.38);
  return std::max(1.0, nusselt) * properties.conductivity_w_mk / width_m;
}

}  // namespace vitrail
