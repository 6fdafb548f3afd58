// SPDX-License-Identifier: Apache-2.0
// These are tables of TM-30, for use inside glazing alone.
#pragma once

#include <array>
#include <span>

namespace vitrail {

// They return, each 5 nm from 380 to 780 nm, the components S₀, S₁, S₂ of CIE daylight (CIE 15), and the
// reflectances of the 99 colour evaluation samples (CIE 224:2017, ANSI/IES TM-30-20).
std::span<const std::array<double, 3>> cie_daylight_5nm();
std::span<const std::array<float, 99>> cie_224_samples_5nm();

}  // namespace vitrail
