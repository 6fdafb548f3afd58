// SPDX-License-Identifier: Apache-2.0
// From the light of a scene to that of a screen. Loads OpenColorIO (images/image_codec.h).
#pragma once

#include "scene/records/image.h"

namespace vitrail {

// Three channels of linear sRGB, as the scene has them, to those that the output transform of ACES 1.x for
// standard screens (SDR-VIDEO of OpenColorIO's built-in transforms: 100 cd/m², D65) shows for them, in [0,1],
// still linear. 0.18 becomes 0.10, 0.002 black and 16 white; bright colours pale.
Image aces_tone_mapped(const Image& rgb);

}  // namespace vitrail
