// SPDX-License-Identifier: Apache-2.0
// The names that a scene's file gives its materials and lights. They are no part of the scene's hash:
// a name changes no picture.
#pragma once

#include "bundle/manifest_json.h"

namespace vitrail {

// Lists by index, "" where the file gives none; without those that name nothing.
Json names_to_json(const Manifest& manifest);
// Into the records, which are there. Throws nlohmann's exceptions for values of a wrong type, Error where a
// list is of other records.
void take_names(const Json& json, Manifest& manifest);

}  // namespace vitrail
