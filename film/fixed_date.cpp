// SPDX-License-Identifier: Apache-2.0
#include "film/fixed_date.h"

#include <cstdlib>

namespace vitrail {

std::tm fixed_date() {
  const char* epoch = std::getenv("SOURCE_DATE_EPOCH");
  const std::time_t seconds = epoch ? std::strtoll(epoch, nullptr, 10) : 0;
  std::tm utc{};
  gmtime_r(&seconds, &utc);
  return utc;
}

std::string fixed_date_text() {
  const std::tm utc = fixed_date();
  char text[32];
  std::strftime(text, sizeof text, "%Y:%m:%d %H:%M:%S", &utc);
  return text;
}

}  // namespace vitrail
