// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "importers/spectra/spectrum_file.h"

namespace vitrail {

// Returns rows in the order of the file, which may be empty. `name` of the file is for errors.
SpectrumFile parse_spectrum_xml(std::string_view text, const std::string& name);

}  // namespace vitrail
