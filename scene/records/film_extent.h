// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace vitrail {

// Of a picture, of which a film may hold a part: pixels a side.
inline constexpr int max_film_extent = 1 << 20;

}  // namespace vitrail
