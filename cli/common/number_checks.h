// SPDX-License-Identifier: Apache-2.0
// Checks of an option's text for CLI11, with messages that a user can read.
#pragma once

#include <string>

namespace vitrail {

// Both return what is wrong, or nothing.
std::string more_than_0(const std::string& text);
std::string not_below_0(const std::string& text);

}  // namespace vitrail
