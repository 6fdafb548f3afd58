// SPDX-License-Identifier: Apache-2.0
// The readers of several kinds of object ask this of their properties.
#pragma once

#include <string>
#include <string_view>

#include "importers/mitsuba/read/builder.h"

namespace vitrail::mitsuba {

// Returns the place of the property, or of the object where it has none of that name.
Origin place_of(const Object& object, std::string_view name);

// Returns the absolute path of the existing file that the property names: beside the scene's main file, else
// beside the file that says so. Throws Error where the property or the file is missing (a missing file is
// left to replace_missing_images where that is asked for).
std::string existing_file(const Builder& builder, const Object& object, std::string_view name);

// Returns the object that the property holds, nothing where it is a number or a colour or absent.
const Object* object_of(const Object& object, std::string_view name);

}  // namespace vitrail::mitsuba
