// SPDX-License-Identifier: Apache-2.0
// Mitsuba's models of daylight are 0.6's "sky", "sun" and "sunsky", and 3's "sunsky". They become a SkyLight.
#pragma once

#include "importers/mitsuba/read/builder.h"

namespace vitrail::mitsuba {

bool is_daylight(const std::string& kind);
void add_daylight(Builder& builder, const Object& emitter);

}  // namespace vitrail::mitsuba
