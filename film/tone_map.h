// SPDX-License-Identifier: Apache-2.0
// From the light of a scene to that of a screen. Loads OpenColorIO (images/image_codec.h).
#pragma once

#include "scene/records/image.h"

namespace vitrail {

// From linear sRGB of the scene to linear sRGB of a standard screen, in [0,1], by the output transform of
// ACES 1.x (SDR-VIDEO of OpenColorIO's built-in transforms: 100 cd/m², D65). 0.18 becomes 0.10, 0.002 black
// and 16 white; bright colours pale.
Image aces_tone_mapped(const Image& rgb);

}  // namespace vitrail
