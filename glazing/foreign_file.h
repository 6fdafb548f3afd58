// SPDX-License-Identifier: Apache-2.0
// Files of the same trade that are no glazing: they are refused by what they are.
#pragma once

#include <string>
#include <string_view>

namespace vitrail {

// Says what a file is by its beginning and the end of its name, e.g. "a weather file (EPW)"; "" where it is
// none of the kinds that are known: distributions of lamps, weather, BSDFs as XML, scenes of Radiance.
std::string foreign_kind(std::string_view text, std::string_view name);

}  // namespace vitrail
