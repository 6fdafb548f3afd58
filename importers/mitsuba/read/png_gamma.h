// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

namespace vitrail::mitsuba {

// What decodes the colours of a PNG file by its gAMA chunk, value = file^gamma, as Mitsuba 0.6 did; later
// versions, pbrt and Vitrail look at none. Nothing where there is none, where an sRGB chunk overrules it, and
// of what is no PNG file (ISO/IEC 15948:2004, 5.3, 11.3.3.2 and 11.3.3.5).
std::optional<double> png_gamma(const std::filesystem::path& file);

}  // namespace vitrail::mitsuba
