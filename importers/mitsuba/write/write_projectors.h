// SPDX-License-Identifier: Apache-2.0
// Some lights have an intensity that goes by an image. Mitsuba has them as projectors of irradiance.
#pragma once

#include "importers/mitsuba/write/write_context.h"

namespace vitrail::mitsuba_writer {

// Writes a projector as it is, or pbrt's with its image times cos³θ.
void write_projector(Context& context, Element root, const ProjectionLight& light);

// Writes six projectors, one to each face of a cube, of 90°: the intensity in every direction is the image's
// there.
void write_goniometric(Context& context, Element root, const GoniometricLight& light);

}  // namespace vitrail::mitsuba_writer
