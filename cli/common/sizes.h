// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace vitrail {

// Reads "4096", "512K", "1.5M", "2G", "1T", also with B or iB at the end: powers of 1024.
// Anything else throws UsageError.
std::uint64_t parse_bytes(const std::string& text);

// Returns a size for people: "1.5 GiB".
std::string format_bytes(std::uint64_t bytes);

}  // namespace vitrail
