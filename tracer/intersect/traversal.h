// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace vitrail {

// It says whose trees rays go through: the bundle's, or Embree's (embree_domain.h). Every hit has the same
// bits.
enum class Traversal : std::uint8_t { own, embree };

}  // namespace vitrail
