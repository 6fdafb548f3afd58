// SPDX-License-Identifier: Apache-2.0
// The data of the sky model are read here: sky_tables.txt has the numbers and names their source and licence.
#pragma once

namespace vitrail {

struct SkyTables {
  static constexpr int turbidities = 10, albedos = 2, control_points = 6, bands = 10, shapes = 9;
  static constexpr int sun_segments = 45, sun_powers = 4, limb_powers = 6;

  // Bézier points in the cube root of the sun's elevation over 90°.
  float shape[turbidities][albedos][control_points][bands][shapes];
  float radiance[turbidities][albedos][control_points][bands];
  // Polynomials in the elevation above a segment's beginning, 90°·(segment/45)³, in rad.
  float sun[turbidities][sun_segments][bands][sun_powers];
  // Powers of the cosine of the angle between the line of sight and the sun's normal.
  float limb[bands][limb_powers];
};

// Returns the data, which the first call reads.
const SkyTables& sky_tables();

}  // namespace vitrail
