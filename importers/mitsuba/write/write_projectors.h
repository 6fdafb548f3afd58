// SPDX-License-Identifier: Apache-2.0
// Lights whose intensity goes by an image, which Mitsuba has as projectors of irradiance.
#pragma once

#include "importers/mitsuba/write/write_context.h"

namespace vitrail::mitsuba_writer {

// A projector as it is, or of pbrt's: its image times cos³θ.
void write_projector(Context& context, Element root, const ProjectionLight& light);

// Six projectors, one to each face of a cube, of 90°: the intensity in every direction is the image's there.
void write_goniometric(Context& context, Element root, const GoniometricLight& light);

}  // namespace vitrail::mitsuba_writer
