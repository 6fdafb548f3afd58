// SPDX-License-Identifier: Apache-2.0
// State rules say which state switchable glazing is in, hour by hour.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/year/sky_year.h"

namespace vitrail {

// A term compares a number that an hour has.
struct RuleTerm {
  enum class Quantity : std::uint8_t { sensor, global, diffuse, direct, elevation, azimuth, month, hour };
  enum class Comparison : std::uint8_t { less, less_or_equal, greater, greater_or_equal };
  Quantity quantity = Quantity::hour;
  std::size_t sensor = 0;  // from 0
  Comparison comparison = Comparison::greater;
  double value = 0;
};

// A rule gives a state for the hours in which all terms hold.
struct StateRule {
  std::vector<RuleTerm> terms;
  std::size_t state = 0;
};
struct StateRules {
  std::vector<StateRule> rules;
  std::size_t otherwise = 0;
};

// Reads a file of JSON: {"rules": [{"when": "sensor 21 > 2000 lx", "state": "dark"}], "otherwise": "clear"}.
// Terms of "when" are joined by "and": global, diffuse and direct are lx outdoors, on the ground and across
// the sun's direction; elevation and azimuth degrees of the sun; month 1 to 12; hour 0 to 23, which is the
// one that begins then. `sensor N` is the illuminance of the N-th sensor while the glass is in the state
// "otherwise". Without that word it is the first state. Throws Error with what is wrong.
StateRules read_state_rules(const std::filesystem::path& file, const std::vector<std::string>& states,
                            std::size_t sensors);

// Returns the sensors that rules ask for.
std::vector<std::size_t> sensors_of(const StateRules& rules);

// Returns the state of each hour: that of the first rule that holds. `lux` is that of a sensor in
// an hour, in the state "otherwise".
std::vector<std::size_t> states_of(const StateRules& rules, const SkyYear& year,
                                   const std::function<double(std::size_t sensor, std::size_t hour)>& lux);

}  // namespace vitrail
