// SPDX-License-Identifier: Apache-2.0
// These functions check an option's text for CLI11, with messages that a user can read.
#pragma once

#include <string>

namespace vitrail {

// Both return what is wrong, or nothing.
std::string more_than_0(const std::string& text);
std::string not_below_0(const std::string& text);

// This is a CLI::Option::transform of options that take seconds: "90s" becomes "90", "15m" "900", "1h30m"
// "5400", "2d" "172800". Any other text is left to the option's own check.
std::string plain_seconds(const std::string& text);

// This is a CLI::Option::transform of options that count: "500k" becomes "500000", "1.5M" "1500000", "2G"
// "2000000000": powers of 1000, unlike sizes in bytes. Any other text is left to the option's own check.
std::string plain_count(const std::string& text);

}  // namespace vitrail
