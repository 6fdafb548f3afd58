// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <variant>

#include "importers/bytes/growing_array.h"

namespace vitrail::pbrt {

// The numbers of a parameter that has very many, as narrow as what they are for: whole numbers, floats, or
// doubles where positions are still to be moved to the origin.
using LongList = std::variant<GrowingArray<double>, GrowingArray<float>, GrowingArray<std::int32_t>>;

}  // namespace vitrail::pbrt
