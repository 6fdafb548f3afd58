// SPDX-License-Identifier: Apache-2.0
// These tables are the data of the sky's model. scripts/generate_sky_tables.py writes them, and names the
// source and licence.
#pragma once

#include <array>

namespace vitrail::sky_tables {

inline constexpr int turbidities = 10, albedos = 2, control_points = 6, bands = 10, shapes = 9;
inline constexpr int sun_segments = 45, sun_powers = 4, limb_powers = 6;

// These are Bézier points in the cube root of the sun's elevation over 90°.
extern const float shape[turbidities][albedos][control_points][bands][shapes];
extern const float radiance[turbidities][albedos][control_points][bands];
// These are polynomials in the elevation above a segment's beginning, 90°·(segment/45)³, in rad.
extern const float sun[turbidities][sun_segments][bands][sun_powers];
// It holds coefficients of powers of the cosine of the angle between the line of sight and the sun's normal.
extern const float limb[bands][limb_powers];

}  // namespace vitrail::sky_tables
