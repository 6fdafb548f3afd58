// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "bundle/instance.h"

namespace vitrail {

inline constexpr std::size_t most_curve_boxes = 8;

// Returns up to eight boxes that together hold a curve's part in its instance's box, or that box where they
// are not smaller. A curve that bends or leans fills little of its box.
std::vector<Bounds3f> curve_boxes(const InstanceRef& ref);

}  // namespace vitrail
