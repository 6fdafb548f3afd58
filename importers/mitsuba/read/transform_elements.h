// SPDX-License-Identifier: Apache-2.0
// Points, transforms and animations.
#pragma once

#include <vector>

#include "importers/mitsuba/read/element.h"

namespace vitrail::mitsuba {

// x, y, z, or value with one number or three; `otherwise` where a coordinate is absent.
Vector3d read_triple(const Element& element, double otherwise);

// Of a <transform>: each step is applied after those before it.
Transform read_transform(const Element& element);

// 0.6's <animation>: transforms with times, in any order; of two with the same time throws Error.
std::vector<Keyframe> read_animation(const Element& element);

}  // namespace vitrail::mitsuba
