// SPDX-License-Identifier: Apache-2.0
// This file turns the light of a scene into that of a screen. It loads OpenColorIO (images/image_codec.h).
#pragma once

#include "scene/records/image.h"

namespace vitrail {

// Maps linear sRGB of the scene to linear sRGB of a standard screen, in [0,1], by the output transform of
// ACES 1.x (SDR-VIDEO of OpenColorIO's built-in transforms: 100 cd/m², D65). 0.18 becomes 0.10, 0.002 black
// and 16 white; bright colours pale.
Image aces_tone_mapped(const Image& rgb);

}  // namespace vitrail
