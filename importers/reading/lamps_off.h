// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/records/scene.h"

namespace vitrail {

// Turns off all lamps within the scene: surfaces and what glows on them, lights that have a place, media.
// Light from infinitely far stays. Surfaces and media stay, too, without their light; of lamps that coincide
// one stays. Diagnostics name each light that is off.
void turn_off_lamps(ImportedScene& imported);

}  // namespace vitrail
