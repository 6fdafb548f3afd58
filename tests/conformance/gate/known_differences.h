// SPDX-License-Identifier: Apache-2.0
// What the gate finds and lets through, with the reason.
#pragma once

#include <string>
#include <string_view>

namespace vitrail::test {

// The reason why a scene of this name may fail, "" where it may not.
std::string_view known_difference(const std::string& name);

}  // namespace vitrail::test
