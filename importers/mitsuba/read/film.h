// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "importers/mitsuba/read/builder.h"

namespace vitrail::mitsuba {

// Size, crop and reconstruction filter of a sensor's film; Mitsuba's defaults where it has none.
void read_film(Builder& builder, const Object& sensor);

}  // namespace vitrail::mitsuba
