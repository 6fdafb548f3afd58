// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace vitrail {

// It is the most pixels that a side of a picture may have; a film may hold a part of the picture.
inline constexpr int max_film_extent = 1 << 20;

}  // namespace vitrail
