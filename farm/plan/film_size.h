// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bundle/manifest.h"
#include "farm/plan/options.h"

namespace vitrail {

// Gives the film the size that is asked for, and a view of another scene its proportions. The camera sees all
// that it saw before, and more on one axis where the proportions change; those of a pixel stay. A crop of the
// scene's goes along.
void resize_film(Manifest& manifest, const PictureSettings& picture);

}  // namespace vitrail
