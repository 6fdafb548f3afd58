// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "importers/mitsuba/write/write_context.h"

namespace vitrail::mitsuba_writer {

void write_film(Context& context, Element sensor);

}  // namespace vitrail::mitsuba_writer
