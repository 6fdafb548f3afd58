// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "bundle/instance.h"

namespace vitrail {

inline constexpr std::size_t most_curve_boxes = 8;

// Of an instance that is a curve: up to eight boxes that hold together what its own box has of it, where they
// are smaller. A curve that bends or leans fills little of its box.
std::vector<Bounds3f> curve_boxes(const InstanceRef& ref);

}  // namespace vitrail
