// SPDX-License-Identifier: Apache-2.0
// This file says where the sums of a film stand (Film::sums), and what they count in. Only film.cpp,
// film_statistics.cpp and film_survey.cpp use it.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "film/sample_groups.h"

namespace vitrail {

inline constexpr std::size_t plane_count = 2 + sample_groups;
inline constexpr std::size_t x_plane = 0, z_plane = 1, y_planes = 2, bin_planes = plane_count;

constexpr double power_of_two(int exponent) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(1023 + exponent) << 52);
}

}  // namespace vitrail
