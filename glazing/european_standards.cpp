// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include "glazing/standard.h"
#include "glazing/standard_tables.h"

namespace vitrail {

namespace {

std::vector<double> wavelengths_in(const WeightTable& table, double last_nm) {
  std::vector<double> nm;
  for (const auto& [at, value] : table)
    if (at <= last_nm) nm.push_back(at);
  return nm;
}

Method weighted(const char* name, WeightTable table, IntegrationRule rule, double last_nm) {
  Method method{.name = name, .source = std::move(table), .rule = rule};
  method.wavelengths_nm = wavelengths_in(method.source, last_nm);
  return method;
}

Standard standard_of(const char* description, const Method& sun, const Method& ultraviolet) {
  Method light = *find_method(nfrc_2003(), "PHOTOPIC");  // D65 and V(λ) are the same in all of them
  return {.description = description, .methods = {sun, light, ultraviolet}};
}

}  // namespace

const Standard& en_410() {
  static const Standard standard =
      standard_of("EN 410:1998", weighted("SOLAR", en_410_solar(), IntegrationRule::pre_weighted, 2500),
                  weighted("TUV", iso_9050_1990_ultraviolet(), IntegrationRule::pre_weighted, 380));
  return standard;
}

const Standard& iso_9050_1990() {
  static const Standard standard = standard_of(
      "ISO 9050:1990", weighted("SOLAR", iso_9050_1990_solar(), IntegrationRule::pre_weighted, 2500),
      weighted("TUV", iso_9050_1990_ultraviolet(), IntegrationRule::pre_weighted, 380));
  return standard;
}

const Standard& iso_9050_2003() {
  static const Standard standard =
      standard_of("ISO 9050:2003", weighted("SOLAR", iso_9845_global(), IntegrationRule::trapezoidal, 2500),
                  weighted("TUV", iso_9845_global(), IntegrationRule::trapezoidal, 380));
  return standard;
}

}  // namespace vitrail
