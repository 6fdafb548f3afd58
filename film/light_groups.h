// SPDX-License-Identifier: Apache-2.0
// Light groups are lights that a film keeps apart: the picture of each group by itself, in the quanta of the
// film's own sums. The sums of the groups add up to the film's, to the bit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace vitrail {

// LightGroups names the groups of lights that a film keeps apart.
struct LightGroups {
  std::vector<std::string> names;  // ascending numbers from 0; empty: nothing is kept apart
  std::uint64_t lights = 0;        // checksum of which light is in which group

  // Returns whether lights are kept apart.
  bool any() const { return !names.empty(); }
  bool operator==(const LightGroups&) const = default;
};

inline constexpr std::size_t most_light_groups = 128;
inline constexpr std::size_t planes_a_group = 3;  // X, Y, Z

}  // namespace vitrail
