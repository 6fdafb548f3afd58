// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "importers/mitsuba/read/object.h"
#include "importers/reading/import_options.h"

namespace vitrail::mitsuba {

// Returns the <scene> of a file, with everything that it includes: defaults put in, references
// resolved, spellings of versions 0.5 to 2 translated to those of 3. `files` gets the names that
// Origins refer to. Malformed XML and values, cycles of includes or references, unknown tags,
// names without a definition, and expansions or nesting without end throw Error. The options'
// definitions stand before the <default>s of the same names; one that the scene never asks for
// throws Error.
ObjectPtr load(const std::filesystem::path& file, const ImportOptions& options,
               std::vector<std::string>& files, Report& report);

}  // namespace vitrail::mitsuba
