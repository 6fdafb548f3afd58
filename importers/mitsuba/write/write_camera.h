// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "importers/mitsuba/write/write_context.h"

namespace vitrail::mitsuba_writer {

void write_integrator(Context& context, Element root);

// Writes the sensor with its film and sampler.
void write_camera(Context& context, Element root);

// Returns the angle in degrees, in the fewest digits, with tan(fov/2·π/180) = half_width, bit for bit where
// there is one.
double field_of_view_deg(double half_width);

}  // namespace vitrail::mitsuba_writer
