// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "importers/mitsuba/write/write_context.h"

namespace vitrail::mitsuba_writer {

// Mitsuba takes one light from all around: where the scene has several, the one that shines as they do.
std::optional<LightModel> joined_surroundings(Context& context);

bool is_around(const Light& light);

}  // namespace vitrail::mitsuba_writer
