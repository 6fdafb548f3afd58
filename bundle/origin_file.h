// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace vitrail {

// This file in a bundle says where the bundle came from. It is no part of the format, and no reader needs it.
inline constexpr const char* bundle_origin_file = "origin.json";

}  // namespace vitrail
