// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace vitrail {

// A file in a bundle that says where it came from: no part of the format, which no reader needs.
inline constexpr const char* bundle_origin_file = "origin.json";

}  // namespace vitrail
