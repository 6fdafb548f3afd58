// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>

#include "scene/shapes/curve.h"
#include "scene/shapes/quadric_places.h"

namespace vitrail {

// Calls `use` with the segments that follow each other as one curve, strand by strand, as they stand in a
// mesh.
void for_each_strand(const QuadricPlaces& curves,
                     const std::function<void(std::span<const PlacedCurve>)>& use);

}  // namespace vitrail
