// SPDX-License-Identifier: Apache-2.0
// These functions read points, transforms and animations.
#pragma once

#include <vector>

#include "importers/mitsuba/read/element.h"

namespace vitrail::mitsuba {

// Reads x, y, z, or value with one number or three; `otherwise` where a coordinate is absent.
Vector3d read_triple(const Element& element, double otherwise);

// Reads a <transform>: each step is applied after those before it.
Transform read_transform(const Element& element);

// Reads 0.6's <animation>: transforms with times, in any order. Two with the same time throw Error.
std::vector<Keyframe> read_animation(const Element& element);

}  // namespace vitrail::mitsuba
