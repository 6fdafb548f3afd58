// SPDX-License-Identifier: Apache-2.0
// Headings group the options of a verb in its help, and name the values of options there.
#pragma once

#include <span>
#include <string_view>
#include <vector>

namespace vitrail {

struct Heading {
  std::string_view title;
  // They are longest names without dashes, in the order of the help, with spaces between: "output=FILE
  // quiet". Without =VALUE the value is called as CLI11 calls its type, or lists its choices. Options that a
  // verb does not have are passed over: several verbs share a list.
  std::string_view options;
};

// Returns none for verbs with few options. Options without a heading stand under "Other options".
std::span<const Heading> headings(std::string_view verb);

// Returns the options that nearly everyone needs, as longest names with spaces between, in the order of the
// help. It is empty for verbs whose whole help is short.
std::string_view everyday_options(std::string_view verb);

}  // namespace vitrail
