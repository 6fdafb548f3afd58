// SPDX-License-Identifier: Apache-2.0
// Some lights throw an image. POV-Ray's point lights have none, but a shade around one filters its light.
#pragma once

#include "importers/povray/write/context.h"

namespace vitrail::povray {

// They return a `light_source` and its shade, an object that no camera sees: its pigment filters the light by
// the image. They throw Error where the image cannot be read. `point` writes a point light of a colour of
// intensity at a point, with the words that follow (a spotlight's cone, or nothing).
using WritePoint = std::string (*)(const Context&, Point3d position, RGB intensity, const std::string& words);
std::string shaded_light(Context& context, const ProjectionLight& light, WritePoint point,
                         const Origin& origin);
std::string shaded_light(Context& context, const GoniometricLight& light, WritePoint point,
                         const Origin& origin);

}  // namespace vitrail::povray
