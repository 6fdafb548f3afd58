// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "importers/mitsuba/read/element.h"
#include "importers/mitsuba/read/search_folders.h"

namespace vitrail::mitsuba {

// Reads the value of a property of `owner`: <float>, <rgb>, <transform> … Names of files become absolute
// while it is known which folders are searched. Malformed values and unknown tags throw Error.
Value read_value(const Element& element, const Object& owner, const SearchFolders& folders);

}  // namespace vitrail::mitsuba
