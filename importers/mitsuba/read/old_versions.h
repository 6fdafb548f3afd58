// SPDX-License-Identifier: Apache-2.0
// Versions of Mitsuba before 2 spell names otherwise.
#pragma once

#include <string>
#include <string_view>

#include "importers/mitsuba/read/object.h"

namespace vitrail::mitsuba {

// Returns the name of today, as Mitsuba 3 translates it: "_" where a capital follows a small letter, and the
// run of capitals that begins there in small letters: intIOR → int_ior, toUV → to_uv, B → B.
std::string name_of_today(const std::string& name);

// Returns the tag of today: luminaire → emitter, camera → sensor.
std::string tag_of_today(const std::string& tag);

// Returns whether a <spectrum value="…"> is a colour there. Mitsuba 0.6 is built for three channels, unless
// someone builds it otherwise: three numbers are linear sRGB, and an emitter's single number is that grey,
// which is D65 (since version 2 it is a flat spectrum).
bool is_color_of_old_file(std::string_view value, const Object& owner);

// Renames properties that have another name today; uscale … voffset become a to_uv, daylight
// gets "y_is_up".
void upgrade(Object& object);

}  // namespace vitrail::mitsuba
