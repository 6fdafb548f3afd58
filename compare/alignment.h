// SPDX-License-Identifier: Apache-2.0
// This file cuts crops of one picture to where they overlap, before they are compared.
#pragma once

#include "film/develop.h"

namespace vitrail {

// Cuts both pictures to the pixels that both show of the same whole picture. Pictures of different wholes are
// compared pixel by pixel. Throws Error where nothing overlaps, or where the sizes of such pictures differ.
void align(Picture& image, Picture& reference);

}  // namespace vitrail
