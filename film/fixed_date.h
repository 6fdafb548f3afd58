// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ctime>

namespace vitrail {

// The date of pictures in UTC: SOURCE_DATE_EPOCH, else 1970, so that equal pictures give equal files.
std::tm fixed_date();

}  // namespace vitrail
