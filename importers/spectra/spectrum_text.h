// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "importers/spectra/spectrum_file.h"

namespace vitrail {

// Reads a number with blanks around it, perhaps zeros or a plus sign before it. Returns false for anything
// else and for a number that is not finite.
bool parse_padded_number(std::string_view text, double& number);

// Returns rows in the order of the file, which may be empty. `name` of the file is for errors.
SpectrumFile parse_spectrum_text(std::string_view text, const std::string& name);

}  // namespace vitrail
