// SPDX-License-Identifier: Apache-2.0
#include "glazing/gas.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "glazing/text_file.h"

namespace vitrail {

namespace {

constexpr double gas_constant_j_kmolk = 8314.462618;
constexpr double pressure_pa = 101325;

struct Linear {
  double a = 0, b = 0;
  double at(double kelvin) const { return a + b * kelvin; }
};

struct GasData {
  const char* name;
  double kg_per_kmol;
  Linear conductivity, viscosity, heat;  // ISO 15099:2003, tables B.1 to B.3
  GasProperties en_673;
};

constexpr std::array<GasData, 4> all_gases{{{"air",
                                             28.97,
                                             {2.873e-3, 7.760e-5},
                                             {3.723e-6, 4.940e-8},
                                             {1002.737, 1.2324e-2},
                                             {2.496e-2, 1.761e-5, 1008, 1.232}},
                                            {"argon",
                                             39.948,
                                             {2.285e-3, 5.149e-5},
                                             {3.379e-6, 6.451e-8},
                                             {521.9285, 0},
                                             {1.684e-2, 2.164e-5, 519, 1.699}},
                                            {"krypton",
                                             83.80,
                                             {9.443e-4, 2.826e-5},
                                             {2.213e-6, 7.777e-8},
                                             {248.0907, 0},
                                             {0.900e-2, 2.400e-5, 245, 3.560}},
                                            {"xenon",
                                             131.30,
                                             {4.538e-4, 1.723e-5},
                                             {1.069e-6, 7.414e-8},
                                             {158.3397, 0},
                                             {0.529e-2, 2.226e-5, 161, 5.689}}}};

const GasData& data_of(Gas gas) { return all_gases[static_cast<std::size_t>(gas)]; }

// Equations (63), (66) and (68) have this in common; of viscosities the masses stand the other way round.
double exchange(double ratio, double mass_ratio, double mass_i, double mass_j) {
  const double sum = 1 + std::sqrt(ratio) * std::pow(mass_ratio, 0.25);
  return sum * sum / (2 * std::numbers::sqrt2 * std::sqrt(1 + mass_i / mass_j));
}

GasMixture or_air(const GasMixture& mixture) { return mixture.empty() ? GasMixture{{}} : mixture; }

}  // namespace

const char* name_of(Gas gas) { return data_of(gas).name; }

std::optional<Gas> gas_named(const std::string& name) {
  for (std::size_t i = 0; i < all_gases.size(); ++i)
    if (same_word(all_gases[i].name, name)) return static_cast<Gas>(i);
  return {};
}

std::optional<GasMixture> gas_mixture(const std::string& text) {
  GasMixture mixture;
  double sum = 0;
  std::string_view rest = text;
  for (std::string_view word; !(word = next_word(rest)).empty();) {
    const std::size_t sign = word.find('=');
    const auto gas = gas_named(std::string(word.substr(0, sign)));
    double share = 1;
    if (!gas || (sign != word.npos && !parse_number(word.substr(sign + 1), share)) || !(share > 0)) return {};
    for (const GasShare& other : mixture)
      if (other.gas == *gas) return {};
    mixture.push_back({*gas, share});
    sum += share;
  }
  if (mixture.empty() || std::abs(sum - 1) > 1e-6) return {};
  std::ranges::stable_sort(mixture, std::greater{}, &GasShare::share);
  return mixture;
}

std::string words_for(const GasMixture& mixture) {
  std::string text;
  for (const auto& [gas, share] : or_air(mixture)) {
    text += (text.empty() ? "" : ", ") + std::string(name_of(gas));
    if (share != 1) text += fmt::format(" {:g} %", 100 * share);
  }
  return text;
}

GasProperties iso_15099_gas(const GasMixture& mixture, double kelvin) {
  const GasMixture parts = or_air(mixture);
  const std::size_t count = parts.size();
  std::vector<double> viscosity(count), first(count), second(count);
  double mass = 0, heat = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const GasData& data = data_of(parts[i].gas);
    viscosity[i] = data.viscosity.at(kelvin);
    first[i] = 15.0 / 4 * gas_constant_j_kmolk / data.kg_per_kmol * viscosity[i];  // λ′ of a monatomic gas
    second[i] = data.conductivity.at(kelvin) - first[i];                           // λ″
    mass += parts[i].share * data.kg_per_kmol;
    heat += parts[i].share * data.kg_per_kmol * data.heat.at(kelvin);
  }
  GasProperties mean{
      .heat_j_kgk = heat / mass,
      .density_kg_m3 = pressure_pa * mass / (gas_constant_j_kmolk * kelvin),
  };
  for (std::size_t i = 0; i < count; ++i) {
    const double m_i = data_of(parts[i].gas).kg_per_kmol;
    double of_viscosity = 1, of_first = 1, of_second = 1;
    for (std::size_t j = 0; j < count; ++j) {
      if (j == i) continue;
      const double m_j = data_of(parts[j].gas).kg_per_kmol, x = parts[j].share / parts[i].share;
      of_viscosity += x * exchange(viscosity[i] / viscosity[j], m_j / m_i, m_i, m_j);
      const double phi = exchange(first[i] / first[j], m_i / m_j, m_i, m_j);
      of_second += x * phi;
      of_first += x * phi * (1 + 2.41 * (m_i - m_j) * (m_i - 0.142 * m_j) / ((m_i + m_j) * (m_i + m_j)));
    }
    mean.viscosity_pa_s += viscosity[i] / of_viscosity;
    mean.conductivity_w_mk += first[i] / of_first + second[i] / of_second;
  }
  return mean;
}

GasProperties en_673_gas(const GasMixture& mixture) {
  GasProperties mean;
  for (const auto& [gas, share] : or_air(mixture)) {
    const GasProperties& one = data_of(gas).en_673;
    mean.conductivity_w_mk += share * one.conductivity_w_mk;
    mean.viscosity_pa_s += share * one.viscosity_pa_s;
    mean.heat_j_kgk += share * one.heat_j_kgk;
    mean.density_kg_m3 += share * one.density_kg_m3;
  }
  return mean;
}

}  // namespace vitrail
