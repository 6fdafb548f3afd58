// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "importers/mitsuba/write/write_context.h"

namespace vitrail::mitsuba_writer {

// Writes shapes and prototypes in the order in which they first use a mesh, then the instances.
void write_shapes(Context& context, Element root);

}  // namespace vitrail::mitsuba_writer
