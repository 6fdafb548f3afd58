// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace vitrail {

inline constexpr double pi = 3.14159265358979323846;
inline constexpr double radian = pi / 180;  // of a degree

}  // namespace vitrail
