// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "importers/mitsuba/write/write_context.h"

namespace vitrail::mitsuba_writer {

// Adds the curves of a shape as elements, without what they are made of: a `bsplinecurve` and a
// `linearcurve`, as far as there are any, each with its file. Returns none where Mitsuba has no such curves.
std::vector<Element> add_curves(Context& context, Element parent, const Shape& shape, bool sides_matter,
                                const std::string& id);

}  // namespace vitrail::mitsuba_writer
