// SPDX-License-Identifier: Apache-2.0
// These functions store the names that a scene's file gives its materials and lights. Names are no part of
// the scene's hash: a name changes no picture.
#pragma once

#include "bundle/manifest_json.h"

namespace vitrail {

// Returns lists by index, with "" where the file gives no name. It leaves out lists without any name.
Json names_to_json(const Manifest& manifest);
// Copies the names into the records, which exist already. Throws nlohmann's exceptions for values of a wrong
// type, and Error where a list has another length than its records.
void take_names(const Json& json, Manifest& manifest);

}  // namespace vitrail
