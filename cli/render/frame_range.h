// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace vitrail {

// Returns the numbers of frames that --range names, each once and in its order: "7", "1-30,47" or
// "1-100x2", every second one. `count` is that of the list, whose numbers begin with 1. Throws UsageError
// with the place in the text.
std::vector<std::size_t> parse_frame_range(const std::string& text, std::size_t count);

}  // namespace vitrail
