// SPDX-License-Identifier: Apache-2.0
// Samples of a pixel are dealt in turn into two groups that know nothing of each other: each is a random
// sequence of its own. The samples of one sequence are stratified together, so their scatter says
// nothing of the error of their mean; that of the groups does. docs/why/color-and-film.md has what that
// costs, and what more of them would.
#pragma once

#include <cstdint>

namespace vitrail {

inline constexpr std::uint32_t sample_groups = 2;

constexpr std::uint32_t group_of(std::uint32_t sample) { return sample % sample_groups; }
constexpr std::uint32_t index_in_group(std::uint32_t sample) { return sample / sample_groups; }

}  // namespace vitrail
