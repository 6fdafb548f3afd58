// SPDX-License-Identifier: Apache-2.0
// Crops of one picture are compared where they overlap.
#pragma once

#include "film/develop.h"

namespace vitrail {

// Cuts both to what both show of the same whole picture; those of other wholes have to have the same size,
// and are compared pixel by pixel. Throws Error where there is nothing to compare.
void align(Picture& image, Picture& reference);

}  // namespace vitrail
