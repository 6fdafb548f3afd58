// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

namespace vitrail::mitsuba {

// Returns the exponent of the gAMA chunk of a PNG file, by which Mitsuba 0.6 decoded its colours: value =
// file^gamma. Later versions, pbrt and Vitrail look at none. Returns nothing where there is no such chunk,
// where an sRGB chunk overrules it, and for other files (ISO/IEC 15948:2004, 5.3, 11.3.3.2 and 11.3.3.5).
std::optional<double> png_gamma(const std::filesystem::path& file);

}  // namespace vitrail::mitsuba
