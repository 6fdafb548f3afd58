// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ctime>
#include <string>

namespace vitrail {

// Returns the date of pictures in UTC: SOURCE_DATE_EPOCH, else 1970, so that equal pictures give equal files.
std::tm fixed_date();
// Returns the same as EXIF and OpenEXR write it: "1970:01:01 00:00:00".
std::string fixed_date_text();

}  // namespace vitrail
