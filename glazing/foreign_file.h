// SPDX-License-Identifier: Apache-2.0
// Foreign files are of the same trade but no glazing: messages that refuse them say what they are.
#pragma once

#include <string>
#include <string_view>

namespace vitrail {

// Says what a file is by its beginning and the end of its name, e.g. "a weather file (EPW)"; "" where it is
// none of the kinds that are known: distributions of lamps, weather, BSDFs as XML, scenes of Radiance.
std::string foreign_kind(std::string_view text, std::string_view name);

}  // namespace vitrail
