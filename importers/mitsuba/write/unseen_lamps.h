// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "importers/mitsuba/write/write_context.h"

namespace vitrail::mitsuba_writer {

// Returns whether a shape is a lamp that no ray meets: it shines, is not seen, and casts no shadow (pbrt's
// alpha of 0).
bool is_unseen_lamp(const Shape& shape);

// Returns the number of such lamps in the scene, with those of instances.
std::size_t count_unseen_lamps(const Scene& scene);

// Mitsuba shows every lamp that has an area. One that is not seen is written as spot lights on its surface,
// whose falls of intensity add up to the cosine of a lamp. It is reported with their number.
void write_unseen_lamp(Context& context, Element root, const Shape& shape);

}  // namespace vitrail::mitsuba_writer
