// SPDX-License-Identifier: Apache-2.0
// These are the gases that fill gaps, and their mixtures.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace vitrail {

// These are the gases that both standards have numbers of.
enum class Gas { air, argon, krypton, xenon };

const char* name_of(Gas gas);                           // in lower case
std::optional<Gas> gas_named(const std::string& name);  // whatever the case

// Shares are of the volume and sum to 1. An empty mixture means air.
struct GasShare {
  Gas gas = Gas::air;
  double share = 1;
  bool operator==(const GasShare&) const = default;
};
using GasMixture = std::vector<GasShare>;

// Reads "air", "argon", or "argon=0.9,air=0.1". The greatest share is first. Returns none where a name is
// unknown or stands twice, or unless the shares are positive and sum to 1.
std::optional<GasMixture> gas_mixture(const std::string& text);
std::string words_for(const GasMixture& mixture);  // "argon 90 %, air 10 %"

// These properties of a gas decide how much heat crosses a gap.
struct GasProperties {
  double conductivity_w_mk = 0, viscosity_pa_s = 0, heat_j_kgk = 0, density_kg_m3 = 0;
};

// Returns the properties at a temperature and 101 325 Pa, linear in the temperature (ISO 15099:2003, annex
// B). The density is that of an ideal gas; mixtures follow its equations (62) to (68).
GasProperties iso_15099_gas(const GasMixture& mixture, double kelvin);

// Returns the properties at 283 K, linear in the shares: EN 673:2011, table 1.
GasProperties en_673_gas(const GasMixture& mixture);

}  // namespace vitrail
