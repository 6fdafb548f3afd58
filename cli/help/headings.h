// SPDX-License-Identifier: Apache-2.0
// Under which heading of the help each option of a verb stands, and what its value is called there.
#pragma once

#include <span>
#include <string_view>
#include <vector>

namespace vitrail {

struct Heading {
  std::string_view title;
  // Longest names without dashes, in the order of the help, with spaces between: "output=FILE quiet". Without
  // =VALUE the value is called as CLI11 calls its type, or lists its choices. What a verb has not is passed
  // over: several share a list.
  std::string_view options;
};

// Empty of verbs with few options. What no heading names stands under "Other options".
std::span<const Heading> headings(std::string_view verb);

// The options that nearly everyone needs, as longest names with spaces between, in the order of the help.
// Empty of verbs whose whole help is short.
std::string_view everyday_options(std::string_view verb);

}  // namespace vitrail
