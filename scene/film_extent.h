// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace vitrail {

inline constexpr int max_film_extent = 1 << 20;  // pixels a side

}  // namespace vitrail
